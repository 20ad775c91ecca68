// Cuts that nobody has drawn before: the scalpel goes where it likes, and its places, pulled back to the skin
// at rest, are the path.
#include <gtest/gtest.h>

#include "explorer/scalpel/scalpel_cutting.h"
#include "explorer/wound/replayed_wounds.h"
#include "tests/haptic/surfaces.h"
#include "tests/incision/stress/soundness.h"
#include "tests/wound/family_file.h"
#include "tests/wound/fields.h"

namespace cleft {
namespace {

constexpr double radius = 100, depth = 4;

SurfaceMesh ball_on_its_side(int rings) {
  testing::Surface ball = testing::ball(rings, radius);
  SurfaceMesh mesh{ball.points, ball.triangles};
  for (Vec3& p : mesh.points) p = {p.z, p.x, p.y};  // poles beside the cuts
  return mesh;
}

/// Over the top of the ball from x0 to x1 mm, bent, `aside` mm off the middle.
ScalpelPath over_the_ball(double x0, double x1, double aside, double bend) {
  std::vector<ScalpelPath::Point> points;
  for (int k = 0; k <= 40; ++k) {
    const double x = (x0 + (x1 - x0) * k / 40) / radius, y = aside / radius + bend * x * x;
    const Vec3 on{std::sin(x) * std::cos(y), std::sin(y), std::cos(x) * std::cos(y)};
    points.push_back({radius * on, on, depth});
  }
  return ScalpelPath(points);
}

/// The blade as the loop tells of it, as deep as it is under the skin that is felt.
HapticState blade(const ScalpelPath& path, double s) {
  const PathFrame frame = path.at(s);
  HapticState state;
  state.phase = Phase::cutting;
  state.pose.tip = frame.position - depth * frame.outward;
  state.pose.axis = frame.outward, state.pose.edge = frame.along;
  state.normal = frame.outward;
  state.depth = depth;
  return state;
}

void cut_along(ScalpelCutting& cutting, const ScalpelPath& path, double to) {
  for (double s = 0; s <= to; s += 0.45) cutting.step(blade(path, s));
}
void take_out(ScalpelCutting& cutting) {
  cutting.step({});
  while (cutting.figures().waiting > 0) cutting.step({});
}

/// Farthest that the incision's vertices lie from the path.
double astray(const Incision& incision, const ScalpelPath& path) {
  double farthest = 0;
  for (const auto& v : incision.chain())
    farthest = std::max(farthest, std::abs(path.coordinates(incision.mesh().position(v.left)).v));
  return farthest;
}

TEST(FreeCutting, TheCutIsWhereTheBladeHasBeen) {
  for (const int rings : {20, 54, 110}) {
    const SurfaceMesh mesh = ball_on_its_side(rings);
    ScalpelCutting cutting(mesh, {{}, {}, {}, 1, 0});
    const ScalpelPath path = over_the_ball(-20, 20, 0, 1.2);
    cut_along(cutting, path, path.length());
    EXPECT_EQ(cutting.figures().stopped, "") << rings;
    ASSERT_EQ(cutting.free_cuts().size(), 1u) << rings;
    EXPECT_GT(cutting.cut_length(), path.length() - 1.2) << "a piece and the scalpel's last step may be left";
    EXPECT_LT(cutting.cut_length(), path.length() + 0.01) << rings;
    // The ball's faces lie under the path: across it no blade that stands upright is drawn aside. What is
    // left are straight pieces, and places that lie 0.9 mm apart on a curve of 0.024 / mm: 0.0024 mm.
    EXPECT_LT(astray(*cutting.incision(), path), 0.06) << rings;
    EXPECT_EQ(stress::Soundness(cutting.mesh()).whole(), "") << rings;
    EXPECT_EQ(stress::Soundness(cutting.mesh()).euler(), 2) << rings;
  }
}

TEST(FreeCutting, SeveralCutsAndWhatStopsThem) {
  const SurfaceMesh mesh = ball_on_its_side(54);
  const auto field = std::make_shared<Field>(testing::opening_field({-10, 20, depth}, 40, 30, 8, 2));
  ScalpelCutting cutting(mesh, {{}, {}, CutFields(field), 1, 0});
  cut_along(cutting, over_the_ball(-20, 20, 0, 0), 30);
  const double first = cutting.cut_length();
  EXPECT_GT(first, 28.5);
  HapticState back = blade(over_the_ball(-20, 20, 0, 0), 10);
  for (int k = 0; k < 20; ++k) cutting.step(back);
  EXPECT_EQ(cutting.cut_length(), first) << "in the wound nothing is cut";
  back.pose.cutting = false;
  take_out(cutting);
  cut_along(cutting, over_the_ball(-15, 15, 25, 0), 25);
  EXPECT_EQ(cutting.free_cuts().size(), 2u);
  EXPECT_NEAR(cutting.cut_length() - first, 25, 1.2);
  take_out(cutting);
  // Across the first one: a wound is no end.
  std::vector<ScalpelPath::Point> across;
  for (int k = -20; k <= 20; ++k) {
    const double y = 0.5 * k / radius, x = 0.03;
    const Vec3 on{std::sin(x) * std::cos(y), std::sin(y), std::cos(x) * std::cos(y)};
    across.push_back({radius * on, on, depth});
  }
  const double before = cutting.cut_length();
  cut_along(cutting, ScalpelPath(across), 20);
  EXPECT_EQ(cutting.free_cuts().size(), 3u);
  EXPECT_NEAR(cutting.cut_length() - before, 20, 2.2) << cutting.figures().stopped;
  EXPECT_EQ(stress::Soundness(cutting.mesh()).whole(), "");
  for (std::size_t v = 0; v < cutting.mesh().vertices().size(); ++v)
    ASSERT_TRUE(std::isfinite(cutting.position(static_cast<int>(v)).x));
}

TEST(FreeCutting, ItOpensAsTheCutWouldHaveThatWasDrawnBefore) {
  for (const double bend : {0., 0.6}) {
    const SurfaceMesh mesh = ball_on_its_side(54);
    const auto field = std::make_shared<Field>(testing::opening_field({-15, 30, depth}, 60, 50, 8, 4));
    ScalpelCutting cutting(mesh, {{}, {}, CutFields(field), 1, 0});
    const ScalpelPath path = over_the_ball(-20, 20, 0, bend);
    cut_along(cutting, path, 32);
    take_out(cutting);
    const double tip = cutting.incision()->tip();
    ASSERT_GT(tip, 30);
    Incision incision(mesh, cutting.incision()->path());  // all of it known before
    incision.advance_to(tip);
    const Replay replay(Wound(incision, *field, 1));
    std::vector<Vec3> seen(replay.vertex_count());
    replay.positions(tip, seen);
    double farthest = 0, moved = 0;
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
      if (incision.mesh().vertex(static_cast<int>(v)).kind != VertexKind::skin ||
          cutting.mesh().vertex(static_cast<int>(v)).kind != VertexKind::skin)
        continue;
      // Inside a bend displacements end where the path's room does, which nobody knew before.
      if (bend > 0 && std::abs(incision.path().coordinates(mesh.points[v]).v) > 11) continue;
      const Vec3 felt = cutting.position(static_cast<int>(v)) - cutting.mesh().position(static_cast<int>(v));
      farthest = std::max(farthest, norm(seen[v] - replay.rest()[v] - felt));
      moved = std::max(moved, norm(felt));
    }
    EXPECT_GT(moved, 0.8);
    // Vertices stay where they were taken to lie to within 0.25 mm and a turn by 0.1, and the field's
    // gradient is at most 0.15 there: 0.04 and 0.18 mm.
    EXPECT_LT(farthest, 0.22) << bend;
  }
}

/// How far apart the skin of the mesh before is under the scalpel and in a replay with the blade at its tip,
/// mm; and how far it is moved under the scalpel.
struct Difference {
  double farthest = 0, moved = 0;
};
Difference difference(const ScalpelCutting& cutting, const Replay& replay, const Incision& incision) {
  std::vector<Vec3> seen(replay.vertex_count());
  replay.positions(incision.tip(), seen);
  Difference result;
  for (int v = 0; v < cutting.original_points(); ++v) {
    if (incision.mesh().vertex(v).kind != VertexKind::skin ||
        cutting.mesh().vertex(v).kind != VertexKind::skin ||
        incision.mesh().position(v) != cutting.mesh().position(v) ||
        std::abs(incision.path().coordinates(incision.mesh().position(v)).v) > 11)
      continue;
    const Vec3 felt = cutting.position(v) - cutting.mesh().position(v);
    result.farthest = std::max(result.farthest, norm(seen[v] - replay.rest()[v] - felt));
    result.moved = std::max(result.moved, norm(felt));
  }
  return result;
}

/// A family's field is that of the path's shape as far as the blade has come; its displacements double from a
/// straight path to this one. When the blade has left the skin it is that of the whole path.
TEST(FreeCutting, AFamilyFollowsTheShapeOfThePath) {
  const SurfaceMesh mesh = ball_on_its_side(54);
  const testing::FamilyFile file({.with_twist = false, .length = 30, .slope = 30});
  const CutFields fields = read_cut_fields(file.file(), SkinTension{{0, 1, 0}, 0.03, 0.01});
  ScalpelCutting cutting(mesh, {{}, {}, fields, 1, 0});
  const ScalpelPath path = over_the_ball(-20, 20, 0, 1.5);  // of a radius of 33 mm
  cut_along(cutting, path, 32);
  while (cutting.figures().waiting > 0) cutting.step(blade(path, 32));
  const double tip = cutting.incision()->tip();
  ASSERT_GT(tip, 30);
  Incision grown(mesh, cutting.incision()->path());
  grown.advance_to(tip);
  // How the path as a whole opens is known when it is complete.
  const auto growing = difference(cutting, Replay(fields.growing_wound(grown, 1, 0.99 * tip)), grown),
             straight = difference(
                 cutting, Replay(Wound(grown, testing::made({0, 0, 4, 30, 30}, {0.01, 0.03, 0}), 1)), grown);
  // Where the blade has been, the path's curvature is known to 0.007 / mm, half the smoothing behind its tip.
  EXPECT_LT(growing.farthest, 30 * 0.007 * growing.moved);
  EXPECT_GT(straight.farthest, 0.4 * straight.moved);

  take_out(cutting);
  EXPECT_EQ(cutting.incision()->extended_to(), 0);
  EXPECT_NEAR(cutting.incision()->path().length(), tip, 1e-9);
  Incision known(mesh, cutting.incision()->path());  // all of it known before
  known.advance_to(tip);
  const auto complete = difference(cutting, Replay(fields.wound(known, 1)), known);
  EXPECT_LT(complete.farthest, 0.02 * complete.moved);
  EXPECT_GT(growing.farthest, 0.05 * growing.moved) << "else nothing is tested";
}

/// The blade's last place, and its first one, are up to a piece of its way beside the wound of another cut.
TEST(FreeCutting, CutsThatEndOrBeginBesideAWoundComeToIt) {
  const SurfaceMesh mesh = ball_on_its_side(54);
  const testing::FamilyFile file({.with_twist = false, .length = 30});
  const CutFields fields = read_cut_fields(file.file(), SkinTension{{0, 1, 0}, 0.02, 0.02});
  const auto up_to = [](double from, double to) {  // across the other cut, mm beside it
    std::vector<ScalpelPath::Point> points;
    for (int k = 0; k <= 40; ++k) {
      const double y = (from + (to - from) * k / 40) / radius;
      points.push_back({radius * Vec3{0, std::sin(y), std::cos(y)}, {0, std::sin(y), std::cos(y)}, depth});
    }
    return ScalpelPath(points);
  };
  for (const bool begins : {false, true})
    for (const double gap : {0.6, 2.}) {
      const bool joins = gap < 1;
      ScalpelCutting cutting(
          mesh, {{}, {over_the_ball(-15, 15, 0, 0)}, joins ? std::optional(fields) : std::nullopt, 1, 0});
      const ScalpelPath path = begins ? up_to(gap, 16) : up_to(16, gap);
      cut_along(cutting, path, path.length());
      take_out(cutting);
      const Incision& branch = *cutting.incision();
      const auto end = begins ? branch.chain().front() : branch.chain().back();
      const double beside = branch.mesh().position(end.left).y;
      if (!joins) {
        EXPECT_GT(beside, gap - 1) << begins;
        continue;
      }
      EXPECT_NEAR(beside, 0, 0.02) << begins;
      EXPECT_EQ(cutting.figures().stopped, "") << begins;
      EXPECT_NEAR((begins ? cutting.free_cuts()[0].front() : cutting.free_cuts()[0].back()).position.y, 0,
                  0.02);
      // The corners of its two lips are apart: it is open there.
      double apart = 0;
      for (const auto& one : branch.chain())
        if (std::abs(branch.mesh().position(one.left).y) < 0.3)
          apart = std::max(apart, norm(cutting.position(one.left) - cutting.position(one.right)));
      EXPECT_GT(apart, 0.3) << begins;

      CutMesh both(mesh);  // all of the two paths known before
      std::vector<std::unique_ptr<Incision>> known;
      for (const ScalpelPath& one : {over_the_ball(-15, 15, 0, 0), branch.path()}) {
        known.push_back(std::make_unique<Incision>(both, one, IncisionOptions{}));
        known.back()->advance_to(one.length());
      }
      const ReplayedWounds wounds({fields.wound(*known[0], 1), fields.wound(*known[1], 1)});
      std::vector<Vec3> seen(wounds.vertex_count());
      wounds.positions(wounds.duration(), seen);
      double farthest = 0, moved = 0;
      for (int v = 0; v < cutting.original_points(); ++v) {
        if (both.vertex(v).kind != VertexKind::skin || cutting.mesh().vertex(v).kind != VertexKind::skin ||
            both.position(v) != cutting.mesh().position(v))
          continue;
        farthest = std::max(farthest, norm(seen[v] - cutting.position(v)));
        moved = std::max(moved, norm(seen[v] - both.position(v)));
      }
      EXPECT_LT(farthest, 0.01 * moved) << begins;
      EXPECT_EQ(stress::Soundness(cutting.mesh()).whole(), "");
    }
}

}  // namespace
}  // namespace cleft
