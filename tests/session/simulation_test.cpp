// Cuts in a mesh that are simulated as they are.
#include <cstdlib>
#include <thread>

#include "tests/session/session_fixture.h"

namespace cleft {
namespace {

class SimulationTest : public SessionTest {
 protected:
  SimulationTest() { setenv("CLEFT_BIN", CLEFT_BIN, 1); }

  /// The largest distance from rest, mm.
  double widest() {
    const std::vector<Vec3> at = points();
    const std::vector<Vec3>& rest = session_.scene()->surface().points;
    double largest = 0;
    for (std::size_t i = 0; i < at.size(); ++i) largest = std::max(largest, norm(at[i] - rest[i]));
    return largest;
  }

  static constexpr const char* cut = "cut -8,0.7,0,0,0,1 0,0.7,0,0,0,1 8,0.7,0,0,0,1 depth 2";
};

TEST_F(SimulationTest, OpensCutsWithoutAnyStudy) {
  say("mesh plate.stl");
  say(cut);
  EXPECT_EQ(widest(), 0) << "there is no field";
  say("simulate on");
  EXPECT_TRUE(session_.simulation_note().starts_with("simulated, ")) << session_.simulation_note();
  EXPECT_GT(widest(), 0.8);
  say("time 0");
  EXPECT_EQ(widest(), 0) << "before the cut";
  say("simulate off");
  say("time 100");
  EXPECT_EQ(widest(), 0);
  EXPECT_EQ(session_.simulation_note(), "");
}

TEST_F(SimulationTest, EachChangeOfTheCutsIsSimulatedAndTheReplayCompared) {
  open();
  say("mesh plate.stl");
  say(cut);
  const double replayed = widest();
  EXPECT_NE(refused("color error").find("simulate on"), std::string::npos);
  say("simulate on");
  const double once = widest();
  EXPECT_NE(once, replayed);
  EXPECT_NE(session_.simulation_note().find("replay was off by"), std::string::npos);
  say("color error");
  std::vector<double> error;
  session_.scene()->values(Coloring::error, nullptr, state().time, error);
  EXPECT_GT(*std::max_element(error.begin(), error.end()), 0.01);
  say("undo");
  EXPECT_EQ(session_.simulation_note(), "");
  say("redo");
  EXPECT_EQ(widest(), once) << "the same again";
  say("set tissue.young_modulus 0.04");
  EXPECT_LT(widest(), once) << "the tissue is stiffer";
}

TEST_F(SimulationTest, TheReplayIsShownMeanwhile) {
  open();
  say("mesh plate.stl");
  say(cut);
  const double replayed = widest();
  session_.prepare_beside(true);
  say("simulate on");
  EXPECT_TRUE(session_.simulating());
  EXPECT_EQ(widest(), replayed);
  EXPECT_NE(session_.simulation_note().find("replay"), std::string::npos);
  for (int tries = 0; tries < 1200 && session_.take_simulated(); ++tries)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_FALSE(session_.simulating());
  EXPECT_NE(widest(), replayed);
  say("cut -8,9,0,0,0,1 8,9,0,0,0,1 depth 2");  // the next one begins at once; it ends with the session
  EXPECT_TRUE(session_.simulating());
}

TEST_F(SimulationTest, WhatCannotBeSimulatedSaysWhyAndStaysAReplay) {
  open();
  say("mesh plate.stl");
  say("cut -8,0.7,0,0,0,1 8,0.7,0,0,0,1 depth 7.9");
  const double replayed = widest();
  say("simulate on");
  EXPECT_NE(session_.simulation_note().find("not simulated: the cut is 7.9 mm deep"), std::string::npos)
      << session_.simulation_note();
  EXPECT_EQ(widest(), replayed);
  say("patch");
  EXPECT_NE(refused("simulate on").find("no mesh"), std::string::npos);
}

}  // namespace
}  // namespace cleft
