// A part of a wound's surface with one appearance: the skin, or the walls.
#pragma once

#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

#include <functional>
#include <optional>
#include <vector>

#include "explorer/view/open_sky.h"
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

  /// Gives every vertex the light of its point, in the array `light_array` of two components: open, dry; and
  /// its place at rest, in `rest_array`, to which its grain sticks.
  void light(const std::vector<SurfaceLight::Light>& of_points, const std::vector<Vec3>& rest);
  static constexpr const char *light_array = "light", *rest_array = "rest";

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
    void take_light(const std::vector<SurfaceLight::Light>& of_points, const std::vector<Vec3>& rest);
    void add_array(vtkFloatArray* array, const char* name, int components);

    SmoothNormals shape;
    std::vector<Vec3> normal;  // of every vertex, as drawn
    vtkNew<vtkPolyData> data;
    vtkNew<vtkFloatArray> points, normals, scalars;
    vtkNew<vtkFloatArray> light, rest;   // part of the data once there is any
    vtkNew<vtkUnsignedCharArray> paint;  // likewise
  };
  std::optional<Sheet> moving_, still_;
};

}  // namespace cleft
