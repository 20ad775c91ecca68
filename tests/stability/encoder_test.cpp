// Where the fit of a series, and the splines it makes, meet their limits.
#include <gtest/gtest.h>

#include "base/error.h"
#include "encoder/field/file/field_file.h"
#include "tests/encoder/synthetic_snapshot.h"
#include "tests/pipeline/commands.h"
#include "tests/support/stability_row.h"

namespace cleft {

namespace {

const Rung few_knots = {2, 3, 2, 3, 2, 1, 3};

/// On v = 0, from left to right.
Vec3 gap_at(const Field& field, double u, double t) {
  return field.displacement({u, 0, 0}, Side::right, t) - field.displacement({u, 0, 0}, Side::left, t);
}

std::string message_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

/// A uniform stretch that sways in time.
Vec3 swaying(const Vec3& p, Side, double t) {
  return std::sin(0.7 * t) * Vec3{0.1 * p.x, 0.05 * p.x + 0.1, 0.02 * p.y};
}

struct InTime {
  double at_frames = 0, between = 0, coefficient = 0;  ///< over the largest displacement
};

InTime fit_in_time(const std::vector<double>& times) {
  const SyntheticSnapshot data(cut_in(grid(6, 4, 2), times), swaying);
  const Field field = encoded_within(data.series(), 0.01, "fixed").field;
  InTime result;
  const double largest = field.report.largest_displacement;
  result.at_frames = field.report.node_error;
  result.coefficient = largest_coefficient(field) / largest;
  const Vec3 p{3, 2.5, -1.25};
  for (double t = 0; t <= 8; t += 0.125)
    result.between = std::max(
        result.between, norm(field.displacement(p, Side::right, t) - swaying(p, Side::right, t)) / largest);
  return result;
}

}  // namespace

TEST(EncoderLimits, TipAtAKnot) {
  const SyntheticSnapshot data(opening);
  const Series series = data.series();
  const Field fixed = encoded_on(series, "fixed", few_knots).field,
              tip = encoded_on(series, "tip", few_knots).field;
  // On the tip, just ahead of it, and between two places where a frame leaves it.
  double largest = 0;
  for (double t = 0; t <= 8; t += 0.125)
    for (const double ahead : {0., 1e-12, 0.01}) {
      EXPECT_EQ(norm(gap_at(tip, t - 4 + ahead, t)), 0) << t;
      largest = std::max(largest, norm(gap_at(fixed, t - 4 + ahead, t)));
    }
  EXPECT_GT(largest, 0.1 * series.largest_displacement);
  EXPECT_GT(fixed.report.false_gap, 0.1);
  record_limit(
      {.method = "splines of the parametrisation `fixed` near the tip",
       .limit = "the tip at a knot, and between knots",
       .shown = "uncut tissue at and ahead of the tip opens by up to " +
                rounded(largest / series.largest_displacement) + " of the largest displacement",
       .noticed = "`false_gap` of the report (" + rounded(fixed.report.false_gap) + " at the nodes)",
       .then =
           "`front`, the default, and `tip` keep a knot at the tip at every t and tie the sides: no gap, to "
           "the last bit"});
}

TEST(EncoderLimits, TipOutsideThePatch) {
  const auto moved = [](double by) {
    Snapshot s = cut_in(grid(), eight_times);
    s.cut_start += by;
    for (double& u : s.position) u += by;
    return s;
  };
  std::string refused;
  for (const double by : {-20., 20.}) {
    const SyntheticSnapshot data(moved(by), opening);
    refused = message_of([&] { data.series(); });
    EXPECT_NE(refused.find("/cut/position"), std::string::npos) << refused;
  }
  const SyntheticSnapshot data(moved(3), opening);  // leaves the body in the last frame
  const FitReport beyond = encoded_on(data.series(), "tip", few_knots).field.report,
                  inside = encoded_on(SyntheticSnapshot(opening).series(), "tip", few_knots).field.report;
  EXPECT_GT(beyond.node_error, 2 * inside.node_error);
  record_limit(
      {.method = "parametrisations `tip` and `front`",
       .limit = "the file states a tip outside the patch, or at a wrong place",
       .shown = "3 mm ahead of where the data separate, and outside the body at the end: node_error " +
                rounded(beyond.node_error) + " instead of " + rounded(inside.node_error) +
                " on the same knots",
       .noticed =
           "at a wrong place: `node_error`, which is bounded; outside: " + quoted(refused, "the tip stands"),
       .then = "tips beyond the end of the body are moved to it; outside: exit code 2"});
}

TEST(EncoderLimits, PairsThatCloseNothing) {
  const Snapshot sound = cut_in(grid(), eight_times);
  const auto coincident_without_side = [](const Snapshot& s) {
    const std::vector<Sample> samples = samples_of(s);
    int count = 0;
    for (std::size_t a = 0; a < samples.size(); ++a)
      for (std::size_t b = 0; b < samples.size(); ++b)
        if (a != b && samples[a].side == Side::both && samples[a].uvw == samples[b].uvw) ++count;
    return count;
  };
  EXPECT_EQ(coincident_without_side(sound), 0);
  const auto [left, right] = sound.pairs[2];
  std::string twice;
  int lost = 0;
  using Pair = std::array<std::int32_t, 2>;
  for (const Pair& wrong : {Pair{left, left}, Pair{right, left}, Pair{left, right}}) {
    Snapshot s = sound;
    s.pairs[3] = wrong;
    lost = coincident_without_side(s);
    EXPECT_EQ(lost, 2);
    twice = message_of([&] { SyntheticSnapshot data(s, opening); });
    EXPECT_NE(twice.find("/cut/pairs: row 3"), std::string::npos) << twice;
  }
  record_limit({.method = "pairs of a snapshot",
                .limit = "a pair given twice, once either way, or of one node",
                .shown = std::to_string(lost) + " nodes that should have a pair lose their side: lips that "
                                                "separate there would be uncut tissue to the fit",
                .noticed = "reading the file: " + quoted(twice, "/cut/pairs"),
                .then = "exit code 2"});
}

TEST(EncoderLimits, UnevenTimes) {
  const InTime even = fit_in_time({0, 1, 2, 3, 4, 5, 6, 7, 8}),
               crowded =
                   fit_in_time({0, 1e-9, 1, 1 + 1e-6, 2, 3, 3.001, 3.002, 3.003, 4, 5, 6, 7, 8 - 1e-9, 8}),
               gap = fit_in_time({0, 1, 2, 7, 8});
  for (const InTime& fit : {even, crowded, gap}) {
    EXPECT_LE(fit.at_frames, 0.01);
    EXPECT_LE(fit.coefficient, 2);
  }
  EXPECT_LE(crowded.between, even.between + 2 * 0.01);  // both keep 0.01 at the frames they share
  EXPECT_GT(gap.between, 10 * even.between);
  record_limit(
      {.method = "splines in time",
       .limit = "time steps of very different size",
       .shown = "largest error between frames: steps of 1, " + rounded(even.between) +
                "; with further frames 1e-9 to 1e-3 next to those, " + rounded(crowded.between) +
                "; with none between t = 2 and 7, " + rounded(gap.between) +
                " of the largest displacement; no coefficient above " +
                rounded(std::max({even.coefficient, crowded.coefficient, gap.coefficient})) + " times it",
       .noticed = "not detected: errors are those at frames, and the tolerance bounds no others",
       .then = "the regularisation in t determines the spline where frames crowd, and where there are none"});
}

TEST(EncoderLimits, BeyondTheLastFrame) {
  const TemporaryFolder folder;
  const Field field = encoded_on(SyntheticSnapshot(opening).series(), "tip", few_knots).field;
  write_field(folder / "case.dffd", field);
  const Vec3 p{0, 1, 0};
  const Vec3 last = field.displacement(p, Side::right, 8), later = field.displacement(p, Side::right, 12);
  EXPECT_EQ(last, later);
  const double change = norm(opening(p, Side::right, 12) - opening(p, Side::right, 8));
  const Outcome asked = run_cleft(
      "eval", {folder / "case.dffd", "--points", folder.write("points.csv", "u,v,w,side,t\n0,1,0,0,12\n")});
  EXPECT_EQ(asked.exit_code, 2) << asked.output;
  record_limit(
      {.method = "evaluation of a field",
       .limit = "t after the last frame",
       .shown = "at t = 12 of 8 the field stands still, where the opening it was made from moves by " +
                rounded(change / field.report.largest_displacement) + " of the largest displacement",
       .noticed = "`cleft eval`: " + quoted(asked.output, "t = 12"),
       .then = "exit code 2; in the library places and times are clamped to the domain, as stated"});
}

}  // namespace cleft
