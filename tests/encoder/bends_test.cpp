// Cuts whose direction turns: what opens turns with it, so that the middle of the cut needs knots too.
#include <gtest/gtest.h>

#include <cmath>

#include "encoder/ladder.h"
#include "encoder/own_coordinates.h"
#include "tests/encoder/bent_snapshot.h"
#include "tests/support/recorded.h"

namespace cleft {
namespace {

/// Lips part along one direction in space, wherever the cut turns.
Vec3 opening_one_way(const Vec3& p, Side side, double t, double curvature) {
  const double behind = std::max(0., (p.x + 4) * (t - 4 - p.x)), open = std::max(0., 1 + p.z / 1.5);
  const double gape = 0.2 * std::sqrt(behind) * open * std::exp(-std::abs(p.y) / 2) * sign_of(p, side);
  return {gape * std::sin(4 * curvature * p.x), gape * std::cos(4 * curvature * p.x), 0};
}

/// A grid whose cut turns in the skin: the direction of the cut at u is turned by `angle(u)`.
struct TurningSnapshot {
  static constexpr int along = 48, across = 28, deep = 6;
  TemporaryFolder folder;
  std::string file = folder / "case.h5";

  /// `body`: as a true body has it, instead of a shaped patch. `narrow`: the width of its end over that
  /// elsewhere. `curvature`: what a patch records of its cut; 0: nothing.
  explicit TurningSnapshot(const std::function<double(double)>& angle, const Motion& motion,
                           bool body = false, double narrow = 1, double curvature = 0) {
    Snapshot s = cut_in(grid(along, across, deep), eight_times);
    s.coordinates = !body, s.body = body ? "69debcb3fbba9d88" : "";
    if (curvature != 0)
      s.parameters = recorded({{"patch.length", 12},
                               {"patch.width", 10},
                               {"cut.curvature", curvature},
                               {"cut.length", 8},
                               {"cut.depth", 1.5},
                               {"cut.branch", 0},
                               {"mesh.cut_length", 8},
                               {"mesh.cut_depth", 1.5},
                               {"mesh.element_size", 0.25}});
    add_cells(s);
    const std::vector<Sample> samples = samples_of(s);
    std::vector<double> places, frames;
    std::vector<Vec3> shown;
    for (const Vec3& p : s.points) {
      const double a = angle(p.x);
      places.insert(places.end(), {p.x, p.x > 3 ? narrow * p.y : p.y, p.z});
      frames.insert(frames.end(), {std::cos(a), std::sin(a), 0, -std::sin(a), std::cos(a), 0, 0, 0, 1});
      // The path is a chain of short pieces; displacements do not depend on it.
      Vec3 at{0, 0, p.z};
      constexpr int pieces = 200;
      for (int i = 0; i < pieces; ++i) {
        const double b = angle(p.x * (i + 0.5) / pieces);
        at += p.x / pieces * Vec3{std::cos(b), std::sin(b), 0};
      }
      shown.push_back(at + p.y * Vec3{-std::sin(a), std::cos(a), 0});
    }
    const std::vector<Vec3> own = s.points;
    s.points = shown;
    SnapshotWriter writer(file, s, {canonical_array, frame_array});
    writer.write_array(canonical_array, 0, places);
    writer.write_array(frame_array, 0, frames);
    for (std::size_t j = 0; j < s.frames(); ++j) {
      std::vector<Vec3> d;
      for (std::size_t n = 0; n < own.size(); ++n) {
        const Vec3 local = motion(own[n], samples[n].side, s.times[j]);
        const double* axes = &frames[9 * n];
        d.push_back(in_space(local, axes));
      }
      writer.write_frames(j, d);
    }
    writer.finish(s);
  }
  /// Hexahedra that do not touch the plane of the cut.
  static void add_cells(Snapshot& s) {
    const auto node = [](int i, int j, int k) -> std::int64_t {
      return (i * (across + 1) + j) * (deep + 1) + k;
    };
    for (int i = 0; i < along; ++i)
      for (int j = 0; j < across; ++j)
        for (int k = 0; k < deep; ++k) {
          if (2 * j == across || 2 * j + 2 == across) continue;
          for (const int up : {0, 1})
            for (const auto& [a, b] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
              s.connectivity.push_back(node(i + a, j + b, k + up));
          s.cell_types.push_back(12);
          s.cell_offsets.push_back(static_cast<std::int64_t>(s.connectivity.size()));
        }
  }
  double turning() const {
    const SnapshotReader reader(file);
    return OwnCoordinates(reader).turning(reader.snapshot().pairs);
  }
};

const Motion straight = [](const Vec3& p, Side side, double t) { return opening(p, side, t); };

TEST(Bends, AreTheAnglesBetweenDirectionsOfTheCut) {
  // The first and the last open column are at -3.75 and 3.75 mm.
  const double columns = 7.5;
  EXPECT_NEAR(TurningSnapshot([](double u) { return u / 9; }, straight).turning(), columns / 9, 1e-6);
  // A path that turns back to where it came from.
  const double half = columns / 2;
  EXPECT_NEAR(TurningSnapshot([](double u) { return u * u / 30; }, straight).turning(), half * half / 30,
              1e-6);
  // Curvature u / 15: most at the last column with two on either side.
  const TurningSnapshot spiral([](double u) { return u * u / 30; }, straight);
  const SnapshotReader reader(spiral.file);
  const Bend tightest = OwnCoordinates(reader).tightest_bend(reader.snapshot());
  EXPECT_NEAR(tightest.radius, 15 / 3.25, 0.5);
  // Directions that differ from the axes, but not from each other, are none.
  EXPECT_NEAR(TurningSnapshot([](double) { return 0.7; }, straight).turning(), 0, 1e-9);
}

TEST(Bends, AreNoneOfASkinThatIsCurvedAndAreToldOfASeries) {
  EXPECT_FALSE(Series(SnapshotReader(BentSnapshot(straight).file)).bends);
  EXPECT_FALSE(SyntheticSnapshot(straight).series().bends);
  EXPECT_FALSE(Series(SnapshotReader(TurningSnapshot([](double u) { return u / 40; }, straight).file)).bends);
  EXPECT_TRUE(Series(SnapshotReader(TurningSnapshot([](double u) { return -u / 9; }, straight).file)).bends);
}

void expect_nested(const std::vector<Rung>& ladder, const Parametrization& parametrization) {
  for (std::size_t i = 0; i + 1 < ladder.size(); ++i) {
    const auto few = bases_of(ladder[i], parametrization, 30),
               more = bases_of(ladder[i + 1], parametrization, 30);
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_TRUE(std::includes(more[axis].knots().begin(), more[axis].knots().end(),
                                few[axis].knots().begin(), few[axis].knots().end()))
          << "rung " << i << ", axis " << axis;
  }
}

TEST(Bends, HaveKnotsInTheMiddleOfTheCut) {
  constexpr double curvature = 1. / 9;
  const TurningSnapshot turning(
      [](double u) { return curvature * u; },
      [](const Vec3& p, Side side, double t) { return opening_one_way(p, side, t, curvature); });
  const SnapshotReader reader(turning.file);
  const Series series(reader);
  ASSERT_TRUE(series.bends);
  EncodeOptions options;
  const auto parametrization = fit_store(series, options)->parametrization();
  const auto error_on = [&](bool bends) {
    Rung rung = ladder_of(*parametrization, {.bends = bends}).front();
    rung.along = 8;
    return encoded_on(series, "front", rung).field.report.gape_error;
  };
  const double with = error_on(true), without = error_on(false);
  EXPECT_LT(with, 0.5 * without) << with << ", " << without;
  // Each ladder is one of nested knots.
  const std::vector<Rung> ladder = ladder_of(*parametrization, {.bends = true});
  expect_nested(ladder, *parametrization);
}

/// Lips that part along one direction in space where the cut turns to and fro: as many knots in its middle as
/// at its ends make the error smaller.
TEST(Bends, HaveAllSixteenthsWhereTheCutWinds) {
  const auto angle = [](double u) { return 1.2 * std::sin(1.6 * u); };
  const TurningSnapshot turning(angle, [&](const Vec3& p, Side side, double t) {
    const double gape = norm(opening_one_way(p, side, t, 0)) * sign_of(p, side), a = angle(p.x);
    return Vec3{gape * std::sin(a), gape * std::cos(a), 0};
  });
  Series series{SnapshotReader(turning.file)};
  ASSERT_TRUE(series.winds);
  EXPECT_FALSE(Series(SnapshotReader(TurningSnapshot([](double u) { return u / 9; }, straight).file)).winds);
  const double with = encoded_within(series, 0.01, "front").field.report.spline_error;
  series.winds = false;
  const double without = encoded_within(series, 0.01, "front").field.report.spline_error;
  EXPECT_LT(with, 0.8 * without) << with << ", " << without;
  expect_nested(ladder_of(*fit_store(series, {})->parametrization(), {.bends = true, .winds = true}),
                *fit_store(series, {})->parametrization());
}

TEST(Bends, SpendNoKnotsWhereTheCoordinatesJump) {
  // Beyond the middle of the circle a step along the cut is a leap.
  const TurningSnapshot turning([](double u) { return u / 5; },
                                [](const Vec3& p, Side side, double t) {
                                  Vec3 d = opening(p, side, t);
                                  if (p.y > 4.4) d.z += 0.008 * t * std::cos(1.5 * p.x);
                                  return d;
                                });
  const SnapshotReader reader(turning.file);
  Series series(reader);
  ASSERT_FALSE(series.beside_jumps.empty());
  for (const std::int32_t n : series.beside_jumps) EXPECT_GT(series.samples[n].uvw.y, 3.5);
  const auto size = [](const Encoded& one) {
    const Field& f = one.field;
    return f.basis(0).size() * f.basis(1).size() * f.basis(2).size();
  };
  const Encoded few = encoded_within(series, 0.03, "front");
  series.beside_jumps.clear();
  const Encoded many = encoded_within(series, 0.03, "front");
  EXPECT_LT(size(few), size(many));
  EXPECT_LE(few.field.report.node_error, 0.03);  // by the residual
}

long in_corner(const Series& series) {
  return std::count_if(series.samples.begin(), series.samples.end(),
                       [](const Sample& sample) { return sample.uvw.x > 4 && sample.uvw.y < -4; });
}

/// The edges of a patch are no lines of its cut's coordinates: where these have no node, at a corner of the
/// domain, displacements are held to those of the nearest column of nodes.
TEST(Bends, OfAPatchAreHeldWhereNoNodeIs) {
  constexpr double curvature = 0.12;
  const auto angle = [](double u) { return curvature * u; };
  const TurningSnapshot narrow(angle, straight, false, 0.5, curvature);
  const Series series{SnapshotReader(narrow.file)};
  EXPECT_GT(in_corner(series), 0);
  EXPECT_EQ(in_corner(Series{SnapshotReader(TurningSnapshot(angle, straight, false, 0.5).file)}), 0)
      << "it does not say that its cut curves";
  for (const Sample& sample : series.samples) {
    EXPECT_LE(std::abs(sample.uvw.x), 6 + 1e-9);
    EXPECT_LE(std::abs(sample.uvw.y), 5 + 1e-9);
  }
}

/// As of a shaped patch.
TEST(Bends, OfABodyLeaveOutCellsWhereTheCoordinatesJump) {
  const auto angle = [](double u) { return u / 5; };
  const TurningSnapshot patch(angle, straight), body(angle, straight, true);
  const Series of_patch{SnapshotReader(patch.file)}, of_body{SnapshotReader(body.file)};
  EXPECT_FALSE(of_body.beside_jumps.empty());
  EXPECT_EQ(of_body.beside_jumps, of_patch.beside_jumps);
  EXPECT_EQ(of_body.centres.samples.size(), of_patch.centres.samples.size());
  // Where no node is, at a corner of the domain, the fit is held too.
  const Series narrow{SnapshotReader(TurningSnapshot(angle, straight, true, 0.5).file)};
  EXPECT_EQ(narrow.nodes, of_body.nodes);
  EXPECT_GT(in_corner(of_body), 0);
  EXPECT_GT(in_corner(narrow), 0);
}

}  // namespace
}  // namespace cleft
