// Vectors at the vertices of a mesh, which later cuts carry on.
#pragma once

#include <vector>

#include "explorer/incision/cut_mesh.h"

namespace cleft {

class CarriedVectors {
 public:
  CarriedVectors() = default;  ///< all are 0
  /// `values`: of all vertices of the mesh.
  CarriedVectors(const CutMesh& mesh, std::vector<Vec3> values);

  /// Must be called after every change of the mesh. A vertex that a cut has added gets the mean of those next
  /// to it, by their inverse distances: along the lips of a cut those of its own side. Returns such vertices.
  std::vector<int> follow(const CutMesh& mesh);

  Vec3 at(int vertex) const {
    const auto v = static_cast<std::size_t>(vertex);
    return v < values_.size() ? values_[v] : Vec3{};
  }

 private:
  std::size_t own_ = 0;               // vertices that the values were given for
  std::vector<Vec3> values_, known_;  // known: places of the vertices when their values were found
};

}  // namespace cleft
