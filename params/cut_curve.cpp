#include "params/cut_curve.h"

#include <algorithm>
#include <cmath>

#include "params/meshed_cut.h"

namespace cleft {

namespace {

constexpr int pieces = 128;

/// Gauss's rule of five points on -1 to 1: of directions that turn by a few hundredths of a radian, exact to
/// rounding.
constexpr std::array<std::array<double, 2>, 5> gauss = {{{0, 0.568888888888888889},
                                                         {-0.538469310105683091, 0.478628670499366468},
                                                         {0.538469310105683091, 0.478628670499366468},
                                                         {-0.906179845938663993, 0.236926885056189088},
                                                         {0.906179845938663993, 0.236926885056189088}}};

}  // namespace

CutCurve::CutCurve(const Parameters& p)
    : curvature_(p.cut.curvature),
      rate_(p.cut.curvature_rate),
      half_(meshed_cut(p).length / 2),
      step_(2 * half_ / pieces),
      nodes_(pieces + 1) {
  constexpr int middle = pieces / 2;
  nodes_[middle] = {0, 0, 0};
  for (int i = 0; i < middle; ++i) {
    nodes_[middle + i + 1] = from(nodes_[middle + i], i * step_, step_);
    nodes_[middle - i - 1] = from(nodes_[middle - i], -i * step_, -step_);
  }
}

/// The place `length` beyond that of u.
CutCurve::Place CutCurve::from(const Place& start, double u, double length) const {
  const auto turned = [&](double s) { return s * (curvature_ + rate_ * (u + s / 2)); };
  Place at = start;
  for (const auto& [x, weight] : gauss) {
    const double direction = start.direction + turned(length * (1 + x) / 2);
    at.x += length / 2 * weight * std::cos(direction), at.y += length / 2 * weight * std::sin(direction);
  }
  at.direction = start.direction + turned(length);
  return at;
}

CutCurve::Place CutCurve::operator()(double u) const {
  const double inside = std::clamp(u, -half_, half_), beyond = u - inside;
  if (is_straight()) return {u, 0, 0};
  const auto before = static_cast<int>(std::clamp((inside + half_) / step_, 0., pieces - 1.));
  // From the node on the side of the middle.
  const int node = inside < 0 ? before + 1 : before;
  const double at = node * step_ - half_;
  Place place = from(nodes_[static_cast<std::size_t>(node)], at, inside - at);
  place.x += beyond * std::cos(place.direction), place.y += beyond * std::sin(place.direction);
  return place;
}

std::array<double, 2> CutCurve::Place::seen(double of_x, double of_y) const {
  const double cosine = std::cos(direction), sine = std::sin(direction), dx = of_x - x, dy = of_y - y;
  return {cosine * dx + sine * dy, cosine * dy - sine * dx};
}

/// Newton's method within an interval at whose ends a place is ahead and behind: halves of it where it leaves
/// the interval.
double CutCurve::foot_between(double from, double to, bool ahead_at_from, double x, double y) const {
  double u = (from + to) / 2;
  for (int round = 0; round < 100 && to - from > 1e-14 * half_; ++round) {
    const auto [off, v] = (*this)(u).seen(x, y);
    if (std::abs(off) < 1e-14 * half_) break;
    ((off > 0) == ahead_at_from ? from : to) = u;
    const double next = u - off / ((curvature_ + rate_ * u) * v - 1);
    u = next > from && next < to ? next : (from + to) / 2;
  }
  return u;
}

std::vector<std::array<double, 2>> CutCurve::feet(double x, double y) const {
  std::vector<std::array<double, 2>> feet;
  const auto add = [&](double u) { feet.push_back({u, (*this)(u).seen(x, y)[1]}); };
  const double before_start = -nodes_.front().seen(x, y)[0], beyond_end = nodes_.back().seen(x, y)[0];
  if (before_start > 0) add(-half_ - before_start);
  if (beyond_end > 0) add(half_ + beyond_end);
  double last = -before_start;
  if (last == 0) add(-half_);
  for (int i = 1; i <= pieces; ++i) {
    const double next = nodes_[static_cast<std::size_t>(i)].seen(x, y)[0];
    if (next == 0)
      add(i * step_ - half_);
    else if (last * next < 0)
      add(foot_between((i - 1) * step_ - half_, i * step_ - half_, last > 0, x, y));
    last = next;
  }
  std::sort(feet.begin(), feet.end(),
            [](const auto& a, const auto& b) { return std::abs(a[1]) < std::abs(b[1]); });
  return feet;
}

}  // namespace cleft
