// A part of a wound's surface with one appearance: the skin, or the walls.
#pragma once

#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

#include <functional>
#include <optional>
#include <vector>

#include "explorer/view/smooth_normals.h"

namespace cleft {

/// It has its own vertices, so that normals are smooth within it and discontinuous at the lips. Ahead of the
/// tip the two lips coincide and share their normal, so that the cut to come is invisible.
class SurfacePart {
 public:
  /// The triangles whose region `belongs`. Triangles without a `moving` point (WoundScene::moving) are drawn
  /// separately, so that the cost of a frame depends only on what moves.
  SurfacePart(const WoundSurface& surface, const std::function<bool(Region)>& belongs,
              const std::vector<bool>& moving = {});

  /// Rewrites points and normals in place.
  void move(const std::vector<Vec3>& points);

  /// Rewrites the colour scalar of every vertex from that of its point.
  void color(const std::function<double(int point)>& scalar);

  /// Gives every vertex the colour of its point, in bytes, in the array `painted`.
  void paint(const std::function<PointColor(int point)>& color);
  static constexpr const char* painted = "painted";

  vtkPolyData* data() const { return moving_->data; }
  vtkPolyData* still() const { return still_->data; }  ///< without triangles if all moves

  /// The surface's points at the corners of a cell of data() or still().
  std::array<int, 3> corners(const vtkPolyData* of, std::size_t cell) const;

 private:
  struct Sheet {
    Sheet(const WoundSurface& surface, const std::vector<std::array<int, 3>>& triangles_of_points);
    void take(const std::vector<Vec3>& points);
    void put(const std::vector<Vec3>& points);  ///< with the normals there are
    void take_colors(const std::function<double(int)>& scalar);
    void take_paint(const std::function<PointColor(int)>& color);

    SmoothNormals shape;
    std::vector<Vec3> normal;  // of every vertex, as drawn
    vtkNew<vtkPolyData> data;
    vtkNew<vtkFloatArray> points, normals, scalars;
    vtkNew<vtkUnsignedCharArray> paint;  // part of the data once there is any
  };
  std::optional<Sheet> moving_, still_;
};

}  // namespace cleft
