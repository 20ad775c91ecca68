#include "explorer/incision/near_ends.h"

#include <algorithm>
#include <cmath>

namespace cleft {

namespace {

constexpr double least_approach = 0.2;  // of the way that an end goes: flatter, it runs beside the other path
constexpr double beyond = 0.2;          // of `near`: how far an end is moved over the other path
constexpr double rounding = 1e-3;       // of `near`: gaps that differ by no more are the same; 0: it is on it

/// Of an end just before the other path: how far from it, and how much farther it has to go to be just
/// beyond.
struct Approach {
  double gap, way;
};
std::optional<Approach> approach_of(const ScalpelPath& path, bool start, const ScalpelPath& other,
                                    double near) {
  const double s = start ? 0 : path.length(), back = std::min(4 * near, path.length() / 2);
  const PathCoordinates end = other.coordinates(path.at(s).position),
                        before = other.coordinates(path.at(start ? back : s - back).position);
  const double gap = std::abs(end.v) < rounding * near ? 0 : std::abs(end.v);
  if (end.s < 0 || end.s > other.length() || gap > (1 + rounding) * near || std::abs(end.w) > near)
    return std::nullopt;
  const double approach = (before.v * ((gap > 0 ? end.v : before.v) < 0 ? -1 : 1) - gap) / back;
  // A start on the other path is on its lip; an end would come as near to it as rounding has it.
  if (approach < least_approach || (start && gap == 0)) return std::nullopt;
  return Approach{gap, (gap + beyond * near) / approach};
}

ScalpelPath with_end_moved(const ScalpelPath& path, bool start, double way) {
  std::vector<ScalpelPath::Point> points;
  for (const double s : path.given()) {
    const PathFrame at = path.at(s);
    points.push_back({at.position, at.outward, path.depth(s)});
  }
  ScalpelPath::Point& end = start ? points.front() : points.back();
  end.position += way * (start ? -1. * path.at(0).along : path.at(path.length()).along);
  return ScalpelPath(points);
}

}  // namespace

std::optional<double> way_over(const ScalpelPath& path, bool start, const ScalpelPath& other, double near,
                               double beyond) {
  const PathFrame end = path.at(start ? 0 : path.length());
  const Vec3 on = start ? -1. * end.along : end.along;
  const PathCoordinates from = other.coordinates(end.position),
                        to = other.coordinates(end.position + near * on);
  if (from.v * to.v >= 0) return std::nullopt;
  const double approach = std::abs(to.v - from.v) / near, way = std::abs(from.v) / approach;
  const PathCoordinates there = other.coordinates(end.position + way * on);
  if (approach < least_approach || there.s < 0 || there.s > other.length() || std::abs(there.w) > near)
    return std::nullopt;
  return way + beyond / approach;
}

JoinedPaths with_near_ends_joined(std::vector<ScalpelPath> paths, double near) {
  JoinedPaths joined{std::move(paths), {}};
  for (std::size_t i = 0; i < joined.paths.size(); ++i)
    for (const bool start : {true, false})
      for (std::size_t j = 0; j < joined.paths.size(); ++j) {
        ScalpelPath& path = joined.paths[i];
        if (i == j) continue;
        const auto approach = approach_of(path, start, joined.paths[j], near);
        if (!approach) continue;
        if (approach->gap > 0)
          joined.ends.push_back({static_cast<int>(i), static_cast<int>(j), start, approach->gap});
        path = with_end_moved(path, start, approach->way);
        break;
      }
  return joined;
}

}  // namespace cleft
