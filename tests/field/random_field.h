// Fields with random control points, the same at every call.
#pragma once

#include <random>

#include "encoder/field/field.h"
#include "encoder/field/unknowns.h"
#include "tests/support/recorded.h"

namespace cleft {

inline std::vector<Vec3> random_coefficients(const std::array<BSplineBasis, 4>& bases, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(-1, 1);  // floats: what a file stores
  std::size_t count = 1;
  for (const BSplineBasis& basis : bases) count *= static_cast<std::size_t>(basis.size());
  std::vector<Vec3> coefficients(count);
  for (Vec3& c : coefficients) c = {uniform(random), uniform(random), uniform(random)};
  return coefficients;
}

inline Field random_field() {
  const std::array<BSplineBasis, 4> bases{
      BSplineBasis::uniform(3, 7, -30, 30), BSplineBasis::broken(3, 10, -20, 0, 20),
      BSplineBasis::uniform(3, 5, -8, 0), BSplineBasis::uniform(3, 6, 0, 24)};
  Field field(bases[0], bases[1], bases[2], bases[3], random_coefficients(bases), {-12, 24, 3});
  field.parameters = recorded({{"tissue.young_modulus", 0.02}, {"skin.thickness", 1.5}});
  field.case_hash = "0123456789abcdef";
  field.report.node_error = 0.0625;
  return field;
}

/// Over the parameters of "tip": kinks where the cut begins and at its tip, and at the depth of the cut.
inline std::array<BSplineBasis, 4> tip_bases() {
  return {BSplineBasis(3, {0, 0, 0, 0, 0.4, 1, 1, 1, 1.3, 1.7, 2, 2, 2, 2.2, 2.6, 3, 3, 3, 3}),
          BSplineBasis::broken(3, 11, -1, 0, 1),
          BSplineBasis(3, {-2, -2, -2, -2, -1, -1, -1, -0.4, 0, 0, 0, 0}), BSplineBasis::uniform(3, 8, 0, 1)};
}

/// Left and right of the cut are of different widths, and the tip does not advance evenly.
inline FieldGeometry tip_geometry() {
  return {{{{-30, 33}, {-20, 16}, {-8, 0}, {0, 24}}}, {-12, 24, 3}, {{0, 10, 24}, {-12, -1, 12}}};
}

inline Field tip_field(unsigned seed = 1) {
  return {make_parametrization("tip", tip_geometry()), tip_bases(), random_coefficients(tip_bases(), seed)};
}

/// Anywhere in the domain, outside it, on knots, at the ends and on both lips.
inline std::vector<Place> all_kinds_of_places(const Field& field, std::size_t count = 400) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Place> places(count);
  for (std::size_t n = 0; n < count; ++n) {
    double x[4];
    for (int axis = 0; axis < 4; ++axis) {
      const auto [front, back] = field.domain(axis);
      x[axis] = front - 0.1 * (back - front) + 1.2 * (back - front) * unit(random);
      const auto kind = static_cast<int>(40 * unit(random));
      if (kind == 0) x[axis] = front;
      if (kind == 1) x[axis] = back;
      if (kind == 2) x[axis] = front + (back - front) / 2;
      if (kind < 10 && axis == 1) x[axis] = 0;
    }
    places[n] = {
        {x[0], x[1], x[2]}, x[1] == 0 ? static_cast<Side>(static_cast<int>(n % 3) - 1) : side_of(x[1]), x[3]};
  }
  return places;
}

/// The four-fold sum of the definition, over all control points.
inline Vec3 by_definition(const Field& f, const Place& p) {
  if (p.uvw.y == 0 && p.side == Side::both)
    return lerp(by_definition(f, {p.uvw, Side::left, p.t}), by_definition(f, {p.uvw, Side::right, p.t}), 0.5);
  const auto inside = [&f](double x, int axis) {
    return std::clamp(x, f.domain(axis).front, f.domain(axis).back);
  };
  const double u = inside(p.uvw.x, 0), v = inside(p.uvw.y, 1), w = inside(p.uvw.z, 2), t = inside(p.t, 3);
  const Parametrization& m = f.parametrization();
  const double at[] = {m.along(u, t).value, m.across(v).value, m.height(w).value, m.time(t).value};
  std::array<std::vector<double>, 4> value;
  for (int axis = 0; axis < 4; ++axis) {
    const BSplineBasis& basis = f.basis(axis);
    const bool left = axis == 1 && (v < 0 || (v == 0 && p.side == Side::left));
    const auto b = basis.evaluate(at[axis], left ? Limit::from_left : Limit::from_right);
    value[axis].assign(basis.size(), 0);
    for (int i = 0; i <= basis.degree(); ++i) value[axis][b.first + i] = b.value[i];
  }
  Vec3 sum;
  std::size_t next = 0;
  for (const double a : value[0])
    for (const double b : value[1])
      for (const double c : value[2])
        for (const double d : value[3]) sum += a * b * c * d * f.coefficients()[next++];
  return sum;
}

/// 256 products of four weights, which sum to 1, and control points of length below sqrt(3): a few dozen
/// roundings of 1.1e-16 each, and those of the definition.
constexpr double rounding = 2e-14;

/// A field that follows the tip, with knots, path, parameters and report as an encoded case has them, whose
/// unknowns are multiples of its quantum. `variant` changes parameters, figures and coefficients.
inline Field following_field(int variant = 0) {
  const auto graded = [](std::vector<double> ends, int spans) {
    std::vector<double> knots;
    for (std::size_t part = 0; part + 1 < ends.size(); ++part) {
      const bool outer = part == 0;
      knots.insert(knots.end(), outer ? 4 : 3, ends[part]);
      for (int s = 1; s < spans; ++s) {
        const double x = static_cast<double>(s) / spans;
        knots.push_back(ends[part] + x * x * (ends[part + 1] - ends[part]));
      }
    }
    knots.insert(knots.end(), 4, ends.back());
    return BSplineBasis(3, knots);
  };
  std::array<BSplineBasis, 4> bases{graded({0, 1, 2, 3}, 4), BSplineBasis::broken(3, 14, -1, 0, 1),
                                    graded({-2, -1, 0}, 2), BSplineBasis::uniform(3, 13, 0, 1)};
  FieldGeometry geometry{{{{-60, 60}, {-40, 40}, {-15, 0}, {0, 41.3}}}, {-20.7, 41.3, 4.9}, {}};
  for (int frame = 0; frame < 48; ++frame) {
    geometry.tip.times.push_back(41.3 * frame / 47);
    geometry.tip.positions.push_back(-20.7 + 41.3 * frame / 47 * (1 + 1e-9 * frame));
  }
  std::size_t count = 1;
  for (const BSplineBasis& b : bases) count *= static_cast<std::size_t>(b.size());
  std::mt19937 random(static_cast<unsigned>(variant) + 1);
  std::normal_distribution<double> normal;
  std::vector<Vec3> points(count);
  const std::size_t T = static_cast<std::size_t>(bases[3].size());
  for (std::size_t place = 0; place < count / T; ++place) {
    const Vec3 last{normal(random), normal(random), normal(random)};
    for (std::size_t l = 1; l < T; ++l) points[place * T + l] = static_cast<double>(l) / (T - 1) * last;
  }
  Field field(make_parametrization("tip", geometry), bases, points);
  const char* names[] = {"cut.count",
                         "cut.depth",
                         "cut.length",
                         "cut.radius",
                         "cut.spacing",
                         "foundation.side_stiffness",
                         "foundation.stiffness",
                         "mesh.cut_depth",
                         "mesh.cut_length",
                         "mesh.element_size",
                         "mesh.grading",
                         "patch.height",
                         "patch.length",
                         "patch.width",
                         "skin.poisson_ratio",
                         "skin.prestress_u",
                         "skin.prestress_uv",
                         "skin.prestress_v",
                         "skin.thickness",
                         "skin.young_modulus",
                         "tissue.poisson_ratio",
                         "tissue.young_modulus"};
  double value = 1;
  for (const char* name : names) field.parameters.set(name, value /= 1.7);
  RecordedParameters& p = field.parameters;
  p.set(p->skin.prestress.vv, 0.01 + 0.001 * (variant % 40));
  p.set(p->tissue.young_modulus, 0.01 + 0.0003 * (variant / 40));
  for (int n = 0; n < 64; ++n) field.case_hash += "0123456789abcdef"[random() % 16];
  std::uniform_real_distribution<double> figure(0.001, 0.02);
  FitReport& r = field.report;
  for (double* x : {&r.relative_l2, &r.node_error, &r.spline_error, &r.gape_error, &r.false_gap})
    *x = figure(random);
  r.largest_displacement = 100 * figure(random);
  return quantised(field, 0.01, 0.5);
}

}  // namespace cleft
