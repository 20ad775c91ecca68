#include "explorer/view/surface_part.h"

#include <vtkCellArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>

namespace cleft {

namespace {

using Triangles = std::vector<std::array<int, 3>>;

/// The points whose place or normal can change with time.
std::vector<bool> changing(const SmoothNormals& shape, std::vector<bool> points) {
  for (int ring = 0; ring <= softening_passes; ++ring) {
    std::vector<bool> wider = points;
    for (const auto& [a, b, c] : shape.triangles()) {
      const int p[] = {shape.source()[a], shape.source()[b], shape.source()[c]};
      if (points[p[0]] || points[p[1]] || points[p[2]]) wider[p[0]] = wider[p[1]] = wider[p[2]] = true;
    }
    for (const auto& [a, b] : shape.twins())
      if (wider[shape.source()[a]] || wider[shape.source()[b]])
        wider[shape.source()[a]] = wider[shape.source()[b]] = true;
    points.swap(wider);
  }
  return points;
}

}  // namespace

SurfacePart::Sheet::Sheet(const WoundSurface& surface, const Triangles& triangles_of_points)
    : shape(surface, triangles_of_points) {
  const auto count = static_cast<vtkIdType>(shape.source().size());
  for (vtkFloatArray* array : {points.Get(), normals.Get()}) array->SetNumberOfComponents(3);
  for (vtkFloatArray* array : {points.Get(), normals.Get(), scalars.Get()}) array->SetNumberOfTuples(count);
  scalars->Fill(0);
  vtkNew<vtkCellArray> cells;
  for (const auto& [a, b, c] : shape.triangles()) cells->InsertNextCell({a, b, c});
  vtkNew<vtkPoints> places;
  places->SetData(points);
  data->SetPoints(places);
  data->SetPolys(cells);
  data->GetPointData()->SetNormals(normals);
  data->GetPointData()->SetScalars(scalars);
}

void SurfacePart::Sheet::take(const std::vector<Vec3>& places) {
  shape.of(places, normal);
  put(places);
}

void SurfacePart::Sheet::put(const std::vector<Vec3>& places) {
  float* x = points->GetPointer(0);
  float* n = normals->GetPointer(0);
  for (std::size_t v = 0; v < normal.size(); ++v) {
    for (int i = 0; i < 3; ++i) {
      x[3 * v + i] = static_cast<float>(places[shape.source()[v]][i]);
      n[3 * v + i] = static_cast<float>(normal[v][i]);
    }
  }
  points->Modified();
  normals->Modified();
  data->GetPoints()->Modified();
  data->Modified();
}

void SurfacePart::Sheet::take_colors(const std::function<double(int)>& scalar) {
  float* value = scalars->GetPointer(0);
  bool changed = false;
  for (std::size_t v = 0; v < shape.source().size(); ++v) {
    const auto now = static_cast<float>(scalar(shape.source()[v]));
    changed = changed || now != value[v];
    value[v] = now;
  }
  if (!changed) return;
  scalars->Modified();
  data->Modified();
}

void SurfacePart::Sheet::take_paint(const std::function<PointColor(int)>& color) {
  paint->SetName(painted);
  paint->SetNumberOfComponents(3);
  paint->SetNumberOfTuples(static_cast<vtkIdType>(shape.source().size()));
  unsigned char* to = paint->GetPointer(0);
  for (const int point : shape.source())
    for (const std::uint8_t part : byte_color(color(point))) *to++ = part;
  paint->Modified();
  data->GetPointData()->AddArray(paint);
  data->Modified();
}

void SurfacePart::Sheet::add_array(vtkFloatArray* array, const char* name, int components) {
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(shape.source().size()));
  data->GetPointData()->AddArray(array);
}

void SurfacePart::Sheet::take_light(const std::vector<SurfaceLight::Light>& of_points,
                                    const std::vector<Vec3>& places) {
  const bool fresh = !data->GetPointData()->HasArray(light_array);
  if (fresh) {
    add_array(light, light_array, 2);
    add_array(rest, rest_array, 3);
    float* to = rest->GetPointer(0);
    for (const int point : shape.source())
      for (int k = 0; k < 3; ++k) *to++ = static_cast<float>(places[point][k]);
  }
  float* to = light->GetPointer(0);
  bool changed = fresh;
  for (const int point : shape.source()) {
    const auto& [open, dry] = of_points[point];
    changed = changed || to[0] != open || to[1] != dry;
    *to++ = open, *to++ = dry;
  }
  if (!changed) return;
  light->Modified();
  data->Modified();
}

SurfacePart::SurfacePart(const WoundSurface& surface, const std::function<bool(Region)>& belongs,
                         const std::vector<bool>& moving) {
  Triangles all;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    if (belongs(surface.regions[t])) all.push_back(surface.triangles[t]);
  if (moving.empty()) {
    moving_.emplace(surface, all), still_.emplace(surface, Triangles());
    moving_->take(surface.points);
    return;
  }
  const SmoothNormals whole(surface, all);
  std::vector<Vec3> normals, still_normals(surface.points.size());
  whole.of(surface.points, normals);
  const std::vector<bool> changes = changing(whole, moving);
  for (std::size_t v = 0; v < normals.size(); ++v)
    if (const int point = whole.source()[v]; !changes[point]) still_normals[point] = normals[v];
  Triangles parts[2];
  for (const std::array<int, 3>& t : all) parts[changes[t[0]] || changes[t[1]] || changes[t[2]]].push_back(t);
  moving_.emplace(surface, parts[1]), still_.emplace(surface, parts[0]);
  moving_->shape.fix(still_normals);
  moving_->take(surface.points);
  for (const int point : still_->shape.source()) still_->normal.push_back(still_normals[point]);
  still_->put(surface.points);
}

void SurfacePart::move(const std::vector<Vec3>& points) { moving_->take(points); }

void SurfacePart::color(const std::function<double(int)>& scalar) {
  moving_->take_colors(scalar);
  still_->take_colors(scalar);
}

void SurfacePart::paint(const std::function<PointColor(int)>& color) {
  moving_->take_paint(color);
  still_->take_paint(color);
}

void SurfacePart::light(const std::vector<SurfaceLight::Light>& of_points, const std::vector<Vec3>& rest) {
  moving_->take_light(of_points, rest);
  still_->take_light(of_points, rest);
}

std::array<int, 3> SurfacePart::corners(const vtkPolyData* of, std::size_t cell) const {
  const SmoothNormals& shape = (of == still() ? still_ : moving_)->shape;
  const auto& t = shape.triangles().at(cell);
  return {shape.source()[t[0]], shape.source()[t[1]], shape.source()[t[2]]};
}

}  // namespace cleft
