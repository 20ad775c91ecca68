// Bases made finer: the same function, to rounding.
#include "encoder/field/knot_insertion.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "tests/field/random_field.h"

namespace cleft {

namespace {

/// Knots in every axis: some twice, some next to others, some at the kinks of the tip and the bottom.
std::array<BSplineBasis, 4> finer_tip_bases() {
  auto bases = tip_bases();
  const std::array<std::vector<double>, 4> more = {std::vector<double>{0.1, 0.4, 0.4, 1.31, 1.5, 1.99, 2.9},
                                                   {-0.9, -1e-3, 0.25, 0.5, 0.5},
                                                   {-1.5, -0.4, -0.2},
                                                   {0.01, 0.2, 0.21, 0.93}};
  for (int axis = 0; axis < 4; ++axis) {
    std::vector<double> knots = bases[axis].knots();
    knots.insert(knots.end(), more[axis].begin(), more[axis].end());
    std::sort(knots.begin(), knots.end());
    bases[axis] = BSplineBasis(3, knots);
  }
  return bases;
}

}  // namespace

TEST(KnotInsertion, LeavesTheFunctionAsItIs) {
  const Field field = tip_field();
  const auto finer = finer_tip_bases();
  const Field raised(field.shared_parametrization(), finer,
                     insert_knots(field.coefficients(), tip_bases(), finer));
  for (const Place& place : all_kinds_of_places(field, 2000)) {
    const Vec3 a = field.displacement(place.uvw, place.side, place.t);
    const Vec3 b = raised.displacement(place.uvw, place.side, place.t);
    EXPECT_LE(norm(a - b), 1e-13) << place.uvw.x << " " << place.uvw.y << " " << place.uvw.z << " "
                                  << place.t;
  }
}

TEST(KnotInsertion, OfDegreesOneAndTwo) {
  for (const int degree : {1, 2}) {
    const BSplineBasis from = BSplineBasis::uniform(degree, 6, 0, 1);
    std::vector<double> knots = from.knots();
    knots.insert(knots.end(), {0.1, 0.3, 0.77});
    std::sort(knots.begin(), knots.end());
    const BSplineBasis to(degree, knots);
    const std::vector<BandRow> rows = knot_insertion(from, to);
    ASSERT_EQ(rows.size(), 9u);
    for (double x = 0; x <= 1; x += 1. / 64) {
      const auto coarse = from.evaluate(x), fine = to.evaluate(x);
      std::vector<double> sum(6);
      for (int i = 0; i <= degree; ++i) {
        const auto& row = rows[fine.first + i];
        for (std::size_t n = 0; n < row.weight.size(); ++n)
          sum[static_cast<std::size_t>(row.first) + n] += fine.value[i] * row.weight[n];
      }
      for (int i = 0; i <= degree; ++i) sum[coarse.first + i] -= coarse.value[i];
      for (const double rest : sum) EXPECT_NEAR(rest, 0, 1e-14) << x;
    }
  }
}

TEST(KnotInsertion, LipsThatAreOneStayOneToTheLastBit) {
  // The two control points that meet in v = 0 are equal: no gap may open, however the axes are refined.
  const auto bases = tip_bases(), finer = finer_tip_bases();
  const int V = bases[1].size(), W = bases[2].size(), T = bases[3].size();
  const int right = bases[1].evaluate(0, Limit::from_right).first;
  auto points = random_coefficients(bases);
  const auto at = [](int i, int j, int k, int l, int v, int w, int t) {
    return static_cast<std::size_t>(((i * v + j) * w + k) * t + l);
  };
  for (int i = 0; i < bases[0].size(); ++i)
    for (int k = 0; k < W; ++k)
      for (int l = 0; l < T; ++l)
        points[at(i, right, k, l, V, W, T)] = points[at(i, right - 1, k, l, V, W, T)];
  const auto raised = insert_knots(points, bases, finer);
  const int fine_right = finer[1].evaluate(0, Limit::from_right).first;
  for (int i = 0; i < finer[0].size(); ++i)
    for (int k = 0; k < finer[2].size(); ++k)
      for (int l = 0; l < finer[3].size(); ++l)
        ASSERT_EQ(raised[at(i, fine_right, k, l, finer[1].size(), finer[2].size(), finer[3].size())],
                  raised[at(i, fine_right - 1, k, l, finer[1].size(), finer[2].size(), finer[3].size())]);
}

TEST(KnotInsertion, CommonBasesHaveTheKnotsOfBothAndNoMore) {
  const BSplineBasis a(3, {0, 0, 0, 0, 0.25, 0.5, 0.5, 1, 1, 1, 1}),
      b(3, {0, 0, 0, 0, 0.5, 0.75, 1, 1, 1, 1});
  EXPECT_EQ(common_basis(a, b).knots(), (std::vector<double>{0, 0, 0, 0, 0.25, 0.5, 0.5, 0.75, 1, 1, 1, 1}));
  EXPECT_EQ(common_basis(a, a).knots(), a.knots());
}

TEST(KnotInsertion, WhatHasNoCommonBasisIsRefused) {
  const BSplineBasis cubic = BSplineBasis::uniform(3, 8, 0, 1);
  EXPECT_THROW(common_basis(cubic, BSplineBasis::uniform(2, 8, 0, 1)), InputError);
  EXPECT_THROW(common_basis(cubic, BSplineBasis::uniform(3, 8, 0, 2)), InputError);
  EXPECT_THROW(common_basis(cubic, BSplineBasis::broken(3, 8, 0, 0.5, 1)), InputError);
  EXPECT_THROW(knot_insertion(cubic, BSplineBasis::uniform(3, 6, 0, 1)), InputError);
}

}  // namespace cleft
