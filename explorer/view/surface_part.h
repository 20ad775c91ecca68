// The part of a wound's surface that is drawn in one manner: the skin, or the walls.
#pragma once

#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <functional>
#include <vector>

#include "explorer/scene/wound_scene.h"

namespace cleft {

/// Has vertices of its own, so that normals are smooth within it and break at the lips. Ahead of the tip the
/// two lips lie on each other; there they share their normal, and the cut to come stays unseen.
class SurfacePart {
 public:
  /// The triangles whose region `belongs`.
  SurfacePart(const WoundSurface& surface, const std::function<bool(Region)>& belongs);

  /// Rewrites points and normals in place.
  void move(const std::vector<Vec3>& points);

  /// Rewrites the colour scalar of every vertex from that of its point.
  void color(const std::function<double(int point)>& scalar);

  /// The surface's points at the corners of a cell.
  std::array<int, 3> corners(std::size_t cell) const {
    const auto& t = triangles_.at(cell);
    return {source_[static_cast<std::size_t>(t[0])], source_[static_cast<std::size_t>(t[1])],
            source_[static_cast<std::size_t>(t[2])]};
  }

  vtkPolyData* data() const { return data_; }

 private:
  void share_with_twins(std::vector<Vec3>& normals, const std::vector<Vec3>& points) const;
  /// Makes normals unit vectors, and those of added points the mean of their neighbours': where a cut has
  /// refined large flat triangles, their facets would show.
  void soften(std::vector<Vec3>& normals) const;

  std::vector<int> source_;                    ///< the surface's point of every vertex
  std::vector<std::array<int, 3>> triangles_;  ///< of vertices
  std::vector<bool> added_;                    ///< by the cut, for every vertex
  bool any_added_ = false;
  std::vector<std::pair<int, int>> twins_;  ///< vertices at the same place at rest
  vtkNew<vtkPolyData> data_;
  vtkNew<vtkFloatArray> points_, normals_, scalars_;
};

}  // namespace cleft
