// Uncut tissue has no gap at all, and lips that have parted know nothing of each other.
#include <gtest/gtest.h>

#include <random>
#include <set>

#include "encoder/field/file/field_file.h"
#include "encoder/field/unknowns.h"
#include "encoder/series_fit.h"
#include "tests/encoder/synthetic_snapshot.h"

namespace cleft {

TEST(Ties, SidesAreOneWhereTheTissueIsUncut) {
  // Contradicts itself ahead of the tip, where some sides' nodes are still to part.
  const SyntheticSnapshot data([](const Vec3& p, Side side, double t) {
    return opening(p, side, t) + Vec3{0, 0.1 * sign_of(p, side) * t, 0.02 * t * p.x};
  });
  const TemporaryFolder folder;
  const Field field = encoded_within(data.series(), 0.05).field;
  write_field(folder / "case.dffd", field);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> u(-6, 6), w(-2.5, 0), t(0, 8);
  for (const Field& f : {field, read_field(folder / "case.dffd")}) {
    int open = 0, closed = 0;
    for (int n = 0; n < 3000; ++n) {
      const Vec3 p{u(random), 0, w(random)};
      const double now = t(random);
      const Vec3 left = f.displacement(p, Side::left, now), right = f.displacement(p, Side::right, now);
      if (p.x <= -4 || p.x >= now - 4 || p.z <= -1.5) {
        ASSERT_EQ(left, right) << p.x << ' ' << p.z << ' ' << now;
        ++closed;
      } else {
        open += left == right ? 0 : 1;
      }
    }
    EXPECT_GT(closed, 1000);
    EXPECT_GT(open, 500);
  }
  // At the nodes that are single, and at pairs that are still closed where the data agree.
  EXPECT_EQ(encoded_within(SyntheticSnapshot(opening).series(), 0.05).field.report.false_gap, 0);
}

TEST(Ties, UncutSkinHasNoCrease) {
  // The lips' data have a cusp across v = 0 at the tip and at the start.
  const Field field = encoded_within(SyntheticSnapshot(opening).series(), 0.05).field;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(-6, 6), t(0, 8);
  int uncut = 0, open = 0;
  for (int n = 0; n < 2000; ++n) {
    const Vec3 p{u(random), 0, 0};
    const double now = t(random);
    const double kink =
        norm(field.derivatives(p, Side::right, now).by_v - field.derivatives(p, Side::left, now).by_v);
    if (p.x < -4 || p.x > now - 4) {
      ASSERT_LT(kink, 1e-12) << p.x << ' ' << now;
      ++uncut;
    } else {
      open += kink > 1e-3 ? 1 : 0;
    }
  }
  EXPECT_GT(uncut, 500);
  EXPECT_GT(open, 300);
}

TEST(Ties, ControlPointsOfTheOpenCutAreUnknownsOfTheirOwn) {
  const Series series = SyntheticSnapshot(opening).series();
  const auto parametrization = make_parametrization("tip", series.geometry);
  const auto bases = bases_of({2, 4, 2, 3, 3, 2, 1}, *parametrization, 8);
  const ControlTies ties = ties_of("tip", bases);
  const int W = bases[2].size(), right = bases[1].size() / 2;
  // Start and tip are knots of multiplicity 3; the control points that interpolate there are the rim's.
  const int start = 4, tip = start + 6, bottom = 4;
  ASSERT_EQ(bases[0].knots()[start + 1], 1);
  ASSERT_EQ(bases[0].knots()[tip + 1], 2);
  ASSERT_EQ(bases[2].knots()[bottom + 1], -1);
  for (int i = 0; i < ties.rows(); ++i) {
    std::set<int> own;
    for (const ControlTies::Control& c : ties.row(i)) {
      double sum = 0;
      for (int k = 0; k < c.terms; ++k) sum += c.term[k].weight;
      EXPECT_NEAR(sum, 1, 1e-15);  // a rigid motion is not hindered
      if (c.terms == 1) own.insert(c.term[0].unknown);
    }
    EXPECT_EQ(static_cast<int>(own.size()), ties.row_size(i));
    for (int k = 0; k < W; ++k) {
      const ControlTies::Control &l = ties.row(i)[(right - 1) * W + k], &r = ties.row(i)[right * W + k];
      const bool open = i > start && i < tip && k > bottom;
      if (open) {
        EXPECT_EQ(l.terms, 1);
        EXPECT_EQ(r.terms, 1);
      }
      EXPECT_EQ(l.term[0].unknown == r.term[0].unknown && l.terms == r.terms, !open) << i << ' ' << k;
    }
  }
}

/// Where there is no uncut tissue on the plane at all, the data of one side are no business of the other.
TEST(Ties, WhatHappensOnTheRightChangesNothingOnTheLeft) {
  std::vector<Vec3> points;
  for (const Vec3& p : grid()) points.push_back({p.x * 0.6, p.y, p.z});  // all of v = 0 is within the cut
  for (const char* name : {"fixed", "tip"}) {
    std::vector<Field> fields;
    for (const double wild : {0., 1.}) {
      Snapshot s = cut_in(points, eight_times, 3);
      s.cut_start = -3.6, s.cut_length = 7.2, s.cut_depth = 2.5;
      s.position.assign(s.frames(), 3.6);
      s.released.assign(s.frames(), static_cast<int>(s.pairs.size())), s.released[0] = 0;
      const SyntheticSnapshot data(s, [=](const Vec3& p, Side side, double t) {
        return opening(p, side, t) +
               (sign_of(p, side) > 0 ? wild * t * Vec3{std::sin(3 * p.x), 1, std::cos(2 * p.z)} : Vec3{});
      });
      const Series series = data.series();
      const auto parametrization = make_parametrization(name, series.geometry);
      const auto bases = bases_of({2, 4, 2, 3, 2, 1, 2}, *parametrization, 8);
      const SeriesFit fit(series, parametrization, bases);
      fields.push_back(fit.field(fit.control_points()));
    }
    double worst = 0, other = 0;
    for (double u = -3.6; u <= 3.6; u += 0.3)
      for (double v = 0; v <= 5; v += 0.5)
        for (double w = -2.5; w <= 0; w += 0.5)
          for (const double t : {1., 5., 8.}) {
            const auto change = [&](const Vec3& p, Side side) {
              return norm(fields[1].displacement(p, side, t) - fields[0].displacement(p, side, t));
            };
            worst = std::max(worst, change({u, -v, w}, Side::left));
            other = std::max(other, change({u, v, w}, Side::right));
          }
    EXPECT_LT(worst, 1e-9) << name;
    EXPECT_GT(other, 1) << name;
  }
}

}  // namespace cleft
