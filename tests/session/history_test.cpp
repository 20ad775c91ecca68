// What any line has changed is taken back and made again.
#include "explorer/session/actions.h"
#include "explorer/session/command_table.h"
#include "tests/session/session_fixture.h"

namespace cleft {
namespace {

class History : public SessionTest {};

TEST_F(History, EveryLineThatChangesAnythingIsTakenBackAndMadeAgain) {
  const std::string other = folder_ / "saved.json";
  say("open " + study());
  say("case 3");
  say("save " + other);
  say("close");
  const std::vector<std::string> lines{"open " + study(),
                                       "case 2",
                                       "set tissue.young_modulus 0.02",
                                       "between off",
                                       "compare 1 3",
                                       "single",
                                       "brush gape 0 4",
                                       "find gape > 3",
                                       "filter on",
                                       "sort gape down",
                                       "select 1 2",
                                       "wall on",
                                       "color strain",
                                       "difference 1",
                                       "range 0 3",
                                       "map vik",
                                       "warp 2",
                                       "edges on",
                                       "theme dark",
                                       "figure lattice",
                                       "probe 1,2,0",
                                       "clip cut 1 5",
                                       "mesh plate.stl",
                                       "cut -15,0.7,0,0,0,1 0,0.7,0,0,0,1 15,0.7,0,0,0,1",
                                       "edit-cut 1 point 2 0,3,0",
                                       "cut -10,12,0,0,0,1 10,12,0,0,0,1 depth 2",
                                       "recut -10,9,0,0,0,1 10,9,0,0,0,1 depth 2",
                                       "undo",
                                       "redo",
                                       "bone bone_plate.stl",
                                       "detail 10um",
                                       "measure -5,4,0 -5,-4,0",
                                       "unit cm",
                                       "patch",
                                       "load " + other,
                                       "close"};
  std::vector<std::string> states{state_to_json(state())};
  for (const std::string& line : lines) {
    say(line);
    states.push_back(state_to_json(state()));
    ASSERT_NE(states.back(), states[states.size() - 2]) << line << " changes nothing: another is needed here";
    EXPECT_EQ(session_.line_to_take_back(), line);
  }
  for (std::size_t k = lines.size(); k > 0; --k) {
    say("undo any");
    EXPECT_EQ(state_to_json(state()), states[k - 1]) << lines[k - 1];
    if (session_.has_scene()) session_.scene();
    EXPECT_EQ(session_.line_to_make_again(), lines[k - 1]);
  }
  // The first three steps are those before the list.
  for (std::size_t k = 1; k < states.size(); ++k) {
    say("redo any");
    EXPECT_EQ(state_to_json(state()), states[k]) << lines[k - 1];
  }
  EXPECT_NE(refused("redo any"), "");
}

TEST_F(History, TimeAndCameraAreNoStepsAndStayWhereTheyAre) {
  cut_plate();
  say("color displacement");
  say("time 12");
  say("camera 30 10");
  say("undo any");
  EXPECT_EQ(state().coloring, Coloring::tissue);
  EXPECT_EQ(state().time, 12);
  EXPECT_EQ(state().camera.azimuth, 30);
  say("undo any");
  EXPECT_TRUE(state().cuts.empty());
  EXPECT_EQ(state().camera.azimuth, 30) << "the cut has not turned the picture";
  say("redo any");
  ASSERT_EQ(state().cuts.size(), 1u);
  EXPECT_EQ(state().time, 12) << "as it was when the cut was taken back";
  say("undo any");
  say("color displacement");
  EXPECT_NE(refused("redo any"), "") << "after something new";
  EXPECT_NE(refused("undo all").find("'all' is not any"), std::string::npos);
}

TEST_F(History, ASliderIsOneStepAndARefusedLineNone) {
  open();
  say("case 1");
  const std::string before = state_to_json(state());
  say("set tissue.young_modulus 0.02");
  say("set tissue.young_modulus 0.03");
  say("set tissue.young_modulus 0.04");
  EXPECT_NE(refused("case 99"), "");
  say("case 2");  // as it is: nothing to take back
  say("undo any");
  EXPECT_EQ(state_to_json(state()), before);
  say("set tissue.young_modulus 0.02");
  say("set skin.prestress_v 0.03");
  say("undo any");
  EXPECT_EQ(state().parameters.at("tissue.young_modulus"), 0.02) << "another slider is another step";
}

TEST_F(History, TheRecordingOfItLeadsToTheSameState) {
  cut_plate();
  say("color displacement");
  say("undo any");
  say("undo any");
  say("redo any");
  say("edit-cut 1 depth 2");
  say("undo any");
  say("record " + folder_ / "lines.txt");
  Session again(session_services_of_plate());
  again.run_script(folder_ / "lines.txt");
  EXPECT_EQ(state_to_json(again.state()), state_to_json(state()));
}

}  // namespace
}  // namespace cleft
