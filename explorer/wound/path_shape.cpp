#include "explorer/wound/path_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include "base/error.h"
#include "base/stations.h"
#include "base/text.h"
#include "explorer/wound/skin_fit.h"
#include "explorer/wound/small_fit.h"

namespace cleft {

namespace {

/// Stations, and places where the normal is found, in the length of the smoothing, and the most of a path.
constexpr double stations_a_smoothing = 4, nodes_a_smoothing = 2, most_pieces = 1024;
/// Points that a fit of the path takes at least, where there are so many, and by how much its distance grows
/// to have them. Places between points count as points where these are further apart, in smoothings.
constexpr std::size_t least_points = 5;
constexpr double growth = 1.25, sparse = 1.5;
/// What draws the path's curvature (`straight`), and the rate at which it changes (`steady`), towards 0, in
/// units of the smoothing: nothing beside what points over twice the smoothing tell, and much of it beside a
/// fifth of the smoothing. The rate is the coefficient of a cubic, which a hand's tremor of some tenths of a
/// millimetre hides over short ways. Over twice the way the cubic is eight times as high, and its square 64
/// times: with a smoothing above `hand`, in mm, the rate is drawn to 0 less by its sixth power.
constexpr double straight = 1e-6, steady = 2e-2, hand = 6;
/// Half the way over which the path's direction is that of a chord, in smoothings.
constexpr double chord = 1e-2;
/// Places within the smoothing, on each side, that the blade's tilt is a mean of.
constexpr int tilt_places = 4;
/// How far the vertices of the skin that a place needs are from it, at most, in smoothings.
constexpr double farthest = 8;

double above_0(double x, const std::string& what) {
  if (!(x > 0 && std::isfinite(x)))
    throw InputError("the " + what + " is " + shortest(x) + "; it must be above 0, and finite");
  return x;
}

double falling(double part) { return part < 1 ? (1 - part * part) * (1 - part * part) : 0; }

/// A place of the unrolled path: mm from the station, along the path's direction there and across it.
struct Unrolled {
  double x, y, s;
};

/// Everything in mm.
class Shapes {
 public:
  /// For places from one to another.
  Shapes(const Incision& incision, double scale, const Smoothing& smoothing, double from, double to)
      : incision_(incision),
        scale_(above_0(scale, "scale")),
        path_smoothing_(above_0(smoothing.path, "smoothing")),
        smoothing_(above_0(smoothing.skin, "smoothing")),
        end_((incision.extended_to() > 0 ? incision.extended_to() : incision.path().length()) * scale),
        skin_(incision, scale, from - farthest * reach(smoothing), to + farthest * reach(smoothing)),
        normals_(pieces(nodes_a_smoothing) + 1) {
    find_points();
  }

  /// In how many even pieces the path is parted, so many or more in the length of the smoothing.
  std::size_t pieces(double a_smoothing) const {
    return static_cast<std::size_t>(std::clamp(std::ceil(a_smoothing * end_ / smoothing_), 1., most_pieces));
  }
  double end() const { return end_; }

  LocalShape at(double s) {
    s = std::clamp(s, 0., end_);
    LocalShape shape;
    const Vec3 outward = normal(s);
    Vec3 along = direction(s, outward);
    shape.tilt = tilt(s);
    shape.depth = incision_.path().depth(s / scale_) * scale_;
    const auto [curvature, rate, turned] = bend(s, outward, along);
    shape.curvature = curvature, shape.curvature_rate = rate;
    along = std::cos(turned) * along + std::sin(turned) * cross(outward, along);
    shape.along = along, shape.outward = outward;
    if (const auto skin = skin_.at(s, outward, along, smoothing_))
      shape.skin_u = skin->uu, shape.skin_v = skin->vv, shape.skin_uv = skin->uv,
      shape.skin_uneven = skin->uneven;
    return shape;
  }

 private:
  static double reach(const Smoothing& smoothing) { return std::max(smoothing.skin, smoothing.path / 2); }

  Vec3 place(double s) const { return scale_ * incision_.path().at(s / scale_).position; }

  void find_points() {
    for (const double given : incision_.path().given()) {
      const double s = given * scale_;
      if (s > end_) break;
      if (!points_.empty()) {
        const double from = points_.back();
        const double pieces = std::ceil((s - from) / (sparse * path_smoothing_));
        for (int i = 1; i < pieces && i < most_pieces; ++i) points_.push_back(from + (s - from) * i / pieces);
      }
      points_.push_back(s);
    }
  }

  /// The skin's normal, between nodes of which each is found once.
  Vec3 normal(double s) {
    const double place = s / end_ * static_cast<double>(normals_.size() - 1);
    const auto before = std::min(static_cast<std::size_t>(std::max(0., place)), normals_.size() - 2);
    const Vec3 sum = lerp(node(before), node(before + 1), place - static_cast<double>(before));
    return norm(sum) > 0 ? normalized(sum) : node(before);
  }

  const Vec3& node(std::size_t i) {
    std::optional<Vec3>& found = normals_[i];
    if (!found) {
      const double s = end_ * static_cast<double>(i) / static_cast<double>(normals_.size() - 1);
      found = skin_.mean_normal(s, smoothing_);
      if (const auto fit = skin_.at(s, *found, direction(s, *found), smoothing_)) found = fit->outward;
    }
    return *found;
  }

  /// The path's direction in the skin.
  Vec3 direction(double s, const Vec3& outward) const {
    const double half = std::min(chord * smoothing_, end_ / 2);
    const double middle = std::clamp(s, half, end_ - half);
    const Vec3 way = place(middle + half) - place(middle - half), along = way - dot(way, outward) * outward;
    return norm(along) > 0 ? normalized(along) : incision_.path().at(s / scale_).along;
  }

  double tilt(double s) {
    SmallFit<2> fit;
    double sum = 0, weights = 0;
    for (int k = 1 - tilt_places; k < tilt_places; ++k) {
      const double part = static_cast<double>(k) / tilt_places, there = s + part * smoothing_;
      if (there < 0 || there > end_) continue;
      const Vec3 outward = normal(there), across = cross(outward, direction(there, outward)),
                 blade = incision_.path().at(there / scale_).outward;
      const double angle = std::atan2(-dot(blade, across), dot(blade, outward)) * 180 / std::numbers::pi;
      fit.add({1, part}, angle, falling(std::abs(part)));
      sum += falling(std::abs(part)) * angle, weights += falling(std::abs(part));
    }
    const auto found = fit.solve();
    return found ? (*found)[0] : sum / weights;
  }

  /// The path from s on to one side, unrolled as far as `to`: each piece turns against the one before as it
  /// does in the skin's tangent plane between them.
  template <class Places>
  void unroll(double s, Vec3 outward, Vec3 along, const Places& places, std::vector<Unrolled>& unrolled) {
    double angle = 0;
    Unrolled at{0, 0, s};
    Vec3 from = place(s);
    for (const double to : places) {
      const Vec3 next = place(to), way = next - from, in_skin = way - dot(way, outward) * outward;
      const double length = norm(way);
      if (norm(in_skin) > 0) angle += std::atan2(dot(cross(along, in_skin), outward), dot(along, in_skin));
      at = {at.x + length * std::cos(angle), at.y + length * std::sin(angle), to};
      unrolled.push_back(at);
      if (!(length > 0)) continue;
      outward = normal(to), from = next;
      along = way - dot(way, outward) * outward;
    }
  }

  struct Bend {
    double curvature, rate;  // 1/mm, 1/mm^2
    double turned;           // the path's smooth direction against the one at hand
  };

  Bend bend(double s, const Vec3& outward, const Vec3& along) {
    double half = path_smoothing_, from = 0, to = 0;
    std::vector<double> back, ahead;
    for (;; half *= growth) {
      from = std::max(0., std::min(s - half, end_ - 2 * half)),
      to = std::min(end_, std::max(s + half, 2 * half));
      back.clear(), ahead.clear();
      for (const double point : points_)
        if (point >= from && point <= to) (point < s ? back : ahead).push_back(point);
      if (back.size() + ahead.size() >= std::min(least_points, points_.size())) break;
    }
    std::reverse(back.begin(), back.end());
    std::vector<Unrolled> unrolled;
    unroll(s, outward, along, back, unrolled);
    unroll(s, outward, along, ahead, unrolled);
    std::sort(unrolled.begin(), unrolled.end(), [](const auto& a, const auto& b) { return a.s < b.s; });
    return curvature_of(unrolled, s, std::max({half, s - from, to - s}));
  }

  double steadiness() const { return steady * std::min(1., std::pow(hand / path_smoothing_, 6)); }

  /// A circle's equation whose curvature may change along it: exact for arcs, however long.
  ///   y = a + b x + (c + d x) (x^2 + y^2)
  Bend curvature_of(const std::vector<Unrolled>& points, double s, double reach) const {
    SmallFit<4> fit;
    SmallFit<3> circle;
    constexpr double past = 1.05;  // the last points count, too
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double x = points[i].x / path_smoothing_, y = points[i].y / path_smoothing_, r = x * x + y * y;
      const double gap = points[std::min(i + 1, points.size() - 1)].s - points[i == 0 ? 0 : i - 1].s;
      const double weight = gap * falling(std::abs(points[i].s - s) / (past * reach));
      fit.add({1, x, r, x * r}, y, weight);
      circle.add({1, x, r}, y, weight);
    }
    double a = 0, b = 0, c = 0, d = 0;
    if (const auto found = fit.solve({0, 0, straight, steadiness()}); found && points.size() >= least_points)
      std::tie(a, b, c, d) = std::tuple((*found)[0], (*found)[1], (*found)[2], (*found)[3]);
    else if (const auto arc = circle.solve({0, 0, straight}); arc && points.size() >= 3)
      a = (*arc)[0], b = (*arc)[1], c = (*arc)[2];
    const double root = 1 - 4 * a * c;
    if (!(root > 0)) return {0, 0, 0};
    // y, its derivatives by x, and those of x^2 + y^2, at x = 0.
    const double y = 2 * a / (1 + std::sqrt(root)), q = 1 - 2 * c * y;
    const double first = (b + d * y * y) / q, squares_first = 2 * y * first;
    const double second = (2 * d * squares_first + 2 * c * (1 + first * first)) / q,
                 squares_second = 2 * (1 + first * first + y * second);
    const double third = (3 * d * squares_second + 6 * c * first * second) / q, length = 1 + first * first;
    return {second / std::pow(length, 1.5) / path_smoothing_,
            (third * length - 3 * first * second * second) / std::pow(length, 3) /
                (path_smoothing_ * path_smoothing_),
            std::atan(first)};
  }

  const Incision& incision_;
  double scale_, path_smoothing_, smoothing_, end_;  // the latter of the skin
  SkinFit skin_;
  std::vector<double> points_;                // of the path, mm
  std::vector<std::optional<Vec3>> normals_;  // at even distances from 0 to the end
};

}  // namespace

LocalShape PathShape::at(double s) const {
  const auto [a, b, part] = between(stations, s);
  if (a == b) return values[a];
  LocalShape shape;
  for (const auto member :
       {&LocalShape::curvature, &LocalShape::curvature_rate, &LocalShape::tilt, &LocalShape::depth,
        &LocalShape::skin_u, &LocalShape::skin_v, &LocalShape::skin_uv, &LocalShape::skin_uneven})
    shape.*member = (1 - part) * values[a].*member + part * values[b].*member;
  for (const auto member : {&LocalShape::along, &LocalShape::outward}) {
    const Vec3 sum = lerp(values[a].*member, values[b].*member, part);
    shape.*member = norm(sum) > 0 ? normalized(sum) : values[b].*member;
  }
  return shape;
}

double mean_tissue(const TissueAboveBone& tissue, const Vec3& place, const LocalShape& at, double reach,
                   double whole) {
  constexpr int along = 3, across = 1;  // samples to either side
  double sum = 0, weights = 0;
  for (int i = -along; i <= along; ++i)
    for (int j = -across; j <= across; ++j) {
      const double x = static_cast<double>(i) / (along + 1), y = static_cast<double>(j) / (along + 1);
      const double weight = falling(std::hypot(x, y));
      const Vec3 there = place + reach * (x * at.along + y * cross(at.outward, at.along));
      sum += weight * std::min(tissue(there, -at.outward), whole), weights += weight;
    }
  constexpr double rounding = 1e-9;
  return sum < (1 - rounding) * whole * weights ? sum / weights : std::numeric_limits<double>::infinity();
}

LocalShape local_shape(const Incision& incision, double scale, double s, const Smoothing& smoothing) {
  return Shapes(incision, scale, smoothing, s, s).at(s);
}

PathShape shape_along(const Incision& incision, double scale, const Smoothing& smoothing) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Shapes shapes(incision, scale, smoothing, -infinity, infinity);
  const std::size_t pieces = shapes.pieces(stations_a_smoothing);
  PathShape shape;
  for (std::size_t i = 0; i <= pieces; ++i) {
    shape.stations.push_back(shapes.end() * static_cast<double>(i) / static_cast<double>(pieces));
    shape.values.push_back(shapes.at(shape.stations.back()));
  }
  return shape;
}

}  // namespace cleft
