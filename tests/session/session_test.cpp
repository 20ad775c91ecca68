// What commands do to a session.
#include <map>

#include "base/text.h"
#include "explorer/session/actions.h"
#include "tests/session/session_fixture.h"
#include "tests/support/recorded.h"

namespace cleft {
namespace {

double widest(const std::vector<Vec3>& points, const std::vector<Vec3>& rest) {
  double largest = 0;
  for (std::size_t i = 0; i < points.size(); ++i) largest = std::max(largest, norm(points[i] - rest[i]));
  return largest;
}

TEST_F(SessionTest, OpensAStudyAtItsEnd) {
  open();
  EXPECT_EQ(session_.study()->size(), 4);
  EXPECT_EQ(state().shown, 0);
  EXPECT_EQ(state().time, 30);
  EXPECT_EQ(state().parameters.at("tissue.young_modulus"), 0.01);
  EXPECT_EQ(state().parameters.count("cut.depth"), 0u) << "it is the same in all cases";
}

TEST_F(SessionTest, AParameterChoosesTheNearestCaseAndKeepsTheOthers) {
  open();
  say("set skin.prestress_v 0.05");
  EXPECT_EQ(session_.study()->parameters(state().shown).number("skin.prestress_v"), 0.05);
  EXPECT_EQ(session_.study()->parameters(state().shown).number("tissue.young_modulus"), 0.01);
  EXPECT_TRUE(session_.shows_exactly());
  say("set tissue.young_modulus 0.03");
  EXPECT_EQ(session_.study()->parameters(state().shown).number("skin.prestress_v"), 0.05);
  EXPECT_EQ(session_.study()->parameters(state().shown).number("tissue.young_modulus"), 0.04);
  EXPECT_FALSE(session_.shows_exactly());
  say("case 2");
  EXPECT_TRUE(session_.shows_exactly());
}

TEST_F(SessionTest, OrderSelectionAndWallAreCommandsThatAreSaved) {
  open();
  say("sort gape down");
  say("select 4 2 4");
  say("wall on");
  const SessionState saved = state_from_json(state_to_json(state()));
  EXPECT_EQ(saved.sorted_by, "gape");
  EXPECT_TRUE(saved.descending);
  EXPECT_EQ(saved.selected, (std::vector{1, 3})) << "each once, in order";
  EXPECT_TRUE(saved.wall);
  EXPECT_NE(refused("sort gap").find("'gape'"), std::string::npos) << "the nearest name";
  EXPECT_NE(refused("sort gape left"), "");
  EXPECT_NE(refused("select 2 5"), "");
  EXPECT_NE(refused("select"), "");
  EXPECT_EQ(state().selected, (std::vector{1, 3})) << "a refused line changes nothing";
  say("select none");
  EXPECT_TRUE(state().selected.empty());
  say("sort none");
  EXPECT_EQ(state().sorted_by, "");
}

TEST_F(SessionTest, HowTheSurfaceIsDrawnIsACommandThatIsSaved) {
  open();
  say("warp 2.5");
  say("map viridis");
  say("edges on");
  say("range 2% 98%");
  say("clip cut 1 10");
  const SessionState saved = state_from_json(state_to_json(state()));
  EXPECT_EQ(saved.warp, 2.5);
  EXPECT_EQ(saved.map, "viridis");
  EXPECT_TRUE(saved.edges);
  EXPECT_EQ(saved.percentiles, (std::pair{2., 98.}));
  ASSERT_TRUE(saved.clip);
  EXPECT_EQ(saved.clip->place.x, -5) << "the cut begins at u = -15";
  EXPECT_EQ(saved.clip->ahead.x, 1);
  EXPECT_NE(session_.note_of(0).find("displacements drawn 2.5 times as large"), std::string::npos);
  EXPECT_NE(refused("map viridi").find("'viridis'"), std::string::npos);
  EXPECT_NE(refused("range 2% 98"), "");
  EXPECT_NE(refused("range -1% 50%"), "");
  EXPECT_NE(refused("range 60% 50%"), "");
  EXPECT_NE(refused("warp -1"), "");
  EXPECT_NE(refused("clip cut 2 10"), "") << "the patch has one cut";
  EXPECT_NE(refused("clip cut 1 31"), "");
  EXPECT_NE(refused("clip 0,0,0 0,0,0"), "");
  say("range 0 3");
  EXPECT_FALSE(state().percentiles) << "one or the other";
  say("range 2% 98%");
  EXPECT_FALSE(state().range);
  say("map auto");
  EXPECT_EQ(state().map, "");
  say("mesh plate.stl");
  EXPECT_FALSE(state().clip) << "its places were those of the patch";
  say("cut -15,0.7,0,0,0,1 0,0.7,0,0,0,1 15,0.7,0,0,0,1");
  say("clip cut 1 20");
  EXPECT_NEAR(state().clip->place.x, 5, 1e-6);
  EXPECT_NE(refused("color widening"), "") << "from which case?";
  say("difference 2");
  say("color widening");
}

TEST_F(SessionTest, TimeIsClampedPlayedAndLooped) {
  open();
  say("time 1000");
  EXPECT_EQ(state().time, 30);
  say("step -4");
  EXPECT_EQ(state().time, 26);
  say("speed 10");
  say("wait 1");
  EXPECT_EQ(state().time, 26) << "nothing plays";
  say("play");
  say("wait 0.3");
  EXPECT_NEAR(state().time, 29, 1e-12);
  say("wait 0.3");
  EXPECT_EQ(state().time, 30);
  EXPECT_FALSE(state().playing) << "the end";
  say("loop on");
  say("play");
  EXPECT_EQ(state().time, 0) << "from the start again";
  say("wait 3.5");
  EXPECT_NEAR(state().time, 5, 1e-12);
  EXPECT_TRUE(state().playing);
}

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
      more = more || norm(both[i] - first[i]) > 0.5;
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

TEST_F(SessionTest, CutsSideBySideRelieveEachOther) {
  cut_plate();
  const std::vector<Vec3> alone = points();
  std::vector<Vec3> rest;
  session_.scene()->positions(0, rest);
  const double gape = widest(alone, rest);
  say("cut -15,8.7,0,0,0,1 0,8.7,0,0,0,1 15,8.7,0,0,0,1");
  // Twice as much of the force across the cuts is relieved as by one: neither opens as far as alone.
  std::vector<Vec3> both = points(), closed;
  session_.scene()->positions(0, closed);
  double first = 0, second = 0;
  for (std::size_t i = 0; i < both.size(); ++i) {
    double& lip = std::abs(closed[i].y - 0.7) < 1e-9 ? first : second;
    if (std::abs(closed[i].y - 0.7) < 1e-9 || std::abs(closed[i].y - 8.7) < 1e-9)
      lip = std::max(lip, norm(both[i] - closed[i]));
  }
  EXPECT_GT(std::min(first, second), 0.1 * gape);
  EXPECT_LT(std::max(first, second), 0.98 * gape);
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
  say("cut -15,8,0,0,0,1 0,8,0,0,0,1 15,8,0,0,0,1");
  ASSERT_EQ(session_.validity().size(), 2u);
  const double largest = session_.validity()[0].expected_error.largest;
  EXPECT_GT(largest, 0.1) << "they are 7 mm apart";
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

TEST_F(SessionTest, WhatCannotBeDoneLeavesTheSessionAsItWas) {
  cut_plate();
  say("time 12");
  const std::string before = state_to_json(state());
  const std::vector<Vec3> where = points();
  for (const char* line : {"open /nonexistent",
                           "case 5",
                           "case 1.5",
                           "case 0",
                           "set tissue.young_modulus soft",
                           "set cut.depth 3",
                           "set tissue.young_modulos 0.02",
                           "time",
                           "time -1",
                           "time nan",
                           "color gap",
                           "mesh other.stl",
                           "cut 1,2,3,0,0,1",
                           "cut 0,0,500,0,0,1 1,0,500,0,0,1",
                           "compare 1",
                           "compare 1 9",
                           "range 3 1",
                           "range a",
                           "camera 0",
                           "look 0,0,0 0,0,0 0,1,0",
                           "theme grey",
                           "screenshot a.png 3 3",
                           "load /nonexistent.json",
                           "difference 7",
                           "color difference",
                           "undo 3",
                           "case 2 3",
                           "export",
                           "paly"}) {
    EXPECT_NE(refused(line), "") << line;
    EXPECT_EQ(state_to_json(state()), before) << line;
  }
  EXPECT_EQ(points(), where);
}

TEST_F(SessionTest, ErrorsNameTheRemedy) {
  EXPECT_NE(refused("case 1").find("open DIR"), std::string::npos);
  EXPECT_NE(refused("screenshot a.png").find("open DIR"), std::string::npos);
  open();
  EXPECT_NE(refused("set cut.depth 3").find("the same in all cases of this study (6 mm)"), std::string::npos);
  EXPECT_NE(refused("set cut.depth 3").find("skin.prestress_v"), std::string::npos);
  EXPECT_NE(refused("set tissue.young_modulos 1").find("tissue.young_modulus"), std::string::npos);
  EXPECT_NE(refused("color gap").find("gape"), std::string::npos);
  EXPECT_NE(refused("cut 0,0,0,0,0,1 1,0,0,0,0,1").find("mesh FILE"), std::string::npos);
}

TEST_F(SessionTest, TheStateComesBackFromItsFile) {
  cut_plate();
  say("cut -10,12,0,0,0,1 10,12,0,0,0,1 depth 2");
  say("undo");
  say("set skin.prestress_v 0.05");
  say("time 17.25");
  say("color strain");
  say("range 0 0.5");
  say("look 0,0,100 0,0,0 0,1,0 30");
  say("theme dark");
  say("compare 1 3 4");
  say("loop on");
  const std::string before = state_to_json(state());
  const std::vector<Vec3> where = points();
  say("save " + folder_ / "a.json");
  say("close");
  EXPECT_FALSE(session_.has_scene());
  say("load " + folder_ / "a.json");
  EXPECT_EQ(state_to_json(state()), before);
  EXPECT_EQ(points(), where);
  say("redo");
  EXPECT_EQ(state().cuts.size(), 2u);
}

TEST_F(SessionTest, ADamagedStateIsRefused) {
  open();
  say("save " + folder_ / "a.json");
  const std::string whole = read_text_file(folder_ / "a.json");
  for (std::size_t length = 0; length + 2 < whole.size(); length += 11) {
    write_text_file(folder_ / "b.json", whole.substr(0, length));
    EXPECT_NE(refused("load " + folder_ / "b.json").find("b.json"), std::string::npos) << length;
  }
  write_text_file(folder_ / "b.json", "{\"format\": \"other\"}");
  EXPECT_NE(refused("load " + folder_ / "b.json").find("no saved session"), std::string::npos);
}

TEST_F(SessionTest, ARecordingLeadsToTheSameState) {
  cut_plate();
  say("time 12");
  say("camera 20 10 2");
  say("info");
  refused("case 99");
  say("record " + folder_ / "a.txt");
  const std::string before = state_to_json(state());
  const std::string text = read_text_file(folder_ / "a.txt");
  EXPECT_EQ(text.find("info"), std::string::npos);
  EXPECT_EQ(text.find("99"), std::string::npos);
  say("close");
  session_.run_script(folder_ / "a.txt");
  EXPECT_EQ(state_to_json(state()), before);
}

TEST_F(SessionTest, SeveralTimesInARowAreRecordedAsTheLast) {
  open();
  say("time 3");
  say("time 4");
  say("theme dark");
  say("time 5");
  EXPECT_EQ(session_.said(), (std::vector<std::string>{"open " + study(), "time 4", "theme dark", "time 5"}));
}

TEST_F(SessionTest, ScriptErrorsNameFileAndLine) {
  const std::string script = folder_.write("s.txt", "# a comment\nopen '" + study() + "'\n\nclor gape\n");
  try {
    session_.run_script(script);
    ADD_FAILURE();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("s.txt:4: 'clor' is no command (did you mean 'color'?)"),
              std::string::npos)
        << e.what();
  }
}

TEST_F(SessionTest, ComparedCasesAreLinkedByTheValueOfTime) {
  open();
  say("time 7");
  say("compare 1 4");
  EXPECT_EQ(session_.views(), (std::vector{0, 3}));
  EXPECT_EQ(state().time, 7);
  say("single");
  EXPECT_EQ(session_.views(), std::vector{0});
}

TEST_F(SessionTest, TheDifferenceOfACaseFromItselfIsNothing) {
  open();
  say("difference 1");
  std::vector<double> values;
  session_.scene()->values(state().coloring, session_.reference().get(), 20, values);
  for (const double v : values) EXPECT_EQ(v, 0);
  say("difference 4");
  session_.scene()->values(state().coloring, session_.reference().get(), 30, values);
  // Case 1 was made with a gape of 2.1 mm and case 4 with 5.4, half of it on either side.
  EXPECT_NEAR(*std::max_element(values.begin(), values.end()), (5.4 - 2.1) / 2, 0.1 * (5.4 - 2.1) / 2);
}

TEST_F(SessionTest, PicturesAndExportsAreAskedOfTheServices) {
  cut_plate();
  say("screenshot 'my picture.png' 640");
  EXPECT_EQ(written_, "my picture.png 640x360");
  EXPECT_EQ(picture_state_, state_to_json(state()));
  say("time 0");
  say("export a.vtp");
  EXPECT_EQ(exported_.points, points());
  say("mesh plate.stl 10");
  say("export a.vtp");
  EXPECT_EQ(exported_.points, flat_plate().points) << "in the mesh's units";
  say("load picture.png");
  EXPECT_EQ(state_to_json(state()), picture_state_);
}

TEST_F(SessionTest, ListenersHearWhatHasChanged) {
  int times = 0, cases = 0;
  session_.listen([&](const Changes& c) { times += c.time, cases += c.shown; });
  open();
  EXPECT_EQ(cases, 1);
  say("time 3");
  EXPECT_EQ(times, 2);
  EXPECT_EQ(cases, 1);
  refused("case 77");
  EXPECT_EQ(cases, 1);
  session_.figures(2);
  const auto scene = session_.scene();
  refused("open /nonexistent");
  EXPECT_TRUE(session_.knows_figures(2)) << "what was found out is not lost";
  EXPECT_EQ(session_.scene(), scene);
}

}  // namespace
}  // namespace cleft
