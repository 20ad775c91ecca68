#include "encoder/field/bspline.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"

namespace cleft {

namespace {

/// The recursion of the definition, for half-open spans: slow, and independent of the evaluation under test.
double by_definition(const std::vector<double>& knots, int i, int p, double x) {
  if (p == 0) return knots[i] <= x && x < knots[i + 1];
  const double a = knots[i + p] - knots[i], b = knots[i + p + 1] - knots[i + 1];
  return (a > 0 ? (x - knots[i]) / a * by_definition(knots, i, p - 1, x) : 0) +
         (b > 0 ? (knots[i + p + 1] - x) / b * by_definition(knots, i + 1, p - 1, x) : 0);
}

double value_of(const BSplineBasis& basis, int i, double x, Limit limit) {
  const auto b = basis.evaluate(x, limit);
  return i >= b.first && i <= b.first + basis.degree() ? b.value[i - b.first] : 0;
}

}  // namespace

TEST(BSpline, EqualsItsDefinition) {
  const BSplineBasis uniform = BSplineBasis::uniform(3, 9, -2, 5),
                     broken = BSplineBasis::broken(3, 11, -4, 0, 3);
  const BSplineBasis graded(2, {0, 0, 0, 0.1, 0.5, 0.5, 2, 2, 2});
  for (const BSplineBasis& basis : {uniform, broken, graded})
    for (double x = basis.front(); x < basis.back(); x += 0.0137)
      for (int i = 0; i < basis.size(); ++i)
        ASSERT_NEAR(value_of(basis, i, x, Limit::from_right),
                    by_definition(basis.knots(), i, basis.degree(), x), 1e-14);
}

TEST(BSpline, SumsToOneAtEveryKnotFromBothSides) {
  const BSplineBasis basis = BSplineBasis::broken(3, 12, -4, 0, 3);
  for (const double x : basis.knots())
    for (const Limit limit : {Limit::from_left, Limit::from_right}) {
      double sum = 0;
      for (int i = 0; i < basis.size(); ++i) sum += value_of(basis, i, x, limit);
      EXPECT_NEAR(sum, 1, 1e-15) << x;
    }
}

TEST(BSpline, TheBreakSharesNoFunction) {
  const BSplineBasis basis = BSplineBasis::broken(3, 11, -4, 0, 3);
  const auto left = basis.evaluate(0, Limit::from_left), right = basis.evaluate(0, Limit::from_right);
  EXPECT_EQ(left.first + 4, right.first);
  EXPECT_EQ(left.value[3], 1);
  EXPECT_EQ(right.value[0], 1);
}

TEST(BSpline, ClampsOutsideItsDomain) {
  const BSplineBasis basis = BSplineBasis::uniform(3, 6, 0, 1);
  EXPECT_EQ(basis.evaluate(-5).value, basis.evaluate(0).value);
  EXPECT_EQ(basis.evaluate(7).value, basis.evaluate(1).value);
}

TEST(BSpline, BadKnotsAreRefused) {
  EXPECT_THROW(BSplineBasis(3, {0, 0, 0, 0, 1, 1, 1}), InputError);
  EXPECT_THROW(BSplineBasis(1, {0, 0, 2, 1, 3, 3}), InputError);
  EXPECT_THROW(BSplineBasis(1, {0, 0, std::nan(""), 1, 1}), InputError);
  EXPECT_THROW(BSplineBasis(1, {0, 0.1, 0.5, 1, 1}), InputError);
  EXPECT_THROW(BSplineBasis(1, {0, 0, 1, 1, 1}), InputError);
  EXPECT_THROW(BSplineBasis(0, {0, 1}), InputError);
  EXPECT_THROW(BSplineBasis::uniform(3, 3, 0, 1), InputError);
  EXPECT_THROW(BSplineBasis::broken(3, 7, -1, 0, 1), InputError);
  EXPECT_THROW(BSplineBasis::broken(3, 8, 1, 0, 2), InputError);
}

}  // namespace cleft
