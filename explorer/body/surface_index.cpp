#include "explorer/body/surface_index.h"

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/iterator/function_output_iterator.hpp>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

#include "base/nearest_weights.h"
#include "haptic/triangle_geometry.h"

namespace cleft {

namespace {

namespace bg = boost::geometry;
using Point = bg::model::point<double, 3, bg::cs::cartesian>;
using Box = bg::model::box<Point>;
using BoxOfTriangle = std::pair<Box, int>;

constexpr unsigned first_boxes = 16;

Point point_of(const Vec3& p) { return {p.x, p.y, p.z}; }

Box box_of(std::initializer_list<Vec3> points) {
  Vec3 least = *points.begin(), most = least;
  for (const Vec3& p : points)
    for (int axis = 0; axis < 3; ++axis) {
      least[axis] = std::min(least[axis], p[axis]);
      most[axis] = std::max(most[axis], p[axis]);
    }
  return {point_of(least), point_of(most)};
}

}  // namespace

struct SurfaceIndex::Tree {
  explicit Tree(SurfaceMesh mesh) : surface(std::move(mesh)), boxes(entries()) {}

  Corners corners(int t) const {
    const auto& [a, b, c] = surface.triangles[t];
    return {surface.points[a], surface.points[b], surface.points[c]};
  }

  std::vector<BoxOfTriangle> entries() const {
    std::vector<BoxOfTriangle> list;
    for (int t = 0; t < static_cast<int>(surface.triangles.size()); ++t) {
      const auto [a, b, c] = corners(t);
      list.emplace_back(box_of({a, b, c}), t);
    }
    return list;
  }

  SurfaceMesh surface;
  bg::index::rtree<BoxOfTriangle, bg::index::rstar<16>> boxes;
};

SurfaceIndex::SurfaceIndex(SurfaceMesh surface) : tree_(std::make_unique<Tree>(std::move(surface))) {}
SurfaceIndex::~SurfaceIndex() = default;
SurfaceIndex::SurfaceIndex(SurfaceIndex&&) noexcept = default;

const SurfaceMesh& SurfaceIndex::surface() const { return tree_->surface; }

template <class Counts>
SurfacePlace SurfaceIndex::nearest_of(const Vec3& x, double reach, const Counts& counts) const {
  SurfacePlace best;
  double least = reach * reach;
  // The nearest boxes, more and more of them, until those left out are further away than the best triangle.
  // (Boost's iterator over all of them sorts what it has found again and again.)
  std::vector<std::pair<double, int>> found;
  for (unsigned most = first_boxes;; most *= 4) {
    std::size_t looked_at = 0;
    found.clear();
    tree_->boxes.query(bg::index::nearest(point_of(x), most),
                       boost::make_function_output_iterator([&](const BoxOfTriangle& e) {
                         found.emplace_back(bg::comparable_distance(point_of(x), e.first), e.second);
                       }));
    std::sort(found.begin(), found.end());
    for (; looked_at < found.size() && found[looked_at].first <= least; ++looked_at) {
      const int number = found[looked_at].second;
      const Corners corners = tree_->corners(number);
      if (!counts(corners)) continue;
      const Vec3 at = closest_point(x, corners).position;
      const double distance = squared_norm(at - x);
      if (distance < least || (best.triangle < 0 && distance <= least))
        least = distance, best.triangle = number;
    }
    if (looked_at < found.size() || found.size() < most) break;
  }
  return best.triangle < 0 ? best : nearest_on(best.triangle, x);
}

SurfacePlace SurfaceIndex::nearest_on(int triangle, const Vec3& x) const {
  const Corners corners = tree_->corners(triangle);
  return {triangle, closest_point(x, corners).position,
          nearest_weights(x, corners[0], corners[1], corners[2])};
}

SurfacePlace SurfaceIndex::nearest(const Vec3& x) const {
  return nearest_of(x, std::numeric_limits<double>::infinity(), [](const Corners&) { return true; });
}

SurfacePlace SurfaceIndex::nearest(const Vec3& x, const Vec3& normal, double reach) const {
  return nearest_of(x, reach, [&](const Corners& c) { return dot(scaled_normal(c), normal) > 0; });
}

std::optional<double> SurfaceIndex::meets(const Vec3& from, const Vec3& way) const {
  std::optional<double> first;
  for (auto entry = tree_->boxes.qbegin(bg::index::intersects(box_of({from, from + way})));
       entry != tree_->boxes.qend(); ++entry)
    if (const Passage p = pass_through(from, from + way, tree_->corners(entry->second));
        p.passes && (!first || p.fraction < *first))
      first = p.fraction;
  return first;
}

std::function<double(const Vec3&, const Vec3&)> distance_to(std::shared_ptr<const SurfaceIndex> surface) {
  return [surface = std::move(surface)](const Vec3& place, const Vec3& direction) {
    constexpr double farthest = 100;
    const auto part = surface->meets(place, farthest * direction);
    return part ? *part * farthest : std::numeric_limits<double>::infinity();
  };
}

std::function<double(const Vec3&)> least_distance_to(std::shared_ptr<const SurfaceIndex> surface) {
  return [surface = std::move(surface)](const Vec3& place) {
    return norm(surface->nearest(place).position - place);
  };
}

}  // namespace cleft
