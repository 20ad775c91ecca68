// Replayed cuts against the solver's own simulations of them, within what is promised: a tenth of the
// opening.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "explorer/body/simulate.h"
#include "explorer/body/simulated_wounds.h"
#include "explorer/wound/cut_fields.h"
#include "explorer/wound/replayed_wounds.h"
#include "tests/incision/meshes.h"
#include "tests/incision/self_intersections.h"
#include "tests/truth/body_subjects.h"
#include "tests/truth/truth_cases.h"
#include "tradeoff/replays/replay_error.h"

namespace cleft {

namespace {

constexpr double promised = 0.1;  // of the largest opening

constexpr const char* coarse = R"(
patch.length = 46
patch.width = 30
patch.height = 6
mesh.element_size = 1.5
)";
/// Pulled alike in all directions: a curved cut is then pulled as the canonical one.
constexpr const char* alike = R"(
skin.prestress_u = 0.02
skin.prestress_v = 0.02
)";

class Truth : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    cases = new TruthCases(std::string(coarse) + alike);
    field = new Field(cases->canonical());
  }
  static void TearDownTestSuite() {
    delete field;
    delete cases;
  }
  static ReplayError error(const std::string& lines) {
    const SnapshotReader truth = cases->truth(lines);
    const ReplayError e = replay_error(truth, *field);
    EXPECT_GT(e.gape, 1) << "the cut must open for this to mean anything";
    return e;
  }
  static TruthCases* cases;
  static Field* field;
};
TruthCases* Truth::cases = nullptr;
Field* Truth::field = nullptr;

/// An arc over the middle of a flat mesh, and the mesh about it.
ScalpelPath arc(double radius, double length) {
  std::vector<ScalpelPath::Point> points;
  for (int i = -30; i <= 30; ++i) {
    const double a = length / 2 * i / 30 / radius;
    points.push_back({{radius * std::sin(a), radius * (1 - std::cos(a)), 0}, {0, 0, 1}, 3});
  }
  return ScalpelPath(points);
}
SurfaceMesh flat() { return testing::grid(60, 50, -30 + 0.013, -25 + 0.017, 1); }

}  // namespace

TEST_F(Truth, DisplacementsDoNotJumpInTime) {
  for (const double length : {30., 44.}) {
    Incision cut(flat(), arc(40, length));
    cut.advance_to(length);
    const Replay replay(Wound(cut, *field, 1));
    std::vector<Vec3> now(replay.vertex_count()), before(now.size());
    const auto largest_jump = [&](int frames) {
      double largest = 0;
      replay.positions(0, before);
      for (int j = 1; j <= frames; ++j) {
        replay.positions(length * j / frames, now);
        for (std::size_t v = 0; v < now.size(); ++v) largest = std::max(largest, norm(now[v] - before[v]));
        std::swap(now, before);
      }
      return largest;
    };
    // The lips part behind the tip as the square root of the way: half for a quarter.
    // (Where the cut begins, whatever its scale: frames far shorter than that.)
    EXPECT_LT(largest_jump(6400), 0.6 * largest_jump(400)) << length;
  }
}

TEST_F(Truth, TheWoundDoesNotPassThroughItself) {
  // Below 15 mm, three to four gapes, the lips inside the bend do; and so do the walls at the start of a cut
  // of a third of the length, by 2 % of the gape, as the field itself does.
  for (const double radius : {1000., 30., 20.}) {
    const double length = 30;
    Incision cut(flat(), arc(radius, length));
    cut.advance_to(length);
    const Replay replay(Wound(cut, *field, 1));
    SurfaceMesh surface = cut.mesh().surface();
    for (const double part : {0.7, 1.}) {
      replay.positions(part * length, surface.points);
      EXPECT_EQ(testing::self_intersections(surface), 0) << "radius " << radius << " at " << part;
    }
  }
}

TEST_F(Truth, TheCanonicalCutIsItself) {
  const ReplayError e = error("");
  // On either lip; replaying contracts the field to histories, which may add a tenth.
  EXPECT_LT(e.gape_error, 2 * 1.1 * field->report.spline_error * field->report.largest_displacement);
}

TEST_F(Truth, ACurvedCutOpensAsMuch) {
  const ReplayError e = error("cut.radius = 40");
  EXPECT_LT(e.gape_error, promised * e.gape);
}

TEST_F(Truth, ATiltedBladesLipsRiseAndSink) {
  for (const char* tilt : {"-30", "15", "30"}) {
    const ReplayError e = error(std::string("cut.tilt = ") + tilt);
    EXPECT_LT(e.gape_error, promised * e.gape) << tilt << ": 0.18 and more in the blade's own frame";
  }
}

TEST_F(Truth, AShorterCutIsAnEarlierTime) {
  const ReplayError e = error("cut.length = 15");
  EXPECT_LT(e.gape_error, promised * e.gape);
}

/// In skin that is pulled 1 : 3.
class TruthInTension : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    cases = new TruthCases(coarse);
    fields = new PrestressFields(cases->prestresses());
  }
  static void TearDownTestSuite() {
    delete fields;
    delete cases;
  }
  static TruthCases* cases;
  static PrestressFields* fields;
};
TruthCases* TruthInTension::cases = nullptr;
PrestressFields* TruthInTension::fields = nullptr;

TEST_F(TruthInTension, TurnsAgainstACurvedCut) {
  const SnapshotReader truth = cases->truth("cut.radius = 30");
  const ReplayError e = replay_error(truth, *fields);
  EXPECT_GT(e.gape, 1);
  EXPECT_LT(e.gape_error, promised * e.gape) << "0.24 where the tension does not turn";
}

TEST_F(TruthInTension, APathThatWindsOpensAsTheMembraneSays) {
  setenv("CLEFT_BIN", CLEFT_BIN, 1);
  // An S of two arcs of 15 mm, 45 mm long, as its body is simulated.
  const auto subjects = testing::body_subjects(25);
  const auto s_shape = std::ranges::find(subjects, "S of 15, 45 mm long", &testing::NamedSubject::name);
  ASSERT_NE(s_shape, subjects.end());
  const testing::Subject subject = s_shape->make();
  BodyRequest request;
  request.skin = subject.skin, request.paths = subject.paths, request.reach = 20;
  request.parameters.patch.height = 6, request.parameters.mesh.element_size = 1.5;
  const BodySimulation simulation = simulate(request);
  CutMesh mesh(request.skin);
  Incision cut(mesh, request.paths[0], {});
  cut.advance_to(cut.path().length());
  const SkinTension tension = default_tension(request.paths[0], false);  // that of the simulation
  const ReplayedWounds wounds({wound_in_tension(cut, *fields, tension, 1)});
  const SimulatedWounds truth({&cut}, 1, simulation.body, *simulation.series);
  std::vector<Vec3> replayed(wounds.vertex_count()), simulated(wounds.vertex_count());
  wounds.positions(wounds.duration(), replayed);
  truth.bare_positions(truth.duration(), simulated);
  const ReplayOff off = replay_off({&cut}, replayed, simulated, 0);
  EXPECT_GT(off.gape, 1);
  EXPECT_LT(off.opening, 2 * promised * off.gape)
      << off.relative_opening() << "; 0.35 with the tension at each place alone";
}

TEST_F(TruthInTension, ABranchOpensAwayFromTheCutItLeaves) {
  // Beside the first cut the skin is pressed together along it: there the branch's lips bear on each other.
  // In a patch so wide that its sides are far from the branch too.
  const TruthCases wide(
      std::string(coarse).replace(std::string(coarse).find("width = 30"), 10, "width = 60"));
  const SnapshotReader truth = wide.truth("cut.contact = true\ncut.branch = 11");
  const ReplayError e = branch_error(truth, wide.prestresses());
  EXPECT_GT(e.gape, 1);
  EXPECT_LT(e.gape_error, promised * e.gape) << e.gape_error / e.gape;
}

TEST(TruthOfTwoCuts, RelieveEachOther) {
  // So wide that both cuts are as far from its sides as the canonical one.
  const TruthCases cases(
      std::string(coarse).replace(std::string(coarse).find("width = 30"), 10, "width = 60") +
      "mesh.grading = 1.2\ncut.length = 20");
  const Field field = cases.canonical();
  for (const char* spacing : {"10", "12", "16"}) {
    const SnapshotReader truth = cases.truth("cut.count = 2\ncut.spacing = " + std::string(spacing));
    const ReplayError e = parallel_error(truth, field);
    EXPECT_GT(e.gape, 1);
    EXPECT_LT(e.gape_error, promised * e.gape)
        << spacing << " mm apart: 0.18 to 0.29 where they do not, 0.1 to 0.15 where lips do not lean";
  }
}

}  // namespace cleft
