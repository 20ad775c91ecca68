#include <gtest/gtest.h>

#include <cmath>

#include "tests/field/random_field.h"

namespace cleft {

namespace {

/// 1000 random times, and those around the passage of the tip.
std::vector<double> times_of(const Field& field, double u) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> uniform(-1, 25);
  std::vector<double> times(1000);
  for (double& t : times) t = uniform(random);
  const double passes = field.parametrization().geometry().tip.passes(u);
  if (passes <= 24)
    for (const double away : {0., 1e-12, 1e-9, 1e-6, 1e-3, 0.1}) {
      times.push_back(passes - away);
      times.push_back(passes + away);
    }
  return times;
}

double largest_error(const Field& field, const Place& p, const History& history) {
  double error = 0;
  for (const double t : times_of(field, p.uvw.x))
    error = std::max(error, norm(evaluate(history, t) - field.displacement(p.uvw, p.side, t)));
  return error;
}

}  // namespace

TEST(Contraction, IsExactWhereTheParametersDoNotMove) {
  std::vector<Field> fields{random_field()};
  for (const int degree : {1, 2}) {
    const std::array<BSplineBasis, 4> bases{
        BSplineBasis::uniform(3, 5, -30, 30), BSplineBasis::broken(3, 9, -20, 0, 20),
        BSplineBasis::uniform(3, 5, -8, 0), BSplineBasis::uniform(degree, 4, 0, 24)};
    fields.emplace_back(bases[0], bases[1], bases[2], bases[3], random_coefficients(bases),
                        CanonicalCut{-12, 24, 3});
  }
  const std::vector<double> stops{1, 7.3, 12, 23.999};
  History history;
  for (Field field : fields)
    for (const Kernel kernel : available_kernels()) {
      field.use(kernel);
      for (const Place& p : all_kinds_of_places(field, 60)) {
        field.contract(p.uvw, p.side, 0, history);
        EXPECT_EQ(history.controls.size() + 1, field.knot_times().size());
        EXPECT_EQ(history.breaks, field.knot_times());
        ASSERT_LT(largest_error(field, p, history), rounding);
        field.contract(p.uvw, p.side, 0, stops, history);
        for (const double stop : stops)
          EXPECT_TRUE(std::binary_search(history.breaks.begin(), history.breaks.end(), stop));
        ASSERT_LT(largest_error(field, p, history), rounding);
      }
    }
}

TEST(Contraction, FollowsTheTipWithinItsTolerance) {
  const std::vector<double> stops{1, 7.3, 12, 23.999};
  History history;
  for (const unsigned seed : {1u, 2u}) {
    Field field = tip_field(seed);
    for (const double tolerance : {1e-2, 1e-4, 1e-6}) {
      std::size_t pieces = 0, count = 0;
      std::vector<Place> places = all_kinds_of_places(field, 60);
      // Just behind the cut's start, where the tip is gone at once. (Nearer still, rounding of u counts.)
      for (const double beyond : {1e-7, 1e-4, 1e-2, 0.3})
        places.push_back({{-12 + beyond, 3, -1}, Side::right, 0});
      for (const Place& p : places) {
        field.contract(p.uvw, p.side, tolerance, history);
        pieces += history.controls.size(), ++count;
        ASSERT_LE(history.error, tolerance);
        ASSERT_EQ(history.breaks.size(), history.controls.size() + 1);
        ASSERT_TRUE(std::is_sorted(history.breaks.begin(), history.breaks.end()));
        ASSERT_LE(largest_error(field, p, history), tolerance) << p.uvw.x;
        for (std::size_t i = 1; i < history.controls.size(); ++i)
          ASSERT_LT(norm(history.controls[i][0] - history.controls[i - 1][3]), 1e-9) << "pieces meet";
        field.contract(p.uvw, p.side, tolerance, stops, history);
        for (const double stop : stops)
          EXPECT_TRUE(std::binary_search(history.breaks.begin(), history.breaks.end(), stop));
        ASSERT_LE(largest_error(field, p, history), tolerance);
      }
      // The error of a piece goes with its length to the fourth: a hundredth needs about three times as many.
      EXPECT_LT(static_cast<double>(pieces) / static_cast<double>(count),
                12 * std::pow(1e-2 / tolerance, 0.25));
    }
  }
}

/// What is asked for to a stop is the beginning of the whole, bit for bit.
TEST(Contraction, EndsWhereNoMoreIsAskedFor) {
  const std::vector<double> stops{1, 7.3, 12, 23.999};
  History whole, part;
  for (const Field& field : {random_field(), tip_field(1)})
    for (const Place& p : all_kinds_of_places(field, 60)) {
      field.contract(p.uvw, p.side, 1e-4, stops, whole);
      field.contract(p.uvw, p.side, 1e-4, stops, part, 12);
      ASSERT_EQ(part.breaks.back(), 12);
      ASSERT_LT(part.breaks.size(), whole.breaks.size());
      ASSERT_TRUE(std::equal(part.breaks.begin(), part.breaks.end(), whole.breaks.begin()));
      ASSERT_TRUE(std::equal(part.controls.begin(), part.controls.end(), whole.controls.begin()));
    }
}

TEST(Contraction, ZeroToleranceEnds) {
  const Field field = tip_field();
  History history;
  field.contract({2, 3, -1}, Side::right, 0, history);
  EXPECT_LT(largest_error(field, {{2, 3, -1}, Side::right, 0}, history), 1e-11);
  EXPECT_LT(history.controls.size(), 5000u);
}

}  // namespace cleft
