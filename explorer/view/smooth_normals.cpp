#include "explorer/view/smooth_normals.h"

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

void make_unit(Vec3& n) { n = squared_norm(n) > 0 ? normalized(n) : Vec3{0, 0, 1}; }

}  // namespace

SmoothNormals::SmoothNormals(const WoundSurface& surface,
                             const std::vector<std::array<int, 3>>& triangles_of_points) {
  std::vector<int> number(surface.points.size(), -1);
  for (const std::array<int, 3>& points : triangles_of_points) {
    std::array<int, 3>& triangle = triangles_.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      int& vertex = number[points[i]];
      if (vertex < 0) {
        vertex = static_cast<int>(source_.size());
        source_.push_back(points[i]);
        if (points[i] >= surface.original_points) added_.push_back(vertex);
      }
      triangle[i] = vertex;
    }
  }
  std::unordered_map<Vec3, int, HashOfPlace> at_rest;
  at_rest.reserve(source_.size());
  for (std::size_t v = 0; v < source_.size(); ++v) {
    const Vec3& x = surface.points[source_[v]];
    const auto [first, fresh] = at_rest.try_emplace(x, static_cast<int>(v));
    if (!fresh) twins_.emplace_back(first->second, static_cast<int>(v));
  }
}

void SmoothNormals::share_with_twins(const std::vector<Vec3>& points, std::vector<Vec3>& normals) const {
  for (const auto& [a, b] : twins_)
    if (points[source_[a]] == points[source_[b]])
      normals[a] = normals[b] = normalized(normals[a] + normals[b]);
}

void SmoothNormals::keep_fixed(std::vector<Vec3>& normals) const {
  for (const auto& [vertex, normal] : fixed_) normals[vertex] = normal;
}

void SmoothNormals::soften(std::vector<Vec3>& normals) const {
  for (Vec3& n : normals) make_unit(n);
  keep_fixed(normals);
  if (added_.empty()) return;
  std::vector<Vec3> sums(normals.size());
  for (int pass = 0; pass < softening_passes; ++pass) {
    sums.assign(normals.size(), {});
    for (const auto& [a, b, c] : triangles_) {
      const Vec3 sum = normals[a] + normals[b] + normals[c];
      sums[a] += sum, sums[b] += sum, sums[c] += sum;
    }
    for (const int v : added_) make_unit(normals[v] = sums[v]);
    keep_fixed(normals);
  }
}

void SmoothNormals::of(const std::vector<Vec3>& points, std::vector<Vec3>& normals) const {
  normals.assign(source_.size(), {});
  for (const auto& [a, b, c] : triangles_) {
    const Vec3 &p = points[source_[a]], &q = points[source_[b]], &r = points[source_[c]];
    const Vec3 area = cross(q - p, r - p);
    normals[a] += area, normals[b] += area, normals[c] += area;
  }
  share_with_twins(points, normals);
  soften(normals);
  share_with_twins(points, normals);
  keep_fixed(normals);
}

void SmoothNormals::fix(const std::vector<Vec3>& known) {
  fixed_.clear();
  for (std::size_t v = 0; v < source_.size(); ++v)
    if (const Vec3& n = known[source_[v]]; squared_norm(n) > 0) fixed_.emplace_back(static_cast<int>(v), n);
}

}  // namespace cleft
