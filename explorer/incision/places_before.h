// Where the vertices of a mesh with cuts lie on the mesh before them, so that what its points have, such as
// colours, is carried to vertices that cuts have added or moved. It is asked after a cut: the steps of the
// cut do not know of it, and a mesh without such values does not pay for it.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "explorer/incision/cut_mesh.h"

namespace cleft {

class PlacesBefore {
 public:
  /// In a triangle: its points, and their barycentric weights, which sum to 1.
  struct Place {
    std::array<int, 3> point;
    std::array<double, 3> weight;
  };

  /// `before`: the mesh of which the CutMesh was made, in the same coordinates.
  explicit PlacesBefore(const SurfaceMesh& before);

  /// Of each vertex as it is now. Those of the skin are at the nearest place of the mesh before, in the
  /// neighbourhood of the vertices between which they were made, so that the two skins of a thin sheet stay
  /// apart; those below the skin are where the skin above them is. Only vertices that are new or have moved
  /// since the last call are searched.
  const std::vector<Place>& of(const CutMesh& mesh);

  /// Values of the points of the mesh before, as means by the weights, at each vertex.
  template <std::size_t N>
  std::vector<std::array<float, N>> carried(const CutMesh& mesh,
                                            const std::vector<std::array<float, N>>& values) {
    std::vector<std::array<float, N>> result;
    result.reserve(mesh.vertices().size());
    for (const Place& place : of(mesh)) {
      std::array<double, N> sum{};
      for (std::size_t corner = 0; corner < 3; ++corner)
        for (std::size_t k = 0; k < N; ++k)
          sum[k] += place.weight[corner] * values[static_cast<std::size_t>(place.point[corner])][k];
      auto& value = result.emplace_back();
      for (std::size_t k = 0; k < N; ++k) value[k] = static_cast<float>(sum[k]);
    }
    return result;
  }

 private:
  std::span<const std::size_t> triangles_at(int point) const;
  Place nearest(const Vec3& place, const std::vector<int>& around) const;

  std::vector<Vec3> points_;
  std::vector<std::array<int, 3>> triangles_;
  std::vector<std::size_t> first_, at_points_;  // triangles at point p: from first_[p] to first_[p + 1]
  std::vector<Place> places_;                   // of the vertices
  std::vector<Vec3> searched_;                  // the positions that they are of
};

}  // namespace cleft
