// The two sides of the cut, to the last bit: apart where it is open, one where it is not.
#include <gtest/gtest.h>

#include <limits>

#include "tests/field/random_field.h"

namespace cleft {

namespace {

/// Calls use(i, j, coefficient of the left lip, of the right lip) for all control points on the break.
template <class Use>
Field with_lips(const Field& field, const Use& use) {
  std::vector<Vec3> c = field.coefficients();
  const int V = field.basis(1).size(), left = field.basis(1).evaluate(0, Limit::from_left).first + 3;
  const std::size_t rows = field.basis(2).size() * field.basis(3).size();
  for (int i = 0; i < field.basis(0).size(); ++i)
    for (std::size_t r = 0; r < rows; ++r) {
      const std::size_t at = static_cast<std::size_t>(i * V + left) * rows + r;
      use(i, c[at], c[at + rows]);
    }
  return {field.shared_parametrization(),
          {field.basis(0), field.basis(1), field.basis(2), field.basis(3)},
          std::move(c)};
}

/// All the ways to ask for a displacement.
std::vector<Vec3> displacements(Field& field, const Vec3& uvw, Side side, double t) {
  std::vector<Vec3> all;
  for (const Kernel kernel : available_kernels()) {
    field.use(kernel);
    all.push_back(field.displacement(uvw, side, t));
    CollapsedField collapsed;
    field.collapse(t, collapsed);
    all.push_back(collapsed.displacement(uvw, side));
    History history;
    field.contract(uvw, side, 1e-3, history);
    all.push_back(evaluate(history, t));
  }
  return all;
}

}  // namespace

TEST(Lips, AgreeToTheLastBitWhereTheyShareControlPoints) {
  // Ahead of the tip only: functions that live there begin with the one that is 1 at the tip.
  const int ahead = tip_bases()[0].evaluate(2).first;
  Field field = with_lips(tip_field(), [&](int i, const Vec3& left, Vec3& right) {
    if (i >= ahead) right = left;
  });
  for (const double t : {0.3, 0.7, 5., 10., 17.3, 24.}) {
    const double tip = field.parametrization().geometry().tip.at(t);
    for (const double beyond : {0., 1e-12, 1e-3, 2., 8.})
      for (const double w : {0., -1.7, -3., -8.}) {
        const Vec3 uvw{tip + beyond, 0, w};
        const auto left = displacements(field, uvw, Side::left, t),
                   right = displacements(field, uvw, Side::right, t);
        for (std::size_t i = 0; i < left.size(); ++i) {
          if (i % 3 == 2 && beyond < 1e-6)
            continue;  // a history that is broken here is exact to its tolerance
          ASSERT_EQ(left[i], right[i]) << beyond << ' ' << t << ' ' << i;
        }
      }
    if (t > 0.5) {
      EXPECT_NE(field.displacement({tip - 0.1, 0, 0}, Side::left, t),
                field.displacement({tip - 0.1, 0, 0}, Side::right, t));
    }
  }
}

TEST(Lips, HearNothingOfEachOther) {
  // What touches a control point that is not a number becomes none itself.
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Field& whole : {random_field(), tip_field()}) {
    std::vector<Vec3> c = whole.coefficients();
    const int V = whole.basis(1).size(), half = whole.basis(1).evaluate(0).first;
    const std::size_t rows = whole.basis(2).size() * whole.basis(3).size();
    for (std::size_t n = 0; n < c.size(); ++n)
      if (static_cast<int>(n / rows % static_cast<std::size_t>(V)) >= half) c[n] = {nan, nan, nan};
    Field broken(whole.shared_parametrization(),
                 {whole.basis(0), whole.basis(1), whole.basis(2), whole.basis(3)}, c);
    Field sound = whole;
    for (const double v : {0., -1e-300, -0.01, -15.}) {
      const Vec3 uvw{3, v, -1};
      EXPECT_EQ(displacements(broken, uvw, Side::left, 9), displacements(sound, uvw, Side::left, 9));
      const Derivatives d = broken.derivatives(uvw, Side::left, 9);
      for (const Vec3& x : {d.value, d.by_u, d.by_v, d.by_w, d.by_t}) EXPECT_LT(norm(x), 1e6);
    }
    EXPECT_TRUE(std::isnan(broken.displacement({3, 0, -1}, Side::right, 9).x));
  }
}

TEST(Lips, NothingMovesBeforeTheFirstFrame) {
  for (const Field& random : {random_field(), tip_field()}) {
    std::vector<Vec3> c = random.coefficients();
    for (std::size_t i = 0; i < c.size(); i += static_cast<std::size_t>(random.basis(3).size())) c[i] = {};
    Field field(random.shared_parametrization(),
                {random.basis(0), random.basis(1), random.basis(2), random.basis(3)}, c);
    for (const Place& p : all_kinds_of_places(field, 100))
      for (const Vec3& d : displacements(field, p.uvw, p.side, 0)) ASSERT_EQ(d, Vec3{});
  }
}

}  // namespace cleft
