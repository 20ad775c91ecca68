#include "explorer/view/surface_part.h"

#include <vtkCellArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>

#include <functional>
#include <unordered_map>

namespace cleft {

namespace {

struct HashOfPlace {
  std::size_t operator()(const Vec3& x) const {
    const std::hash<double> hash;
    return (hash(x.x) * 1000003 ^ hash(x.y)) * 1000003 ^ hash(x.z);
  }
};

}  // namespace

SurfacePart::SurfacePart(const WoundSurface& surface, const std::function<bool(Region)>& belongs) {
  std::vector<int> number(surface.points.size(), -1);
  vtkNew<vtkCellArray> cells;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    if (!belongs(surface.regions[t])) continue;
    std::array<int, 3> triangle;
    cells->InsertNextCell(3);
    for (int i = 0; i < 3; ++i) {
      int& vertex = number[surface.triangles[t][i]];
      if (vertex < 0) {
        vertex = static_cast<int>(source_.size());
        source_.push_back(surface.triangles[t][i]);
        added_.push_back(surface.triangles[t][i] >= surface.original_points);
        any_added_ = any_added_ || added_.back();
      }
      triangle[i] = vertex;
      cells->InsertCellPoint(vertex);
    }
    triangles_.push_back(triangle);
  }

  std::unordered_map<Vec3, int, HashOfPlace> at_rest;
  at_rest.reserve(source_.size());
  for (std::size_t v = 0; v < source_.size(); ++v) {
    const Vec3& x = surface.points[source_[v]];
    const auto [first, fresh] = at_rest.try_emplace(x, static_cast<int>(v));
    if (!fresh) twins_.emplace_back(first->second, static_cast<int>(v));
  }

  for (vtkFloatArray* array : {points_.Get(), normals_.Get()}) array->SetNumberOfComponents(3);
  for (vtkFloatArray* array : {points_.Get(), normals_.Get(), scalars_.Get()})
    array->SetNumberOfTuples(static_cast<vtkIdType>(source_.size()));
  scalars_->Fill(0);
  vtkNew<vtkPoints> points;
  points->SetData(points_);
  data_->SetPoints(points);
  data_->SetPolys(cells);
  data_->GetPointData()->SetNormals(normals_);
  data_->GetPointData()->SetScalars(scalars_);
  move(surface.points);
}

void SurfacePart::share_with_twins(std::vector<Vec3>& normals, const std::vector<Vec3>& points) const {
  for (const auto& [a, b] : twins_)
    if (points[source_[a]] == points[source_[b]])
      normals[a] = normals[b] = normalized(normals[a] + normals[b]);
}

void SurfacePart::soften(std::vector<Vec3>& normals) const {
  const auto to_unit_length = [&normals] {
    for (Vec3& n : normals) n = squared_norm(n) > 0 ? normalized(n) : Vec3{0, 0, 1};
  };
  to_unit_length();
  if (!any_added_) return;
  for (int pass = 0; pass < 4; ++pass) {
    std::vector<Vec3> sums(normals.size());
    for (const auto& [a, b, c] : triangles_) {
      const Vec3 sum = normals[a] + normals[b] + normals[c];
      sums[a] += sum, sums[b] += sum, sums[c] += sum;
    }
    for (std::size_t v = 0; v < normals.size(); ++v)
      if (added_[v]) normals[v] = sums[v];
    to_unit_length();
  }
}

void SurfacePart::move(const std::vector<Vec3>& points) {
  std::vector<Vec3> normals(source_.size());
  for (const auto& [a, b, c] : triangles_) {
    const Vec3 &p = points[source_[a]], &q = points[source_[b]], &r = points[source_[c]];
    const Vec3 area = cross(q - p, r - p);
    normals[a] += area, normals[b] += area, normals[c] += area;
  }
  share_with_twins(normals, points);
  soften(normals);
  share_with_twins(normals, points);
  float* x = points_->GetPointer(0);
  float* n = normals_->GetPointer(0);
  for (std::size_t v = 0; v < source_.size(); ++v) {
    for (int i = 0; i < 3; ++i) {
      x[3 * v + i] = static_cast<float>(points[source_[v]][i]);
      n[3 * v + i] = static_cast<float>(normals[v][i]);
    }
  }
  points_->Modified();
  normals_->Modified();
  data_->GetPoints()->Modified();
  data_->Modified();
}

void SurfacePart::color(const std::function<double(int)>& scalar) {
  float* value = scalars_->GetPointer(0);
  for (std::size_t v = 0; v < source_.size(); ++v) value[v] = static_cast<float>(scalar(source_[v]));
  scalars_->Modified();
  data_->Modified();
}

}  // namespace cleft
