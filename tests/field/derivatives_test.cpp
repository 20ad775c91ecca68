#include <gtest/gtest.h>

#include "tests/field/random_field.h"

namespace cleft {

namespace {

/// A cubic, its slope and its blossom, of which splines that reproduce it are made.
struct Cubic {
  double c[4];

  double operator()(double x) const { return c[0] + x * (c[1] + x * (c[2] + x * c[3])); }
  double slope(double x) const { return c[1] + x * (2 * c[2] + x * 3 * c[3]); }
  double blossom(double x, double y, double z) const {
    return c[0] + c[1] * (x + y + z) / 3 + c[2] * (x * y + y * z + z * x) / 3 + c[3] * x * y * z;
  }
};

const Cubic along{{1, 0.3, -0.2, 0.05}}, left{{0.5, -1, 0.3, 0.2}}, right{{-2, 1.5, 0.1, -0.3}},
    height{{1, 0.2, -0.1, 0.3}}, growth{{0, 1, -0.4, 0.2}};

/// The product of one cubic of each parameter, another one left of the cut than right of it.
Field product(std::shared_ptr<const Parametrization> parametrization, std::array<BSplineBasis, 4> bases) {
  const auto blossom = [&](const Cubic& cubic, int axis, int i) {
    const auto& knots = bases[axis].knots();
    const std::size_t k = i;
    return cubic.blossom(knots[k + 1], knots[k + 2], knots[k + 3]);
  };
  const int half = bases[1].evaluate(0).first;
  std::vector<Vec3> c;
  for (int i = 0; i < bases[0].size(); ++i)
    for (int j = 0; j < bases[1].size(); ++j)
      for (int k = 0; k < bases[2].size(); ++k)
        for (int l = 0; l < bases[3].size(); ++l) {
          const double x = blossom(along, 0, i) * blossom(j < half ? left : right, 1, j) *
                           blossom(height, 2, k) * blossom(growth, 3, l);
          c.push_back({x, -2 * x, 0.5 * x});
        }
  return {std::move(parametrization), std::move(bases), std::move(c)};
}

void expect_product(const Field& field, const Place& p) {
  const Parametrization& m = field.parametrization();
  const auto a = m.along(p.uvw.x, p.t);
  const auto b = m.across(p.uvw.y), h = m.height(p.uvw.z), t = m.time(p.t);
  const Cubic& side = p.side == Side::left ? left : right;
  const double f[4] = {along(a.value), side(b.value), height(h.value), growth(t.value)};
  const double value = f[0] * f[1] * f[2] * f[3];
  const double by_along = along.slope(a.value) * f[1] * f[2] * f[3];
  const double expected[5] = {value, by_along * a.by_u, f[0] * side.slope(b.value) * b.slope * f[2] * f[3],
                              f[0] * f[1] * height.slope(h.value) * h.slope * f[3],
                              by_along * a.by_t + f[0] * f[1] * f[2] * growth.slope(t.value) * t.slope};
  const Derivatives d = field.derivatives(p.uvw, p.side, p.t);
  const Vec3 found[5] = {d.value, d.by_u, d.by_v, d.by_w, d.by_t};
  // Products of cubics of size below 100, and their slopes over spans of a third or more of a parameter.
  for (int i = 0; i < 5; ++i) {
    const Vec3 exact = expected[i] * Vec3{1, -2, 0.5};
    ASSERT_LT(norm(found[i] - exact), 1e-10) << i << " at " << p.uvw.x << ' ' << p.uvw.y << ' ' << p.t;
  }
}

std::vector<Place> inner_places(const Field& field) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Place> places(200);
  for (Place& p : places) {
    double x[4];
    for (int axis = 0; axis < 4; ++axis) {
      const auto [front, back] = field.domain(axis);
      x[axis] = front + (back - front) * (0.02 + 0.96 * unit(random));
    }
    p = {{x[0], x[1], x[2]}, side_of(x[1]), x[3]};
  }
  return places;
}

}  // namespace

TEST(Derivatives, OfAPolynomialAreExact) {
  FieldGeometry unit = tip_geometry();
  unit.domain = {{{0, 3}, {-1, 1}, {-2, 0}, {0, 1}}};
  for (Field field : {product(make_parametrization("fixed", unit), tip_bases()),
                      product(make_parametrization("tip", tip_geometry()), tip_bases())})
    for (const Kernel kernel : available_kernels()) {
      field.use(kernel);
      for (Place p : inner_places(field)) {
        expect_product(field, p);
        for (const Side side : {Side::left, Side::right}) {
          // On the plane by_v is that of the lip, whose side has a width of its own.
          const double v = side == Side::left ? -1e-13 : 0;
          p.uvw.y = v, p.side = side;
          expect_product(field, p);
          const Derivatives on = field.derivatives({p.uvw.x, 0, p.uvw.z}, side, p.t),
                            beside = field.derivatives(p.uvw, side, p.t);
          ASSERT_LT(norm(on.by_v - beside.by_v), 1e-10);
        }
        const Vec3 plane{p.uvw.x, 0, p.uvw.z};
        const Derivatives l = field.derivatives(plane, Side::left, p.t),
                          r = field.derivatives(plane, Side::right, p.t),
                          both = field.derivatives(plane, Side::both, p.t);
        ASSERT_EQ(both.by_v, lerp(l.by_v, r.by_v, 0.5));
        ASSERT_EQ(both.by_t, lerp(l.by_t, r.by_t, 0.5));
      }
    }
}

TEST(Derivatives, AreTheLimitsOfDifferences) {
  // Central differences of step h: wrong by h^2 / 6 times the third derivative, at most about 1e4 here next
  // to the cut's start, and 1e-15 / h.
  const double h = 1e-5;
  for (const Field& field : {random_field(), tip_field()}) {
    const TipPath& tip = field.parametrization().geometry().tip;
    for (const Place& p : inner_places(field)) {
      if (field.parametrization().moves() &&
          (std::abs(p.uvw.x - tip.at(p.t)) < 0.1 || std::abs(p.uvw.x + 12) < 0.1 || p.t < 1 ||
           std::abs(p.t - 10) < 0.1 || std::abs(p.uvw.z + 3) < 0.01 || std::abs(p.uvw.y) < 0.01))
        continue;  // kinks
      const Derivatives d = field.derivatives(p.uvw, p.side, p.t);
      ASSERT_LT(norm(d.value - field.displacement(p.uvw, p.side, p.t)), rounding);
      const Vec3 found[4] = {d.by_u, d.by_v, d.by_w, d.by_t};
      for (int axis = 0; axis < 4; ++axis) {
        Vec3 ahead = p.uvw, behind = p.uvw;
        if (axis < 3) ahead[axis] += h, behind[axis] -= h;
        const double dt = axis == 3 ? h : 0;
        const Vec3 difference = (1 / (2 * h)) * (field.displacement(ahead, p.side, p.t + dt) -
                                                 field.displacement(behind, p.side, p.t - dt));
        ASSERT_LT(norm(difference - found[axis]), 1e-6) << axis << ' ' << p.uvw.x << ' ' << p.t;
      }
    }
  }
}

}  // namespace cleft
