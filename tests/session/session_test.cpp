// What commands do to a session.
#include "base/text.h"
#include "explorer/session/actions.h"
#include "tests/session/session_fixture.h"

namespace cleft {
namespace {

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
