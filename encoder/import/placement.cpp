#include "encoder/import/placement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "encoder/import/boundary.h"

namespace cleft {

namespace {

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  double extent() const { return high - low; }
  double middle() const { return (low + high) / 2; }
};

Range range_along(const std::vector<Vec3>& points, const Vec3& axis) {
  Range range;
  for (const Vec3& p : points)
    range.low = std::min(range.low, dot(axis, p)), range.high = std::max(range.high, dot(axis, p));
  return range;
}

struct Point2 {
  double x, y;
};

/// Corners of the convex hull, counter-clockwise (Andrew's monotone chain).
std::vector<Point2> hull_of(std::vector<Point2> points) {
  std::sort(points.begin(), points.end(),
            [](const Point2& a, const Point2& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  std::vector<Point2> hull;
  const auto extend = [&hull](const Point2& p, std::size_t least) {
    while (hull.size() > least) {
      const Point2 &a = hull[hull.size() - 2], &b = hull.back();
      const double turn = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
      // Corners on a line, up to rounding, would give edges of any direction.
      if (turn > 1e-9 * std::hypot(b.x - a.x, b.y - a.y) * std::hypot(p.x - a.x, p.y - a.y)) break;
      hull.pop_back();
    }
    hull.push_back(p);
  };
  for (const Point2& p : points) extend(p, 1);
  const std::size_t lower = hull.size();
  for (std::size_t i = points.size() - 1; i-- > 0;) extend(points[i], lower);
  hull.pop_back();
  return hull;
}

/// The longer axis of a hull that is round and longer than wide, by its second moments: the smallest
/// rectangle around corners on an ellipse stands askew. None where it has straight sides, or is a circle.
/// `size`: of the rectangle.
std::optional<Point2> axes_of_round(const std::vector<Point2>& hull, double size) {
  constexpr double longest_side = 0.4, fullest = 0.9, circle = 1.1;
  double area = 0, longest = 0, xx = 0, xy = 0, yy = 0;
  Point2 centre{0, 0};
  const auto each_triangle = [&](const auto& use) {
    for (std::size_t i = 0; i < hull.size(); ++i) {
      const Point2 &a = hull[i], &b = hull[(i + 1) % hull.size()];
      use(a, b, (a.x * b.y - b.x * a.y) / 2);
    }
  };
  each_triangle([&](const Point2& a, const Point2& b, double part) {
    area += part, longest = std::max(longest, std::hypot(b.x - a.x, b.y - a.y));
    centre.x += part * (a.x + b.x) / 3, centre.y += part * (a.y + b.y) / 3;
  });
  if (!(area > 0) || longest > longest_side * size || area > fullest * size * size) return {};
  centre.x /= area, centre.y /= area;
  each_triangle([&](const Point2& a, const Point2& b, double part) {
    xx += part * (a.x * a.x + a.x * b.x + b.x * b.x) / 6,
        yy += part * (a.y * a.y + a.y * b.y + b.y * b.y) / 6;
    xy += part * (2 * a.x * a.y + a.x * b.y + b.x * a.y + 2 * b.x * b.y) / 12;
  });
  xx -= area * centre.x * centre.x, yy -= area * centre.y * centre.y, xy -= area * centre.x * centre.y;
  const double middle = (xx + yy) / 2, off = std::hypot((xx - yy) / 2, xy);
  if (middle + off < circle * circle * (middle - off)) return {};
  const double angle = std::atan2(2 * xy, xx - yy) / 2;
  return Point2{std::cos(angle), std::sin(angle)};
}

/// Along the sides of the smallest rectangle around the points, seen along `normal`, the longer one first; a
/// side of it lies on a side of the hull. Of points in an ellipse, its axes.
std::array<Vec3, 2> sides_of_rectangle(const std::vector<Vec3>& points, const Vec3& normal) {
  const Vec3 aside = std::abs(normal.x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 x = normalized(aside - dot(aside, normal) * normal), y = cross(normal, x);
  std::vector<Point2> flat;
  for (const Vec3& p : points) flat.push_back({dot(x, p), dot(y, p)});
  const std::vector<Point2> hull = hull_of(flat);
  std::array<Vec3, 2> best = {x, y};
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Point2 &a = hull[i], &b = hull[(i + 1) % hull.size()];
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    if (!(length > 0)) continue;
    const Vec3 along = ((b.x - a.x) / length) * x + ((b.y - a.y) / length) * y, across = cross(normal, along);
    const double p = range_along(points, along).extent(), q = range_along(points, across).extent();
    if (p * q < least * (1 - 1e-9)) {
      least = p * q;
      best = {along, across};
      if (p < q * (1 - 1e-9)) std::swap(best[0], best[1]);
    }
  }
  if (const auto axes = axes_of_round(hull, std::sqrt(least))) {
    best[0] = (*axes).x * x + (*axes).y * y;
    best[1] = cross(normal, best[0]);
  }
  return {snapped(best[0]), snapped(best[1])};
}

/// Makes `u` exactly orthogonal to the unit vector `v`.
Vec3 orthogonal(const Vec3& u, const Vec3& v) { return normalized(u - dot(u, v) * v); }

/// Whether the pairs open against u: later ones at smaller u. Those that never open tell only where all
/// others open at once, since they may lie beyond another arm. `frames`: never.
bool opens_backwards(const Break& found, const SourceMesh& mesh, std::int32_t frames, const Vec3& u) {
  const auto opens = [&](std::int32_t first) { return first < frames; };
  std::int32_t first = frames, last = 0;
  for (const std::int32_t frame : found.first_frame)
    if (opens(frame)) first = std::min(first, std::max(frame, 1)), last = std::max(last, frame);
  std::vector<double> place, frame;
  for (std::size_t p = 0; p < found.pairs.size(); ++p)
    if (opens(found.first_frame[p]) || last <= first)
      place.push_back(dot(u, mesh.points[found.pairs[p][0]])), frame.push_back(found.first_frame[p]);
  const auto count = static_cast<double>(place.size());
  double mean_place = 0, mean_frame = 0, covariance = 0, places = 0, frames_squared = 0;
  for (std::size_t i = 0; i < place.size(); ++i)
    mean_place += place[i] / count, mean_frame += frame[i] / count;
  for (std::size_t i = 0; i < place.size(); ++i) {
    const double x = place[i] - mean_place, f = frame[i] - mean_frame;
    covariance += x * f, places += x * x, frames_squared += f * f;
  }
  return covariance <
         -0.1 * std::sqrt(places * frames_squared);  // both ways at once, like a crack's two ends, is neither
}

/// How much of the differences between the frames in which pairs open the best parabola over their places
/// along the axis explains, 0 to 1. A parabola, since a crack may grow at both of its ends.
double growth_along(const Break& found, const SourceMesh& mesh, std::int32_t frames, const Vec3& axis) {
  std::vector<double> place, square, frame;
  for (std::size_t p = 0; p < found.pairs.size(); ++p)
    if (found.first_frame[p] < frames) {
      place.push_back(dot(axis, mesh.points[found.pairs[p][0]]));
      frame.push_back(found.first_frame[p]);
    }
  const auto product = [](const std::vector<double>& a, const std::vector<double>& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.);
  };
  const auto centre = [](std::vector<double>& list) {
    const double mean = std::accumulate(list.begin(), list.end(), 0.) / static_cast<double>(list.size());
    for (double& x : list) x -= mean;
  };
  centre(place), centre(frame);
  for (const double x : place) square.push_back(x * x);
  centre(square);
  const double places = product(place, place), differences = product(frame, frame);
  if (!(places > 0 && differences > 0)) return 0;
  const double slope = product(square, place) / places;
  for (std::size_t i = 0; i < square.size(); ++i) square[i] -= slope * place[i];
  const double squares = product(square, square), of_line = product(frame, place),
               of_square = product(frame, square);
  const double largest = places * places / static_cast<double>(place.size());
  const double by_square =
      squares > 1e-9 * largest ? of_square * of_square / squares : 0;  // else two columns
  return (of_line * of_line / places + by_square) / differences;
}

double volume(const std::vector<Vec3>& points, const std::array<Vec3, 3>& axes, bool is_flat) {
  double product = 1;
  for (int i = 0; i < (is_flat ? 2 : 3); ++i) product *= range_along(points, axes[i]).extent();
  return product;
}

}  // namespace

std::optional<Vec3> flatness(const SourceMesh& mesh) {
  const auto plane = common_plane(mesh.points, in_plane(mesh));
  if (!plane) return {};
  return plane->normal;
}

Placement placement_on(Break& found, const SourceMesh& mesh, std::int32_t frames,
                       const std::optional<Vec3>& flat) {
  std::vector<std::int32_t> doubled;
  std::vector<Vec3> places;
  for (const auto& [left, right] : found.pairs) {
    doubled.insert(doubled.end(), {left, right});
    places.push_back(mesh.points[left]);
  }
  if (places.empty()) places = mesh.points;

  Plane& plane = *found.plane;
  Vec3 w, u;
  bool open_above = false;
  if (flat) {
    w = *flat;
    u = cross(plane.normal, w);
  } else {
    const std::vector<Vec3> outward = outward_at(mesh, doubled);
    const auto faces_toward = [&](const Vec3& axis) {
      return std::count_if(outward.begin(), outward.end(), [&](const Vec3& o) { return dot(o, axis) > 0.7; });
    };
    const auto reaches_a_face = [&](const Vec3& axis) {
      return faces_toward(axis) + faces_toward(-axis) > 0;
    };
    const auto [longer, shorter] = sides_of_rectangle(places, plane.normal);
    const auto growth = [&](const Vec3& axis) { return growth_along(found, mesh, frames, axis); };
    // A front that is round moves along both. One below, which ends on both sides of the break, is its
    // bottom.
    const bool grows_along_shorter =
        growth(shorter) > 1.5 * growth(longer) && (reaches_a_face(longer) || !reaches_a_face(shorter));
    u = orthogonal(grows_along_shorter ? shorter : longer, plane.normal);
    w = forward(cross(u, plane.normal));
    if (faces_toward(-w) > faces_toward(w)) w = -w;
    open_above = reaches_a_face(w);
    u = cross(plane.normal, w);
  }
  if (opens_backwards(found, mesh, frames, u)) {
    u = -u;
    plane = {-plane.normal, -plane.offset};
    for (NodePair& pair : found.pairs) std::swap(pair[0], pair[1]);
    found.distance = [before = found.distance](const Vec3& p) { return -before(p); };
  }
  for (Vec3* axis : {&u, &plane.normal, &w}) *axis += Vec3{};  // no -0
  const double middle = range_along(places, u).middle();
  const double top = flat         ? dot(w, mesh.points.front())
                     : open_above ? range_along(places, w).high
                                  : range_along(mesh.points, w).high;
  return {middle * u + plane.offset * plane.normal + top * w, {u, plane.normal, w}};
}

Placement placement_in_box(const SourceMesh& mesh, Box box, const std::optional<Vec3>& flat) {
  std::array<Vec3, 3> aligned = Placement().axes;
  const auto upright = flat ? std::find(aligned.begin(), aligned.end(), *flat) : aligned.end() - 1;
  const bool can_be_aligned = upright != aligned.end();
  if (can_be_aligned)
    std::rotate(aligned.begin(), upright + 1, aligned.end());  // w is the flat mesh's normal
  const Spread spread = spread_of(mesh.points);
  const Vec3 w = flat ? *flat : forward(spread.axis[2]);
  const Vec3 u = orthogonal(forward(spread.axis[0]), w);
  const std::array<Vec3, 3> principal = {u, cross(w, u), w};

  const bool is_flat = flat.has_value();
  const bool turned = !can_be_aligned || box == Box::principal ||
                      (box == Box::smaller && volume(mesh.points, principal, is_flat) <=
                                                  0.8 * volume(mesh.points, aligned, is_flat));
  Placement placement;
  placement.axes = turned ? principal : aligned;
  const auto& [a, b, c] = placement.axes;
  placement.origin = range_along(mesh.points, a).middle() * a + range_along(mesh.points, b).middle() * b +
                     range_along(mesh.points, c).high * c;
  return placement;
}

}  // namespace cleft
