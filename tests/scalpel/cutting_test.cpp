// The scalpel cuts a mesh as the loop drives it, in simulated time: every sixteen ticks the mesh follows.
#include <gtest/gtest.h>

#include "explorer/scalpel/cutting_moment.h"
#include "explorer/scalpel/hand_script.h"
#include "explorer/scalpel/scalpel_cutting.h"
#include "explorer/wound/replay.h"
#include "explorer/wound/replayed_wounds.h"
#include "haptic/devices/hand.h"
#include "haptic/surface_stiffness.h"
#include "tests/haptic/surfaces.h"
#include "tests/incision/meshes.h"
#include "tests/support/recorded.h"
#include "tests/wound/fields.h"

namespace cleft {
namespace {

constexpr double radius = 100;

/// Over the top of a ball, bent to one side.
Vec3 place(double a, double height) {
  const double b = 0.1 + 0.2 * a * a;
  return (radius + height) * Vec3{std::sin(a) * std::cos(b), std::sin(b), std::cos(a) * std::cos(b)};
}

ScalpelPath path_over_the_ball(double depth) {
  std::vector<ScalpelPath::Point> points;
  for (int k = -20; k <= 20; ++k)
    points.push_back({place(0.01 * k, 0), normalized(place(0.01 * k, 0)), depth});
  return ScalpelPath(points);
}

/// Through the skin at the start, along the path at `speed` mm/s, out.
std::vector<HandTarget> script(const ScalpelPath& path, double depth, double speed) {
  std::vector<HandTarget> targets;
  const auto at = [&](double time, double s, double height) {
    const PathFrame frame = path.at(s);
    ScalpelPose pose;
    pose.tip = frame.position + height * frame.outward;
    pose.axis = frame.outward, pose.edge = frame.along;
    targets.push_back({time, pose});
  };
  at(0, 0, 5);
  at(0.5, 0, -8);
  at(0.8, 0, -8);
  at(1, 0, -depth);
  for (int k = 1; k <= 80; ++k) at(1 + k * path.length() / 80 / speed, path.length() * k / 80, -depth);
  at(1.4 + path.length() / speed, path.length(), 8);
  at(1.6 + path.length() / speed, path.length(), 8);
  return targets;
}

struct Trial {
  double cut = 0;
  int punctures = 0, left_early = 0;  ///< ticks in the middle of the cut in which the blade was not cutting
  CuttingFigures figures;
  Phase last = Phase::cutting;
};

std::optional<CutFields> fields_of(const std::shared_ptr<const Field>& field) {
  if (!field) return std::nullopt;
  return CutFields(field);
}

Trial cut(int rings, const std::shared_ptr<const Field>& field, double depth) {
  // Poles beside the path.
  testing::Surface ball = testing::ball(rings, radius);
  SurfaceMesh mesh{ball.points, ball.triangles};
  for (Vec3& p : mesh.points) p = {p.z, p.x, p.y};
  const ScalpelPath path = path_over_the_ball(depth);
  const double speed = 40;
  ScalpelCutting cutting(mesh, {path, {}, fields_of(field), 1, 0});
  Hand hand({}, script(path, depth, speed));
  HapticLoop loop(hand, cutting.surface(), {});
  Trial trial;
  const double end = 1 + path.length() / speed;
  for (int tick = 0; loop.state().time < hand.duration(); ++tick) {
    loop.update(1e-3);
    if (tick % 16 == 0) cutting.step(loop.for_cutting());
    const double t = loop.state().time;
    trial.left_early += t > 1 && t < end && loop.state().phase != Phase::cutting;
  }
  trial.cut = cutting.cut_length();
  trial.punctures = loop.state().punctures;
  trial.figures = cutting.figures();
  trial.last = loop.state().phase;
  EXPECT_EQ(trial.figures.stopped, "");
  EXPECT_LE(loop.statistics().excess_change, 0);
  EXPECT_LE(loop.passivity().created(), ForceParameters{}.energy_allowance);
  return trial;
}

TEST(Cutting, TheWholePathIsCutOnMeshesOfAllSizes) {
  for (const int rings : {20, 54, 158}) {
    const Trial trial = cut(rings, nullptr, 5);
    EXPECT_EQ(trial.punctures, 1) << rings;
    EXPECT_EQ(trial.left_early, 0) << rings;
    EXPECT_GT(trial.cut, 0.97 * path_over_the_ball(5).length()) << rings;
    EXPECT_EQ(trial.last, Phase::free) << rings;
  }
}

TEST(Cutting, TheWoundThatIsFeltIsTheOneThatIsSeen) {
  // What pictures are drawn from, histories over time, against the field evaluated as the scalpel goes.
  const auto field = std::make_shared<Field>(testing::opening_field({-20, 40, 5}, 80, 60, 10, 4));
  testing::Surface ball = testing::ball(30, radius);
  SurfaceMesh mesh{ball.points, ball.triangles};
  for (Vec3& p : mesh.points) p = {p.z, p.x, p.y};
  const ScalpelPath path = path_over_the_ball(5);
  ScalpelCutting cutting(mesh, {path, {}, fields_of(field), 1, 0});
  HapticState scalpel;
  scalpel.phase = Phase::cutting;
  for (double s = 0; s < 25; s += 0.7) {
    scalpel.pose.tip = path.at(s).position - 4 * path.at(s).outward;
    cutting.step(scalpel);
  }
  while (cutting.figures().waiting > 0) cutting.step(scalpel);
  const Incision& incision = *cutting.incision();
  ASSERT_GT(incision.tip(), 20);
  const Replay replay(Wound(incision, *field, 1));
  std::vector<Vec3> seen(replay.vertex_count());
  replay.positions(incision.tip(), seen);
  double moved = 0;
  for (std::size_t v = 0; v < seen.size(); ++v) {
    moved = std::max(moved, norm(seen[v] - replay.rest()[v]));
    // Motions of 2 micrometres are not told; histories are as exact as the field says.
    ASSERT_LT(norm(seen[v] - cutting.surface().position(static_cast<int>(v))),
              2.1e-3 + field->contraction_tolerance())
        << v;
  }
  EXPECT_GT(moved, 0.5);
}

TEST(Cutting, TheFieldOpensItBehindTheBlade) {
  const Trial trial =
      cut(54, std::make_shared<Field>(testing::opening_field({-20, 40, 5}, 80, 60, 10, 4)), 5);
  EXPECT_EQ(trial.punctures, 1);
  EXPECT_GT(trial.cut, 0.97 * path_over_the_ball(5).length());
  EXPECT_GT(trial.figures.open.count(), 50u);
  EXPECT_EQ(trial.last, Phase::free);
}

TEST(Cutting, TheHandCutsTheWholePathOfSoftAndStiffTissue) {
  testing::Surface ball = testing::ball(54, radius);
  SurfaceMesh mesh{ball.points, ball.triangles};
  for (Vec3& p : mesh.points) p = {p.z, p.x, p.y};
  const ScalpelPath path = path_over_the_ball(3);
  // Lips that gape, hardly part, and pass through each other by micrometres as those of a fit may.
  for (const double gape : {4., 1e-3, -4e-3})
    for (const double modulus : {0.004, 0.01, 1.}) {
      auto field = std::make_shared<Field>(testing::opening_field({-20, 40, 5}, 80, 60, 10, gape));
      field->parameters = recorded({{"tissue.young_modulus", modulus}, {"tissue.poisson_ratio", 0.45}});
      ForceParameters force;
      force.stiffness = surface_stiffness(*field);
      const HandParameters of_the_hand;
      ScalpelCutting cutting(mesh, {path, {}, fields_of(field), 1, 0});
      Hand hand(of_the_hand, hand_along(path, 1, 40, of_the_hand, force));
      HapticLoop loop(hand, cutting.surface(), force);
      double deepest = 0;
      for (int tick = 0; loop.state().time < hand.duration(); ++tick) {
        loop.update(1e-3);
        if (tick % 16 == 0) cutting.step(loop.for_cutting());
        deepest = std::max(deepest, loop.state().depth);
      }
      const std::string what = std::to_string(gape) + " mm, " + std::to_string(modulus) + " MPa";
      EXPECT_EQ(loop.state().punctures, 1) << what;
      EXPECT_GT(cutting.cut_length(), 0.97 * path.length()) << what;
      EXPECT_EQ(cutting.figures().stopped, "") << what;
      EXPECT_EQ(loop.state().phase, Phase::free) << what;
      // Once the skin gives way the hand stops: it is carried on by what its grip was wound up by.
      const double dent = force.puncture_force / std::min(force.stiffness, DeviceLimits{}.max_stiffness);
      EXPECT_LT(deepest, dent + force.puncture_force / of_the_hand.stiffness + 2) << what;
    }
}

Field taut_field() {
  return testing::in_tension(testing::opening_field({-15, 30, 3}, 50, 50, 6, 3),
                             {{"skin.prestress_v", 0.03}});
}

/// Displacements that are linear in the place are those of all vertices, also of those that a later cut adds.
TEST(ScalpelCutting, CutsThatAreMadeMoveAsTheirSimulationHasThem) {
  const SurfaceMesh mesh = testing::grid(40, 40, -30, -30, 1.5);
  const auto simulated = [](const Vec3& p) {
    return Vec3{0.02 * p.x + 0.01 * p.y, 0.5 - 0.03 * p.y, 0.01 * p.x};
  };
  const auto open = [&](const std::vector<const Incision*>& made) {
    EXPECT_EQ(made.size(), 1u);
    std::vector<Vec3> moved;
    for (const auto& vertex : made.front()->mesh().vertices()) moved.push_back(simulated(vertex.position));
    return moved;
  };
  for (const bool fields : {false, true}) {
    ScalpelCutting::Setup setup;
    setup.made = {testing::path_through({{-15, -4, 0}, {15, -4, 0}}, testing::up, 2)};
    if (fields) setup.fields = CutFields(std::make_shared<const Field>(taut_field()));
    setup.depth = 2, setup.opened = open;
    ScalpelCutting cutting(mesh, setup);
    const auto off = [&](int v) {
      const Vec3 rest = cutting.mesh().position(v);
      return norm(cutting.position(v) - rest - simulated(rest));
    };
    const int before = static_cast<int>(cutting.mesh().vertices().size());
    for (int v = 0; v < before; ++v) ASSERT_LT(off(v), 1e-9) << v;
    for (int k = 0; k <= 20; ++k) cutting.cut_at({{-9 + 0.9 * k, 6, 0}, {0, 0, 1}, 2});
    cutting.end_cut();
    cutting.settle();
    const int after = static_cast<int>(cutting.mesh().vertices().size());
    ASSERT_GT(after, before + 40);
    double farthest = 0;
    for (int v = 0; v < after; ++v) farthest = std::max(farthest, off(v));
    if (fields)
      EXPECT_GT(farthest, 0.3) << "the new cut opens in addition";
    else
      EXPECT_LT(farthest, 0.05) << "a third of what edges of 1.5 mm change by";
  }
}

TEST(ScalpelCutting, ASecondWoundOpensInTheTensionThatTheFirstLeaves) {
  const auto field = std::make_shared<const Field>(taut_field());
  const SurfaceMesh mesh = testing::grid(40, 40, -30, -30, 1.5);
  const auto at = [](double y) { return testing::path_through({{-15, y, 0}, {15, y, 0}}, testing::up, 2); };
  ScalpelCutting cutting(mesh, {at(4), {at(-4)}, CutFields(field), 1, 0});
  HapticState scalpel;
  scalpel.phase = Phase::cutting;
  scalpel.pose.cutting = true;
  for (int k = 0; k <= 100; ++k) {
    scalpel.pose.tip = {-15 + 0.3 * k, 4, -2};
    cutting.step(scalpel);
  }
  for (int k = 0; k < 5; ++k) cutting.step(scalpel);  // what waits to be told
  EXPECT_EQ(cutting.figures().waiting, 0u);

  CutMesh cut(mesh);
  std::vector<std::unique_ptr<Incision>> incisions;
  for (const double y : {-4, 4}) {
    incisions.push_back(std::make_unique<Incision>(cut, at(y), IncisionOptions{}));
    incisions.back()->advance_to(30);
  }
  const CutFields fields(field);
  const ReplayedWounds wounds({fields.wound(*incisions[0], 1), fields.wound(*incisions[1], 1)});
  std::vector<Vec3> moved(wounds.vertex_count());
  wounds.positions(wounds.duration(), moved);
  double apart = 0;
  for (std::size_t v = 0; v < moved.size(); ++v)
    apart = std::max(apart, norm(cutting.position(static_cast<int>(v)) - moved[v]));
  EXPECT_GT(std::abs(wounds.amplitude(0, 15, wounds.blade(wounds.duration())) - 1), 0.05);
  EXPECT_LT(apart, 5e-3);  // what is not felt, 0.002, once before the blade came and once after it
}

/// The wound needs a guard where the triangles at its path are slivers.
SurfaceMesh plate_with_slivers() { return testing::with_slivers(testing::grid(40, 30, -20, -15, 1)); }

/// The step that ends a cut begins the search for its guard on another thread; the next one takes it over.
/// Then the mesh is, to the last bit, that of the replay of these cuts and of the same motion once more.
TEST(ScalpelCutting, TheGuardIsTakenOverAfterTheStepThatEndsACut) {
  const auto field = std::make_shared<const Field>(taut_field());
  const SurfaceMesh mesh = plate_with_slivers();
  const ScalpelPath made = testing::path_through({{-10, -5.2, 0}, {10, -5.1, 0}}, testing::up, 2),
                    path = testing::path_through({{-12, 0.3, 0}, {12, 0.4, 0}}, testing::up, 2);
  std::vector<Vec3> first;
  for (int run = 0; run < 2; ++run) {
    ScalpelCutting cutting(mesh, {path, {made}, CutFields(field), 1, 0});
    HapticState scalpel;
    scalpel.phase = Phase::cutting;
    scalpel.pose.cutting = true;
    std::vector<Vec3> before;
    const auto positions = [&] {
      std::vector<Vec3> all;
      for (std::size_t v = 0; v < cutting.mesh().vertices().size(); ++v)
        all.push_back(cutting.position(static_cast<int>(v)));
      return all;
    };
    while (cutting.incision()->tip() < path.length()) {
      scalpel.pose.tip = path.at(std::min(path.length(), cutting.incision()->tip() + 0.5)).position;
      scalpel.pose.tip.z = -2;
      cutting.step(scalpel);
      ASSERT_EQ(cutting.figures().guards, 0);  // that ended the cut, too
      ASSERT_EQ(cutting.figures().stopped, "");
    }
    scalpel.pose.cutting = false;
    before = positions();
    cutting.step(scalpel);
    EXPECT_EQ(cutting.figures().guards, 1);
    cutting.settle();
    EXPECT_EQ(cutting.figures().guards, 1);
    EXPECT_NE(before, positions());  // the guard was needed
    if (run == 0) first = positions();
    EXPECT_EQ(first, positions());
  }
  CutMesh cut(mesh);
  std::vector<std::unique_ptr<Incision>> incisions;
  for (const ScalpelPath& one : {made, path}) {
    incisions.push_back(std::make_unique<Incision>(cut, one, IncisionOptions{}));
    incisions.back()->advance_to(one.length());
  }
  const CutFields fields(field);
  const ReplayedWounds wounds({fields.wound(*incisions[0], 1), fields.wound(*incisions[1], 1)});
  std::vector<Vec3> seen(wounds.vertex_count());
  wounds.positions(wounds.duration(), seen);
  ASSERT_EQ(first.size(), seen.size());
  for (std::size_t v = 0; v < seen.size(); ++v)
    ASSERT_LT(norm(first[v] - seen[v]), 4.1e-3) << v;  // motions of two micrometres are not told, twice
}

/// A cut that begins while a guard is found does not wait for it: it is found when that cut ends.
TEST(GuardFinder, GivesUpWhenItIsTold) {
  const Field field = taut_field();
  CutMesh mesh(plate_with_slivers());
  Incision cut(mesh, testing::path_through({{-12, 0.3, 0}, {12, 0.4, 0}}, testing::up, 2));
  LiveWounds wounds;
  wounds.add(Wound(cut, field, 1), 5000);
  cut.advance_to(24);
  wounds.follow();
  wounds.move_to_tips();
  ASSERT_TRUE(wounds.wants_guard());
  GuardFinder finder;
  for (int i = 0; i < 20; ++i) {
    finder.begin(wounds);
    EXPECT_TRUE(finder.busy());
    finder.give_up();
    EXPECT_FALSE(finder.busy());
  }
  finder.begin(wounds);
  const std::optional<Guard> guard = finder.take(true);
  ASSERT_TRUE(guard);
  EXPECT_FALSE(guard->empty());
  EXPECT_EQ(guard->vertices(), wounds.find_guard({}).vertices());
}

TEST(Cutting, TheMeshKeepsItsOwnColorsWhileItIsCut) {
  testing::Surface ball = testing::ball(30, radius);
  SurfaceMesh mesh{ball.points, ball.triangles};
  for (Vec3& p : mesh.points) p = {p.z, p.x, p.y};
  const auto color = [](const Vec3& p) {
    return PointColor{static_cast<float>(0.5 + 0.004 * p.x), static_cast<float>(0.5 + 0.004 * p.y), 0.5F};
  };
  for (const Vec3& p : mesh.points) mesh.colors.push_back(color(p));
  const ScalpelPath path = path_over_the_ball(5);
  ScalpelCutting cutting(mesh, {path, {}, std::nullopt, 1, 0});
  HapticState scalpel;
  scalpel.phase = Phase::cutting;
  std::shared_ptr<const CuttingMoment> moment = moment_of(cutting, nullptr);
  for (double s = 0; s < 25; s += 0.7) {
    scalpel.pose.tip = path.at(s).position - 4 * path.at(s).outward;
    cutting.step(scalpel);
    moment = moment_of(cutting, moment.get());
    const WoundSurface& surface = *moment->surface;
    ASSERT_EQ(surface.colors.size(), surface.points.size());
    for (std::size_t v = 0; v < surface.points.size(); ++v) {
      if (surface.depth_fraction[v] > 0) continue;
      const PointColor expected = color(surface.points[v]);
      for (std::size_t k = 0; k < 2; ++k) ASSERT_NEAR(surface.colors[v][k], expected[k], 1e-4) << s;
    }
  }
  EXPECT_GT(moment->surface->points.size(), mesh.points.size() + 100);
}

}  // namespace
}  // namespace cleft
