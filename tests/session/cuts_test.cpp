// Cuts in a mesh by commands, and what opens them.
#include <map>

#include "base/text.h"
#include "explorer/session/actions.h"
#include "tests/session/session_fixture.h"

namespace cleft {
namespace {

TEST_F(SessionTest, CutsAreMadeUndoneAndMadeAgainBitForBit) {
  open();
  say("mesh plate.stl");
  const std::vector<Vec3> whole = points();
  say("cut -15,0.7,0,0,0,1 15,0.7,0,0,0,1");
  const std::vector<Vec3> once = points();
  EXPECT_EQ(state().time, session_.duration());
  EXPECT_NEAR(session_.duration(), 30, 1e-9);
  EXPECT_GT(widest(once,
                   [&] {
                     auto r = once;
                     session_.scene()->positions(0, r);
                     return r;
                   }()),
            0.5);
  say("cut -10,12,0,0,0,1 10,12,0,0,0,1 depth 2");
  EXPECT_NEAR(session_.duration(), 50, 1e-9) << "one after another";
  const std::vector<Vec3> twice = points();
  say("undo");
  EXPECT_EQ(points(), once);
  say("undo");
  EXPECT_EQ(points(), whole);
  EXPECT_NE(refused("undo").find("no cut"), std::string::npos);
  say("redo");
  EXPECT_EQ(points(), once);
  say("redo");
  EXPECT_EQ(points(), twice);
  EXPECT_NE(refused("redo"), "");
}

TEST_F(SessionTest, TheSecondCutStaysClosedUntilTheFirstIsMade) {
  cut_plate();
  say("cut -10,12,0,0,0,1 10,12,0,0,0,1");
  std::vector<Vec3> rest, first, both;
  session_.scene()->positions(0, rest);
  session_.scene()->positions(30, first);
  session_.scene()->positions(50, both);
  EXPECT_GT(widest(first, rest), 0.5);
  bool more = false;
  for (std::size_t i = 0; i < rest.size(); ++i)
    if (std::abs(rest[i].y - 12) < 1e-9 && std::abs(rest[i].x) < 9)
      more = more || norm(both[i] - first[i]) > 0.3;
  EXPECT_TRUE(more);
  // Half of the second cut's 20 mm: it ends at x = 0, and beyond its lips lie on each other.
  std::vector<Vec3> half;
  session_.scene()->positions(40, half);
  double behind = 0, ahead = 0;
  std::map<std::pair<double, double>, std::size_t> lips;
  for (std::size_t i = 0; i < rest.size(); ++i) {
    if (std::abs(rest[i].y - 12) > 1e-9 || rest[i].z != 0) continue;
    const auto [other, fresh] = lips.try_emplace({rest[i].x, rest[i].y}, i);
    if (!fresh) {
      double& widest_gap = rest[i].x < 0 ? behind : ahead;
      widest_gap = std::max(widest_gap, norm(half[i] - half[other->second]));
    }
  }
  EXPECT_GT(behind, 0.5);
  EXPECT_EQ(ahead, 0);
}

/// Across a cut along the line y = `y`, where lips that lean move besides: the largest way between two
/// vertices that are at one place while all is closed.
double opening_of(const std::vector<Vec3>& closed, const std::vector<Vec3>& open, double y) {
  std::vector<std::size_t> lips;
  for (std::size_t i = 0; i < closed.size(); ++i)
    if (std::abs(closed[i].y - y) < 1e-9) lips.push_back(i);
  double largest = 0;
  for (const std::size_t i : lips)
    for (const std::size_t j : lips)
      if (norm(closed[i] - closed[j]) < 1e-9) largest = std::max(largest, std::abs(open[i].y - open[j].y));
  return largest;
}

TEST_F(SessionTest, CutsSideBySideRelieveEachOther) {
  cut_plate();
  const std::vector<Vec3> alone = points();
  std::vector<Vec3> rest;
  session_.scene()->positions(0, rest);
  const double gape = opening_of(rest, alone, 0.7);
  say("cut -15,8.7,0,0,0,1 0,8.7,0,0,0,1 15,8.7,0,0,0,1");
  std::vector<Vec3> both = points(), closed;
  session_.scene()->positions(0, closed);
  for (const double y : {0.7, 8.7}) {
    EXPECT_GT(opening_of(closed, both, y), 0.1 * gape) << y;
    EXPECT_LT(opening_of(closed, both, y), 0.98 * gape) << y;
  }
  say("undo");
  EXPECT_EQ(points(), alone);
}

TEST_F(SessionTest, CutsTurnAgainstATension) {
  const TemporaryFolder folder;
  write_study_of_prestresses(folder / "study");
  EXPECT_NE(refused("tension 0,1,0 0.03,0.01").find("open"), std::string::npos);
  say("open " + (folder / "study"));
  say("set skin.prestress_v 0.03");
  EXPECT_NE(refused("tension 0,1,0 0.03,0.01").find("mesh FILE"), std::string::npos);
  say("mesh plate.stl");
  say("cut -15,0.7,0,0,0,1 0,0.7,0,0,0,1 15,0.7,0,0,0,1");
  const std::vector<Vec3> as_simulated = points();
  // Across the cut, as in the case that is shown: the sum of the three is that case.
  say("tension 0,1,0 0.01,0.03");
  const std::vector<Vec3> across = points();
  for (std::size_t i = 0; i < across.size(); ++i) ASSERT_LT(norm(across[i] - as_simulated[i]), 1e-6) << i;
  say("tension 1,1,0 0.03,0.01");
  EXPECT_GT(widest(points(), across), 0.1);
  const SessionState saved = state_from_json(state_to_json(state()));
  ASSERT_TRUE(saved.tension);
  EXPECT_EQ(saved.tension->direction, (Vec3{1, 1, 0}));
  EXPECT_NE(refused("tension 0,0,1 0.03,0.01").find("upright"), std::string::npos);
  EXPECT_EQ(state().tension->direction, (Vec3{1, 1, 0})) << "as it was";
  EXPECT_NE(refused("tension 0,1,0 0.03,-0.01").find("below 0"), std::string::npos);
  const std::vector<Vec3> turned = points();
  say("cut -10,12,0,0,0,1 10,12,0,0,0,1 depth 2");
  say("tension none");
  // Back in the order in which cuts and tensions were made, and on again, from a saved session too.
  say("undo");
  EXPECT_TRUE(state().tension);
  say("undo");
  EXPECT_EQ(points(), turned);
  say("undo");
  EXPECT_EQ(points(), across);
  restore(session_, state_from_json(state_to_json(state())));
  say("undo");
  EXPECT_EQ(points(), as_simulated);
  EXPECT_FALSE(state().tension);
  for (int i = 0; i < 2; ++i) say("redo");
  EXPECT_EQ(points(), turned);
  for (int i = 0; i < 2; ++i) say("redo");
  EXPECT_FALSE(state().tension);
  EXPECT_EQ(state().cuts.size(), 2u);
  EXPECT_NE(refused("redo").find("no undone cut or tension"), std::string::npos);
}

TEST_F(SessionTest, WhereOpeningsMayBeOffIsSaid) {
  cut_plate();
  EXPECT_EQ(answers_.find("warning"), std::string::npos) << answers_;
  EXPECT_TRUE(session_.warnings().empty());
  // An arc of 20 mm radius where the tension does not turn.
  std::string arc = "recut";
  for (int i = -8; i <= 8; ++i) {
    const double a = 0.05 * i;
    arc += " " + std::to_string(20 * std::sin(a)) + "," + std::to_string(20 * (1 - std::cos(a)) + 0.7) +
           ",0,0,0,1";
  }
  say(arc);
  ASSERT_EQ(session_.warnings().size(), 1u);
  EXPECT_NE(answers_.find("warning: its opening may be off by"), std::string::npos) << answers_;
  answers_.clear();
  say("set tissue.young_modulus 0.04");
  EXPECT_EQ(answers_, "") << "said already";
  say("info");
  EXPECT_NE(answers_.find("warning: its opening may be off by"), std::string::npos);
  say("undo");
  EXPECT_TRUE(session_.warnings().empty());
}

TEST_F(SessionTest, OpeningsHaveTheirExpectedErrorBesideThem) {
  EXPECT_EQ(session_.validity().size(), 0u);
  cut_plate();
  ASSERT_EQ(session_.validity().size(), 1u);
  const std::string note = "expected error of the opening ";
  EXPECT_NE(session_.note_of(0).find(note), std::string::npos) << session_.note_of(0);
  say("cut -15,3,0,0,0,1 0,3,0,0,0,1 15,3,0,0,0,1");
  ASSERT_EQ(session_.validity().size(), 2u);
  const double largest = session_.validity()[0].expected_error.largest;
  EXPECT_GT(largest, 0.07) << "they are 2 mm apart";
  EXPECT_NE(session_.note_of(0).find(note + shortest(std::round(100 * largest))), std::string::npos)
      << session_.note_of(0);
  // The lips of the first cut part as the field says in its middle; the second one is made after it.
  const auto openings = session_.scene()->openings(30);
  ASSERT_EQ(openings.size(), 2u);
  const auto& places = openings[0].places;
  const auto middle =
      std::min_element(places.begin(), places.end(),
                       [](double a, double b) { return std::abs(a - 15) < std::abs(b - 15); }) -
      places.begin();
  const Field& field = *session_.field();
  const Vec3 uvw{places[static_cast<std::size_t>(middle)] - 15, 0, 0};
  const double gape =
      norm(field.displacement(uvw, Side::right, 30) - field.displacement(uvw, Side::left, 30));
  EXPECT_GT(gape, 1);
  EXPECT_NEAR(openings[0].values[static_cast<std::size_t>(middle)], gape, 0.02 * gape);
  for (const double value : openings[1].values) EXPECT_LT(value, 1e-6);
}

TEST_F(SessionTest, BoneBelowAMeshCounts) {
  EXPECT_NE(refused("bone bone_plate.stl").find("there is no mesh"), std::string::npos);
  cut_plate();
  const double without = session_.validity()[0].expected_error.largest;
  say("bone bone_plate.stl");
  const OpeningError over = session_.validity()[0].expected_error;
  EXPECT_GT(over.largest, without + 0.05) << "a field of one case does not know it";
  EXPECT_EQ(over.cause, "there is bone 6 mm below, which the field does not know");
  const std::vector<Vec3> before = points();
  restore(session_, state_from_json(state_to_json(state())));
  EXPECT_EQ(points(), before);
  say("recut -15,0.7,0,0,0,1 0,0.7,0,0,0,1 15,0.7,0,0,0,1");
  EXPECT_EQ(session_.validity()[0].expected_error.largest, over.largest);
  EXPECT_NE(refused("bone skull.stl").find("skull.stl"), std::string::npos);
  EXPECT_TRUE(state().bone.ends_with("bone_plate.stl"));
  say("bone none");
  EXPECT_EQ(session_.validity()[0].expected_error.largest, without);
}

TEST_F(SessionTest, ATensionNeedsThreeCasesOfOtherPrestress) {
  cut_plate();
  const std::vector<Vec3> before = points();
  EXPECT_NE(refused("tension 0,1,0 0.03,0.01").find("three cases"), std::string::npos);
  EXPECT_EQ(points(), before);
}

TEST_F(SessionTest, TheWoundFollowsTheCase) {
  cut_plate();
  const std::vector<Vec3> narrow = points();
  say("set skin.prestress_v 0.05");
  EXPECT_EQ(state().cuts.size(), 1u);
  ASSERT_EQ(points().size(), narrow.size());
  std::vector<Vec3> rest;
  session_.scene()->positions(0, rest);
  EXPECT_GT(widest(points(), rest), 1.5 * widest(narrow, rest)) << "gape 5 against 2 mm";
}

TEST_F(SessionTest, AMeshIsDrawnInItsOwnColorsUntilAnotherColoringIsChosen) {
  open();
  say("mesh plate.stl");
  EXPECT_EQ(state().coloring, Coloring::tissue);
  EXPECT_NE(refused("color own").find("no colours of its own"), std::string::npos);
  say("mesh painted_plate.stl");
  EXPECT_EQ(state().coloring, Coloring::own);
  say("cut -15,0.7,0,0,0,1 15,0.7,0,0,0,1");
  EXPECT_EQ(state().coloring, Coloring::own);
  EXPECT_EQ(state_from_json(state_to_json(state())).coloring, Coloring::own);
  const auto expect_own = [](const std::vector<PointColor>& colors, const std::vector<Vec3>& rest,
                             const std::vector<double>& depth) {
    ASSERT_EQ(colors.size(), rest.size());
    for (std::size_t v = 0; v < rest.size(); ++v)
      if (depth[v] == 0) EXPECT_NEAR(colors[v][0], 0.5 + 0.01 * rest[v].x, 1e-6);
  };
  const WoundSurface surface = session_.scene()->surface();
  expect_own(surface.colors, surface.points, surface.depth_fraction);
  say("export out.ply");
  expect_own(exported_.colors, surface.points, surface.depth_fraction);
  bool tissue = false;
  for (std::size_t v = 0; v < exported_.colors.size(); ++v)
    tissue = tissue || (surface.depth_fraction[v] == 1 && exported_.colors[v][0] < 0.35F);
  EXPECT_TRUE(tissue) << "at the bottom of the cut";
  say("color displacement");
  say("undo");
  EXPECT_EQ(state().coloring, Coloring::displacement) << "what was chosen stays";
  say("color own");
  EXPECT_EQ(session_.scene()->surface().colors.size(), session_.scene()->surface().points.size());
  say("patch");
  EXPECT_EQ(state().coloring, Coloring::displacement);
  EXPECT_NE(refused("color own").find("mesh FILE"), std::string::npos);
}

}  // namespace
}  // namespace cleft
