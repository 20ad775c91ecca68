// Cuts that are changed after they were made: points, depth and tilt, and all that depends on them.
#include <cmath>
#include <numbers>

#include "base/text.h"
#include "explorer/session/actions.h"
#include "tests/session/raw_study.h"
#include "tests/session/session_fixture.h"

namespace cleft {
namespace {

/// A ball of the radius 30 mm about the origin, as rings of triangles.
SurfaceMesh ball() {
  constexpr int rings = 90, around = 180;
  constexpr double radius = 30, pi = std::numbers::pi;
  SurfaceMesh mesh;
  mesh.points.push_back({0, 0, radius});
  for (int j = 1; j < rings; ++j)
    for (int i = 0; i < around; ++i) {
      const double polar = pi * j / rings, turn = 2 * pi * i / around;
      mesh.points.push_back({radius * std::sin(polar) * std::cos(turn),
                             radius * std::sin(polar) * std::sin(turn), radius * std::cos(polar)});
    }
  mesh.points.push_back({0, 0, -radius});
  const int last = static_cast<int>(mesh.points.size()) - 1;
  const auto at = [](int j, int i) { return 1 + (j - 1) * around + i % around; };
  for (int i = 0; i < around; ++i) {
    mesh.triangles.push_back({0, at(1, i), at(1, i + 1)});
    mesh.triangles.push_back({last, at(rings - 1, i + 1), at(rings - 1, i)});
    for (int j = 1; j + 1 < rings; ++j) {
      mesh.triangles.push_back({at(j, i), at(j + 1, i), at(j + 1, i + 1)});
      mesh.triangles.push_back({at(j, i), at(j + 1, i + 1), at(j, i + 1)});
    }
  }
  return mesh;
}
/// How far the triangles of the ball are below it: the sagitta of the longest edge of its rings.
constexpr double flat = 0.03;

CutState along_equator(int points) {
  CutState cut;
  for (int i = 0; i < points; ++i) {
    const double turn = 0.5 * i / (points - 1);
    const Vec3 outward{std::cos(turn), std::sin(turn), 0};
    cut.points.push_back({30 * outward, outward, 0});
  }
  return cut;
}

TEST(CutEdits, APointIsPutOnTheSkinAndThoseWithinReachFollow) {
  const Skin skin(ball());
  const CutState cut = along_equator(31);
  CutEdit edit;
  const double up = 0.1;
  edit.moves = {
      {15, 30.5 * Vec3{std::cos(0.25) * std::cos(up), std::sin(0.25) * std::cos(up), std::sin(up)}}};
  edit.reach = 4;
  const CutState after = edited(cut, edit, skin);
  for (int i = 0; i < 31; ++i) {
    const Vec3& x = after.points[i].position;
    const double way = 15. * std::abs(i - 15) / 30;  // along the arc of 15 mm
    if (way > 4) {
      EXPECT_EQ(x, cut.points[i].position) << i << ": beyond the reach";
      continue;
    }
    EXPECT_NEAR(norm(x), 30, flat) << i << ": on the ball";
    const double part = std::pow(1 - way * way / 16, 2);
    EXPECT_NEAR(x.z, part * 30 * std::sin(up), 0.05) << i;
    EXPECT_GT(dot(after.points[i].outward, normalized(x)), 0.9995) << i << ": the blade stays upright";
  }
  EXPECT_NEAR(after.points[15].position.z, 30 * std::sin(up), flat);
  edit.moves[0].to = {33, 0, 0};
  EXPECT_THROW(edited(cut, edit, skin), InputError) << "3 mm above the skin";
  edit.moves = {{31, {30, 0, 0}}};
  EXPECT_THROW(edited(cut, edit, skin), InputError);
}

TEST(CutEdits, TheBladeLeansAgainstTheSkinAndKeepsItsLeanWhereItIsMoved) {
  const Skin skin(ball());
  CutEdit edit;
  edit.tilt = 30;
  const CutState leaning = edited(along_equator(9), edit, skin);
  for (const ScalpelPath::Point& p : leaning.points) {
    // The cut's left is where the component along `across` is negative (scalpel_path.h).
    const Vec3 outward = normalized(p.position), along = cross(Vec3{0, 0, 1}, outward);
    const Vec3 across = cross(outward, along);
    EXPECT_NEAR(dot(p.outward, outward), std::cos(30 * std::numbers::pi / 180), 1e-3);
    EXPECT_NEAR(dot(p.outward, across), -std::sin(30 * std::numbers::pi / 180), 1e-3);
  }
  CutEdit move;
  move.moves = {
      {4, 30 * Vec3{std::cos(0.25) * std::cos(0.2), std::sin(0.25) * std::cos(0.2), std::sin(0.2)}}};
  const CutState moved = edited(leaning, move, skin);
  EXPECT_NEAR(dot(moved.points[4].outward, normalized(moved.points[4].position)),
              std::cos(30 * std::numbers::pi / 180), 2e-3);
  const CutHandles handles = handles_of(leaning, 5, skin);
  EXPECT_NEAR(handles.tilt.tilt, 30, 0.2);
  EXPECT_EQ(handles.depth.depth, 5);
  EXPECT_NEAR(norm(handles.depth_handle() - handles.depth.foot), 5, 1e-9);
}

TEST(CutEdits, APathOfManyPointsHasAFewHandlesThatMoveIndependently) {
  const Skin skin(ball());
  const CutState cut = along_equator(61);
  const CutHandles handles = handles_of(cut, 5, skin);
  ASSERT_EQ(handles.points, (std::vector{0, 30, 60}));
  EXPECT_NEAR(handles.reach, 7.5, 0.01);
  CutEdit edit;
  edit.moves = {{30, cut.points[30].position + Vec3{0, 0, 0.9}}};
  edit.reach = handles.reach;
  const CutState after = edited(cut, edit, skin);
  EXPECT_EQ(after.points[0].position, cut.points[0].position);
  EXPECT_EQ(after.points[60].position, cut.points[60].position);
  EXPECT_EQ(handles_of(along_equator(8), 5, skin).points.size(), 8u) << "all of a few";
}

TEST(CutEdits, DepthsKeepTheirProportions) {
  const Skin skin(ball());
  CutState cut = along_equator(3);
  cut.points[0].depth = 1, cut.points[1].depth = 4, cut.points[2].depth = 2;
  CutEdit edit;
  edit.depth = 6;
  const CutState deeper = edited(cut, edit, skin);
  EXPECT_NEAR(deeper.points[0].depth, 1.5, 1e-12);
  EXPECT_NEAR(deeper.points[1].depth, 6, 1e-12);
  EXPECT_NEAR(deeper.points[2].depth, 3, 1e-12);
  edit.depth = 0;
  for (const ScalpelPath::Point& p : edited(cut, edit, skin).points) EXPECT_EQ(p.depth, 0);
}

TEST_F(SessionTest, AnEditedCutIsThatWhichWouldHaveBeenMadeThereAndSoAreThoseAfterIt) {
  cut_plate();
  say("cut -10,9,0,0,0,1 10,9,0,0,0,1 depth 2");
  const std::vector<Vec3> before = points();
  say("edit-cut 1 point 1 -12,-3,0 point 3 14,-4,0");
  const std::vector<Vec3> after = points();
  ASSERT_EQ(state().cuts.size(), 2u);
  EXPECT_EQ(state().cuts[0].points[1].position, (Vec3{0, 0.7, 0}));
  EXPECT_EQ(state().time, session_.duration()) << "at the end it stays";
  Session made(session_services_of_plate());
  made.say("open " + study());
  made.say("mesh plate.stl");
  made.say("cut -12,-3,0,0,0,1 0,0.7,0,0,0,1 14,-4,0,0,0,1");
  made.say("cut -10,9,0,0,0,1 10,9,0,0,0,1 depth 2");
  std::vector<Vec3> anew;
  made.scene()->positions(made.state().time, anew);
  EXPECT_EQ(after, anew);
  say("undo");
  EXPECT_EQ(points(), before) << "one step";
  EXPECT_EQ(state().cuts.size(), 2u);
  say("redo");
  EXPECT_EQ(points(), after);
  say("time 5");
  say("edit-cut 1 depth 4 tilt -20");
  EXPECT_EQ(state().time, 5) << "elsewhere it stays, too";
  for (const ScalpelPath::Point& p : state().cuts[0].points) {
    EXPECT_EQ(p.depth, 4);
    EXPECT_NEAR(p.outward.z, std::cos(20 * std::numbers::pi / 180), 1e-9);
  }
}

TEST_F(SessionTest, EditsCutsAndTensionsAreUndoneInTheirOrderFromASavedSessionToo) {
  write_study_of_prestresses(folder_ / "three");
  say("open " + (folder_ / "three"));
  say("mesh plate.stl");
  std::vector<std::string> states{state_to_json(state())};
  const auto step = [&](const std::string& line) {
    say(line);
    std::string known = state_to_json(state());
    states.push_back(known);
  };
  step("cut -15,0.7,0,0,0,1 0,0.7,0,0,0,1 15,0.7,0,0,0,1");
  step("edit-cut 1 point 2 0,2,0");
  step("tension 0,1,0 0.03,0.01");
  step("edit-cut 1 depth 3");
  step("edit-cut 1 tilt 10");
  step("cut -10,12,0,0,0,1 10,12,0,0,0,1 depth 2");
  step("edit-cut 1 point 1 -14,-1,0");
  step("tension none");
  const auto shown = [&] { return state().cuts; };
  const auto same = [&](const std::string& json) {
    const SessionState then = state_from_json(json);
    ASSERT_EQ(then.cuts.size(), shown().size());
    for (std::size_t c = 0; c < then.cuts.size(); ++c)
      EXPECT_EQ(cut_line("cut", then.cuts[c]), cut_line("cut", shown()[c]));
    EXPECT_EQ(then.tension.has_value(), state().tension.has_value());
  };
  for (std::size_t k = states.size() - 1; k > 0; --k) {
    say("undo");
    same(states[k - 1]);
    if (k == 5) restore(session_, state_from_json(state_to_json(state())));
  }
  EXPECT_NE(refused("undo"), "");
  for (std::size_t k = 1; k < states.size(); ++k) {
    say("redo");
    same(states[k]);
  }
  EXPECT_NE(refused("redo"), "");
}

TEST_F(SessionTest, WhatCannotBeCutIsRefusedAndTheOldCutStays) {
  cut_plate();
  const std::string before = state_to_json(state());
  const std::vector<Vec3> shown = points();
  EXPECT_NE(refused("edit-cut 2 depth 3").find("the cut 2"), std::string::npos);
  EXPECT_NE(refused("edit-cut 1 point 4 0,0,0").find("the point 4"), std::string::npos);
  EXPECT_NE(refused("edit-cut 1 point 1 0,0,50").find("the skin is 50 mm away from 0,0,50"),
            std::string::npos);
  EXPECT_NE(refused("edit-cut 1 tilt 85").find("tilt 85"), std::string::npos);
  EXPECT_NE(refused("edit-cut 1 deep 3").find("neither point, reach, depth nor tilt"), std::string::npos);
  EXPECT_NE(refused("edit-cut 1"), "");
  // All points in one place are no path.
  EXPECT_NE(refused("edit-cut 1 point 1 0,0.7,0 point 2 0,0.7,0 point 3 0,0.7,0").find("2 different points"),
            std::string::npos);
  EXPECT_EQ(state_to_json(state()), before);
  EXPECT_EQ(points(), shown);
  say("patch");
  EXPECT_NE(refused("edit-cut 1 depth 3").find("no cut yet"), std::string::npos);
}

TEST_F(SessionTest, HandlesAreShownSavedAndGoWithTheirCut) {
  EXPECT_NE(refused("handles 1").find("no cut yet"), std::string::npos);
  cut_plate();
  EXPECT_TRUE(session_.overlay().empty());
  say("handles 1");
  Overlay overlay = session_.overlay();
  ASSERT_EQ(overlay.handles.size(), 5u) << "three points, depth and tilt";
  EXPECT_EQ(overlay.handles[0].place, (Vec3{-15, 0.7, 0}));
  EXPECT_NEAR(overlay.handles[3].place.z, -6, 1e-9) << "as deep as the case";
  EXPECT_GT(overlay.handles[4].place.z, 5) << "above the skin";
  CutState preview = state().cuts[0];
  preview.points[1].position.y = 5;
  const std::string before = state_to_json(state());
  session_.preview_cut(preview);
  EXPECT_EQ(session_.overlay().handles[1].place.y, 5);
  EXPECT_EQ(state_to_json(state()), before) << "it is part of no state";
  session_.preview_cut({});
  restore(session_, state_from_json(before));
  EXPECT_EQ(state().handled, 0);
  say("undo");
  EXPECT_EQ(state().handled, -1);
  EXPECT_TRUE(session_.overlay().empty());
  say("redo");
  say("handles 1");
  say("handles off");
  EXPECT_TRUE(session_.overlay().empty());
}

TEST_F(SessionTest, FiguresOfLargeWoundsHaveNoExponent) {
  open();
  say("set skin.prestress_v 0.05");
  say("mesh plate.stl");
  say("cut -28,0.7,0,0,0,1 0,0.7,0,0,0,1 28,0.7,0,0,0,1 depth 25");
  const double volume = session_.scene()->wound_figures(state().time).front().volume;
  ASSERT_GT(volume, 1000);
  answers_.clear();
  say("wounds");
  EXPECT_NE(answers_.find(formatted(" %.0f mm3", 10 * std::round(volume / 10))), std::string::npos)
      << answers_;
}

TEST_F(SessionTest, CutsThatAFieldCannotOpenTogetherAreRefusedAndTheFirstStays) {
  const TemporaryFolder untold;  // a study whose fields do not tell the tension across the cut
  for (const int number : {0, 1}) {
    const std::string name = "case" + std::to_string(number), place = untold / ("study/cases/" + name);
    std::filesystem::create_directories(place);
    Field field = read_field(raw_study() + "/cases/" + name + "/case.dffd");
    field.parameters = recorded({{"tissue.young_modulus", 0.02 + 0.01 * number}, {"cut.depth", 6}});
    write_field(place + "/case.dffd", field);
    std::ofstream(place + "/manifest.json") << "{}";
  }
  say("open " + (untold / "study"));
  say("mesh plate.stl");
  say("cut -15,0.7,0,0,0,1 0,0.7,0,0,0,1 15,0.7,0,0,0,1");
  const std::string before = state_to_json(state());
  const std::vector<Vec3> once = points();
  EXPECT_NE(refused("cut -10,12,0,0,0,1 10,12,0,0,0,1").find("or make one cut"), std::string::npos);
  EXPECT_EQ(state_to_json(state()), before);
  EXPECT_EQ(session_.validity().size(), 1u);
  EXPECT_EQ(points(), once);
}

TEST_F(SessionTest, TheRecordingOfEditsLeadsToTheSameState) {
  cut_plate();
  say("edit-cut 1 point 2 0,3,0 reach 6");
  say("handles 1");
  say("edit-cut 1 depth 2.5");
  say("undo");
  say("cut -10,12,0,0,0,1 10,12,0,0,0,1 depth 2");
  say("edit-cut 2 tilt 15");
  say("record " + folder_ / "edits.txt");
  Session again(session_services_of_plate());
  again.run_script(folder_ / "edits.txt");
  EXPECT_EQ(state_to_json(again.state()), state_to_json(state()));
}

}  // namespace
}  // namespace cleft
