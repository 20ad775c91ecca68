#include "solver/patch_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "params/meshed_cut.h"

namespace cleft {

namespace {

constexpr double largest_step = 0.05;  // mm
constexpr double beyond_the_cut = 1;   // mm for which a curved cut's curvature goes on

FramedCurve::Place sum(const FramedCurve::Place& p, double h, const FramedCurve::Place& slope) {
  return {p.at + h * slope.at, p.t + h * slope.t, p.b + h * slope.b, p.n + h * slope.n};
}

FramedCurve::Place slope_of(const FramedCurve::Place& p, const FramedCurve::Rates& k) {
  return {p.t, k.bend * p.b - k.normal * p.n, -k.bend * p.t - k.twist * p.n, k.normal * p.t + k.twist * p.b};
}

FramedCurve::Place orthonormal(FramedCurve::Place p) {
  p.t = normalized(p.t);
  p.n = normalized(p.n - dot(p.n, p.t) * p.t);
  p.b = cross(p.n, p.t);
  return p;
}

/// Of a cubic with these values and slopes at the ends of a step, at the part of it.
Vec3 cubic(const Vec3& a, const Vec3& da, const Vec3& b, const Vec3& db, double step, double part) {
  const double q = 1 - part;
  return q * q * (1 + 2 * part) * a + part * part * (1 + 2 * q) * b + step * part * q * (q * da - part * db);
}

/// How far from the middle of the cut its surroundings keep their curvature along it, mm.
double core_of(const Parameters& p) {
  const MeshedCut cut = meshed_cut(p);
  return std::max(10., cut.length / 2 + cut.depth);
}

/// How far the profile across a cut may turn, radians. Where the skin bends along the cut too, the profile
/// must not reach the axis about which that curvature turns it.
double most_turned(const Parameters::Skin& skin) {
  constexpr double turned = 1.3, turned_alike = 0.72;  // alike: where the two curvatures are equal
  const double u = std::abs(skin.curvature_u), v = std::abs(skin.curvature_v);
  if (u == 0 || v == 0) return turned;
  const double cosine = 1 - (1 - std::cos(turned_alike)) * v / u;
  return cosine < std::cos(turned) ? turned : std::acos(cosine);
}

/// The same across it. The opening feels curvatures across as far as this: with 1.4 of the core in place of
/// 1.8, and a profile that turns by 0.72 radians at most, that of a cut of 30 mm along a cylinder of 30 mm is
/// 1.4 % less.
double core_across(const Parameters& p) {
  constexpr double times = 1.8;
  const double core = times * core_of(p), ratio = core * p.skin.curvature_v / most_turned(p.skin);
  return core * std::pow(1 + ratio * ratio * ratio * ratio, -0.25);
}

}  // namespace

FramedCurve::FramedCurve(std::function<Rates(double)> rates, double reach) : rates_(std::move(rates)) {
  const auto steps = static_cast<std::size_t>(std::ceil(reach / largest_step));
  step_ = reach / static_cast<double>(std::max<std::size_t>(1, steps));
  for (auto* list : {&forward_, &back_}) {
    list->push_back({{}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
    list->reserve(steps + 1);
    while (list->size() <= steps) integrate(list == &forward_ ? step_ : -step_, *list);
  }
}

void FramedCurve::integrate(double h, std::vector<Place>& places) const {
  const Place& p = places.back();
  const double s = h * static_cast<double>(places.size() - 1);
  const Rates first = rates_(s), middle = rates_(s + h / 2), last = rates_(s + h);
  const Place k1 = slope_of(p, first), k2 = slope_of(sum(p, h / 2, k1), middle),
              k3 = slope_of(sum(p, h / 2, k2), middle), k4 = slope_of(sum(p, h, k3), last);
  places.push_back(orthonormal(sum(sum(sum(sum(p, h / 6, k1), h / 3, k2), h / 3, k3), h / 6, k4)));
}

FramedCurve::Place FramedCurve::operator()(double s) const {
  const std::vector<Place>& places = s < 0 ? back_ : forward_;
  const double along = std::abs(s) / step_, sign = s < 0 ? -1 : 1;
  const auto n = static_cast<std::size_t>(along);
  if (n + 1 >= places.size()) {
    Place end = places.back();
    end.at += (s - sign * step_ * static_cast<double>(places.size() - 1)) * end.t;
    return end;
  }
  const double part = along - static_cast<double>(n), h = sign * step_;
  const Place &a = places[n], &b = places[n + 1];
  const Place da = slope_of(a, rates_(h * static_cast<double>(n))),
              db = slope_of(b, rates_(h * static_cast<double>(n + 1)));
  return orthonormal({cubic(a.at, da.at, b.at, db.at, h, part), cubic(a.t, da.t, b.t, db.t, h, part),
                      cubic(a.b, da.b, b.b, db.b, h, part), cubic(a.n, da.n, b.n, db.n, h, part)});
}

/// The fall has the integral 0, the rise at the end -fall / 2.
TurnAndBack::TurnAndBack(double core)
    : core_(core), fall_(core / 2), plateau_(core - fall_ / 2), end_(core_ + 2 * fall_ + plateau_) {}

double TurnAndBack::operator()(double s) const {
  s = std::abs(s);
  if (s <= core_) return 1;
  if (s >= end_) return 0;
  const auto cosine = [&](double from) { return std::cos(std::numbers::pi * (s - from) / fall_); };
  if (s < core_ + fall_) return cosine(core_);
  if (s <= core_ + fall_ + plateau_) return -1;
  return -0.5 * (1 + cosine(core_ + fall_ + plateau_));
}

BendAndBack::BendAndBack(const Parameters& p)
    : curvature_(p.cut.curvature),
      rate_(p.cut.curvature_rate),
      core_(meshed_cut(p).length / 2 + beyond_the_cut),
      fall_(core_ / 6),
      halves_{half(1), half(-1)} {}

/// The fall has the integral fall (at_end - back) / 2, the rise at the end -back fall / 2.
BendAndBack::Half BendAndBack::half(double way) const {
  const double at_end = curvature_ + way * rate_ * core_;
  const double turned = core_ * (curvature_ + at_end) / 2 + fall_ * at_end / 2;  // with no way back
  if (turned == 0) return {at_end, 0, 0};
  const double back = std::copysign(std::max(std::abs(at_end), std::abs(turned) / core_) / 2, turned);
  const double plateau = turned / back - fall_;
  if (plateau >= 0) return {at_end, back, plateau};
  return {at_end, turned / fall_, 0};
}

double BendAndBack::operator()(double s) const {
  const auto& [at_end, back, plateau] = halves_[s < 0 ? 1 : 0];
  const double x = std::abs(s) - core_;
  if (x <= 0) return curvature_ + rate_ * s;
  const auto cosine = [&](double from) { return std::cos(std::numbers::pi * (x - from) / fall_); };
  if (x < fall_) return (at_end - back) / 2 + (at_end + back) / 2 * cosine(0);
  if (x <= fall_ + plateau) return -back;
  if (x >= 2 * fall_ + plateau) return 0;
  return -back / 2 * (1 + cosine(fall_ + plateau));
}

double BendAndBack::reach() const {
  return core_ + 2 * fall_ + std::max(halves_[0].plateau, halves_[1].plateau);
}

double BendAndBack::greatest() const {
  double greatest = 0;
  for (const auto& [at_end, back, plateau] : halves_)
    greatest = std::max({greatest, std::abs(at_end), std::abs(back)});
  return greatest;
}

PatchShape::PatchShape(const Parameters& p)
    : cut_(p),
      flat_(p.skin.curvature_u == 0 && p.skin.curvature_v == 0 && p.skin.curvature_uv == 0),
      slope_(p.patch.slope),
      height_(p.patch.height),
      cut_depth_(meshed_cut(p).depth),
      bend_(p),
      along_turn_(core_of(p)),
      across_turn_(core_across(p)),
      path_([bend = bend_](double s) { return FramedCurve::Rates{.bend = bend(s)}; }, bend_.reach()),
      spine_([k = p.skin.curvature_u, twist = p.skin.curvature_uv, turn = along_turn_](
                 double s) { return FramedCurve::Rates{.normal = k * turn(s), .twist = twist}; },
             p.patch.length),
      profile_([k = p.skin.curvature_v,
                turn = across_turn_](double s) { return FramedCurve::Rates{.normal = k * turn(s)}; },
               across_turn_.reach()) {}

/// Three quarters of the height, and of what is below the cut, are the most by which the bottom moves.
double PatchShape::depth(double v, double w) const {
  const double grid = -w;
  if (slope_ == 0 || grid <= cut_depth_) return grid;
  const double room = 0.75 * (slope_ * v > 0 ? height_ : height_ - cut_depth_);
  const double bottom = height_ + room * std::tanh(slope_ * v / room);
  return cut_depth_ + (grid - cut_depth_) * (bottom - cut_depth_) / (height_ - cut_depth_);
}

/// v (1 + (v/c)^4)^(-1/4), which differs from v by v (v/c)^4 / 4 near 0 and tends to c.
double PatchShape::across(double v) const {
  if (cut_.is_straight()) return v;
  const double ratio = v * bend_.greatest() / 0.55;
  return v * std::pow(1 + ratio * ratio * ratio * ratio, -0.25);
}

double PatchShape::across_slope(double v) const {
  if (cut_.is_straight()) return 1;
  const double ratio = v * bend_.greatest() / 0.55;
  return std::pow(1 + ratio * ratio * ratio * ratio, -1.25);
}

PatchShape::Plane PatchShape::in_plane(double u, double v) const {
  if (cut_.is_straight()) return {u, v};
  const FramedCurve::Place path = path_(u);
  const double g = across(v);
  return {path.at.x + g * path.b.x, path.at.y + g * path.b.y + (v - g)};
}

double PatchShape::plane_determinant(double u, double v) const {
  if (cut_.is_straight()) return 1;
  const double slope = across_slope(v);
  return (1 - bend_(u) * across(v)) * (slope + (1 - slope) * path_(u).t.x);
}

PatchShape::Surface PatchShape::surface(double x, double y) const {
  if (flat_) return {{x, y, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const FramedCurve::Place spine = spine_(x), profile = profile_(y);
  const FramedCurve::Rates rates = spine_.rates(x);
  const double across = profile.at.x, up = profile.at.z;
  Surface s;
  s.at = spine.at + across * spine.b + up * spine.n;
  s.x = (1 + rates.normal * up) * spine.t + rates.twist * (up * spine.b - across * spine.n);
  s.y = profile.t.x * spine.b + profile.t.z * spine.n;
  s.normal = normalized(cross(s.x, s.y));
  return s;
}

Vec3 PatchShape::place(double u, double v, double depth) const {
  const Plane p = in_plane(u, v);
  const Surface s = surface(p.x, p.y);
  return s.at - depth * s.normal;
}

Vec3 PatchShape::tension(double u, double v) const {
  const Plane p = in_plane(u, v);
  return normalized(surface(p.x, p.y).x);
}

std::array<double, 2> PatchShape::coordinates(double u, double v) const {
  const double half = cut_.half_length();
  if (cut_.is_straight() || (v == 0 && std::abs(u) <= half)) return {u, v};
  const Plane p = in_plane(u, v);
  const auto feet = cut_.feet(p.x, p.y);
  if (!feet.empty()) return feet.front();
  // Behind all of it: the nearer end.
  std::array<double, 2> nearest{0, std::numeric_limits<double>::infinity()};
  for (const double end : {-half, half}) {
    const auto [ahead, beside] = cut_(end).seen(p.x, p.y);
    const double distance = std::hypot(ahead, beside);
    if (distance < std::abs(nearest[1])) nearest = {end, std::copysign(distance, beside)};
  }
  return nearest;
}

std::array<Vec3, 3> PatchShape::frame(double along) const {
  const CutCurve::Place at = cut_(along);
  const Plane direction{std::cos(at.direction), std::sin(at.direction)};
  const Surface s = surface(at.x, at.y);
  const Vec3 t = normalized(direction.x * s.x + direction.y * s.y);
  return {t, cross(s.normal, t), s.normal};
}

}  // namespace cleft
