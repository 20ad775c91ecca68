#include "encoder/field/field.h"

#include <algorithm>

#include "base/error.h"

namespace cleft {

namespace {

std::shared_ptr<const Parametrization> fixed_over(const std::array<BSplineBasis, 4>& bases,
                                                  CanonicalCut cut) {
  FieldGeometry geometry;
  for (int axis = 0; axis < 4; ++axis) geometry.domain[axis] = {bases[axis].front(), bases[axis].back()};
  geometry.cut = cut;
  geometry.tip = {{0, cut.length}, {cut.start, cut.start + cut.length}};
  return make_parametrization("fixed", std::move(geometry));
}

}  // namespace

Field::Field(std::shared_ptr<const Parametrization> parametrization, std::array<BSplineBasis, 4> bases,
             std::vector<Vec3> coefficients)
    : parametrization_(std::move(parametrization)),
      bases_(std::move(bases)),
      coefficients_(std::move(coefficients)) {
  std::size_t count = 1;
  for (const BSplineBasis& b : bases_) count *= b.size();
  CLEFT_CHECK(coefficients_.size(), ==, count);
}

Field::Field(BSplineBasis u, BSplineBasis v, BSplineBasis w, BSplineBasis t, std::vector<Vec3> coefficients,
             CanonicalCut cut)
    : bases_{std::move(u), std::move(v), std::move(w), std::move(t)}, coefficients_(std::move(coefficients)) {
  parametrization_ = fixed_over(bases_, cut);
  std::size_t count = 1;
  for (const BSplineBasis& b : bases_) count *= b.size();
  CLEFT_CHECK(coefficients_.size(), ==, count);
}

Vec3 Field::displacement(const Vec3& uvw, Side side, double t) const {
  if (uvw.y == 0 && side == Side::both)
    return lerp(displacement(uvw, Side::left, t), displacement(uvw, Side::right, t), 0.5);
  const auto inside = [this](double x, int axis) {
    return std::clamp(x, domain(axis).front, domain(axis).back);
  };
  const double time = inside(t, 3), v = inside(uvw.y, 1);
  const Parametrization& p = *parametrization_;
  const auto bu = bases_[0].evaluate(p.along(inside(uvw.x, 0), time).value);
  const auto bv = bases_[1].evaluate(
      p.across(v).value, v < 0 || (v == 0 && side == Side::left) ? Limit::from_left : Limit::from_right);
  const auto bw = bases_[2].evaluate(p.height(inside(uvw.z, 2)).value),
             bt = bases_[3].evaluate(p.time(time).value);
  const std::size_t V = bases_[1].size(), W = bases_[2].size(), T = bases_[3].size();
  Vec3 sum;
  for (int i = 0; i <= bases_[0].degree(); ++i)
    for (int j = 0; j <= bases_[1].degree(); ++j) {
      const double row_weight = bu.value[i] * bv.value[j];
      Vec3 row_sum;
      for (int k = 0; k <= bases_[2].degree(); ++k) {
        const Vec3* c =
            &coefficients_[(((bu.first + i) * V + (bv.first + j)) * W + (bw.first + k)) * T + bt.first];
        Vec3 along_t;
        for (int l = 0; l <= bases_[3].degree(); ++l) along_t += bt.value[l] * c[l];
        row_sum += bw.value[k] * along_t;
      }
      sum += row_weight * row_sum;
    }
  return sum;
}

void Field::contract(const Vec3& uvw, Side side, double tolerance, History& out) const {
  out.breaks.clear(), out.controls.clear(), out.error = 0;
  const double front = domain(3).front, back = domain(3).back;
  const auto at = [&](double t) { return displacement(uvw, side, t); };
  // Between two breaks: the cubic through four points of the field, checked at two more.
  const auto add = [&](auto&& self, double from, double to, int halvings) -> void {
    const double h = to - from;
    // Just inside where the tip may pass the point at an end.
    const double tiny = parametrization_->moves() ? 1e-12 * h : 0;
    const Vec3 a = at(from + tiny), b = at(from + h / 3), c = at(from + 2 * h / 3), d = at(to - tiny);
    const std::array<Vec3, 4> piece{a, (1. / 6) * (-5. * a + 18. * b + -9. * c + 2. * d),
                                    (1. / 6) * (2. * a + -9. * b + 18. * c + -5. * d), d};
    const auto value = [&](double s) {
      const double r = 1 - s;
      return r * r * r * piece[0] + 3 * r * r * s * piece[1] + 3 * r * s * s * piece[2] +
             s * s * s * piece[3];
    };
    double error = 0;
    if (parametrization_->moves())
      for (const double s : {1. / 6, 0.5, 5. / 6}) error = std::max(error, norm(value(s) - at(from + s * h)));
    if (error > tolerance && halvings < 12) {
      self(self, from, from + h / 2, halvings + 1);
      self(self, from + h / 2, to, halvings + 1);
      return;
    }
    out.error = std::max(out.error, error);
    out.breaks.push_back(from);
    out.controls.push_back(piece);
  };
  const double passes = parametrization_->moves() ? parametrization_->geometry().tip.passes(uvw.x) : back;
  double from = front;
  const auto& knots = bases_[3].knots();
  for (std::size_t i = 0; i < knots.size(); ++i) {
    const double to = std::min(parametrization_->time_at(knots[i]), back);
    if (from < passes && passes < to) add(add, from, passes, 0), from = passes;
    if (to > from) add(add, from, to, 0), from = to;
  }
  out.breaks.push_back(back);
}

double Field::contraction_tolerance() const {
  return std::max(0.1 * report.spline_error, 1e-6) * report.largest_displacement;
}

Vec3 evaluate(const History& history, double t) {
  const auto& breaks = history.breaks;
  const auto next = std::upper_bound(breaks.begin() + 1, breaks.end() - 1, t);
  const auto i = next - breaks.begin() - 1;
  const double s = std::clamp((t - breaks[i]) / (breaks[i + 1] - breaks[i]), 0., 1.), r = 1 - s;
  const auto& c = history.controls[i];
  return r * r * r * c[0] + 3 * r * r * s * c[1] + 3 * r * s * s * c[2] + s * s * s * c[3];
}

}  // namespace cleft
