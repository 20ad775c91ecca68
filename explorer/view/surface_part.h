// The part of a wound's surface that is drawn in one manner: the skin, or the walls.
#pragma once

#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <functional>
#include <optional>
#include <vector>

#include "explorer/view/smooth_normals.h"

namespace cleft {

/// Has vertices of its own, so that normals are smooth within it and break at the lips. Ahead of the tip the
/// two lips lie on each other; there they share their normal, and the cut to come stays unseen.
class SurfacePart {
 public:
  /// The triangles whose region `belongs`. Those that no point that is `moving` (WoundScene::moving) reaches
  /// are drawn apart, so that a moment costs what moves, however large the rest.
  SurfacePart(const WoundSurface& surface, const std::function<bool(Region)>& belongs,
              const std::vector<bool>& moving = {});

  /// Rewrites points and normals in place.
  void move(const std::vector<Vec3>& points);

  /// Rewrites the colour scalar of every vertex from that of its point.
  void color(const std::function<double(int point)>& scalar);

  vtkPolyData* data() const { return moving_->data; }
  vtkPolyData* still() const { return still_->data; }  ///< without triangles where all moves

  /// The surface's points at the corners of a cell of data() or still().
  std::array<int, 3> corners(const vtkPolyData* of, std::size_t cell) const;

 private:
  struct Sheet {
    Sheet(const WoundSurface& surface, const std::vector<std::array<int, 3>>& triangles_of_points);
    void take(const std::vector<Vec3>& points);
    void put(const std::vector<Vec3>& points);  ///< with the normals there are
    void take_colors(const std::function<double(int)>& scalar);

    SmoothNormals shape;
    std::vector<Vec3> normal;  // of every vertex, as drawn
    vtkNew<vtkPolyData> data;
    vtkNew<vtkFloatArray> points, normals, scalars;
  };
  std::optional<Sheet> moving_, still_;
};

}  // namespace cleft
