#include "explorer/incision/places_before.h"

#include <limits>
#include <numeric>

#include "base/nearest_weights.h"

namespace cleft {

PlacesBefore::PlacesBefore(const SurfaceMesh& before)
    : points_(before.points), triangles_(before.triangles), first_(before.points.size() + 1) {
  for (const auto& corners : triangles_)
    for (const int point : corners) ++first_[static_cast<std::size_t>(point) + 1];
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  at_points_.resize(first_.back());
  std::vector<std::size_t> next = first_;
  for (std::size_t t = 0; t < triangles_.size(); ++t)
    for (const int point : triangles_[t]) at_points_[next[static_cast<std::size_t>(point)]++] = t;
}

std::span<const std::size_t> PlacesBefore::triangles_at(int point) const {
  const std::size_t* const all = at_points_.data();
  const auto p = static_cast<std::size_t>(point);
  return {all + first_[p], all + first_[p + 1]};
}

/// From the triangles at these points on, towards ever nearer ones.
PlacesBefore::Place PlacesBefore::nearest(const Vec3& place, const std::vector<int>& around) const {
  Place best{{around.front(), around.front(), around.front()}, {1, 0, 0}};
  double least = std::numeric_limits<double>::infinity();
  std::vector<int> from = around;
  for (bool nearer = true; nearer;) {
    nearer = false;
    for (const int point : from)
      for (const std::size_t t : triangles_at(point)) {
        const auto& corner = triangles_[t];
        const auto at = [&](std::size_t i) { return points_[static_cast<std::size_t>(corner[i])]; };
        const std::array<double, 3> weight = nearest_weights(place, at(0), at(1), at(2));
        const double distance =
            squared_norm(weight[0] * at(0) + weight[1] * at(1) + weight[2] * at(2) - place);
        if (distance < least) least = distance, best = {corner, weight}, nearer = true;
      }
    from.assign(best.point.begin(), best.point.end());
  }
  return best;
}

const std::vector<PlacesBefore::Place>& PlacesBefore::of(const CutMesh& mesh) {
  const std::vector<CutMesh::Vertex>& vertices = mesh.vertices();
  places_.resize(vertices.size());
  const std::size_t known = searched_.size();
  searched_.resize(vertices.size());
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const CutMesh::Vertex& vertex = vertices[v];
    if (v < known && searched_[v] == vertex.position) continue;
    searched_[v] = vertex.position;
    const int own = static_cast<int>(v);
    if (v < points_.size() && vertex.position == points_[v]) {
      places_[v] = {{own, own, own}, {1, 0, 0}};
      continue;
    }
    if (vertex.depth > 0) {  // its parents come before it
      places_[v] = places_[static_cast<std::size_t>(vertex.parents[0])];
      continue;
    }
    std::vector<int> around;
    if (v < points_.size()) around.push_back(own);
    for (const int parent : vertex.parents)
      if (parent >= 0)
        for (const int point : places_[static_cast<std::size_t>(parent)].point) around.push_back(point);
    places_[v] = nearest(vertex.position, around);
  }
  return places_;
}

}  // namespace cleft
