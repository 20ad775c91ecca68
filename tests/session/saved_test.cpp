// What a session writes: its state, recordings and scripts.
#include "base/text.h"
#include "explorer/session/actions.h"
#include "tests/session/session_fixture.h"

namespace cleft {
namespace {

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
  say("shading skin");
  say("range 2% 98%");
  say("clip cut 1 10");
  const SessionState saved = state_from_json(state_to_json(state()));
  EXPECT_EQ(saved.warp, 2.5);
  EXPECT_EQ(saved.map, "viridis");
  EXPECT_TRUE(saved.edges);
  EXPECT_TRUE(saved.lifelike);
  EXPECT_FALSE(state_from_json(state_to_json(SessionState{})).lifelike) << "as in sessions of before";
  EXPECT_NE(refused("shading skim").find("'skim'"), std::string::npos);
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

}  // namespace
}  // namespace cleft
