// A haptic device in the window: what it cuts becomes the session's, and errors are reported.
#include <QAction>
#include <cstdlib>

#include "base/text.h"
#include "explorer/scene/live_scene.h"
#include "tests/app/window_fixture.h"

namespace cleft {
namespace {

class DeviceTest : public WindowTest {
 protected:
  DeviceTest() {
    tell("mesh " + mesh());  // and no study: skin of 0.3 N/mm, wounds that stay closed
    settle(20);
  }
  ~DeviceTest() override { window_.say("device off"); }

  /// Straight from one place to the other, upright, as the recorded device plays it.
  void go(const Vec3& from, const Vec3& to, double seconds, bool present = true) {
    const int ticks = static_cast<int>(seconds * 1000);
    for (int k = 1; k <= ticks; ++k) {
      time_ += 1e-3;
      const Vec3 tip = lerp(from, to, double(k) / ticks);
      for (const double x : {time_, tip.x, tip.y, tip.z}) poses_ += shortest(x) + ",";
      poses_ += present ? "0,0,1,1,0,0,1,1\n" : "0,0,1,1,0,0,1,0\n";
    }
  }
  void play() {
    std::ofstream(folder_ / "poses.csv") << "time,x,y,z,ax,ay,az,ex,ey,ez,cutting,present\n" << poses_;
    tell("device recorded " + folder_ / "poses.csv");
  }
  /// Waits for something, at most 20 s.
  template <class Condition>
  bool soon(const Condition& condition) {
    for (int tries = 0; tries < 1000 && !condition(); ++tries) settle(20);
    return condition();
  }
  /// In the picture, in parts of its width and height.
  QPointF at(double x, double y = 0.5) { return {window_.scene().width() * x, window_.scene().height() * y}; }
  /// Presses until the blade cuts, and goes on across a fifth of the picture.
  void cut_by_mouse(double y = 0.5) {
    mouse(window_.scene(), QEvent::MouseButtonPress, at(0.4, y));
    ASSERT_TRUE(soon([&] { return window_.device().state().phase == Phase::cutting; }));
    for (double x = 0.4; x < 0.6; x += 0.01) {
      mouse(window_.scene(), QEvent::MouseMove, at(x, y));
      settle(40);
    }
  }
  std::string status() { return widget<QLabel>("status").text().toStdString(); }
  const WoundView& picture() { return window_.scene().stage().view(0); }

  std::string poses_;
  double time_ = 0;
};

TEST_F(DeviceTest, EveryCutOfARecordingBecomesOneOfTheSession) {
  const double deep = -7;
  go({-8, -5.3, 3}, {-8, -5.3, deep}, 0.5);
  go({-8, -5.3, deep}, {6, -5.3, deep}, 1);
  go({6, -5.3, deep}, {6, -5.3, 4}, 0.3);
  go({-6, 6.7, 4}, {-6, 6.7, deep}, 0.5);
  go({-6, 6.7, deep}, {4, 6.7, deep}, 0.8);
  go({4, 6.7, deep}, {4, 6.7, 4}, 0.3);
  play();
  EXPECT_TRUE(widget<QAction>("device_recorded").isChecked());
  ASSERT_TRUE(soon([&] { return now().cuts.size() == 2; })) << window_.message().toStdString();
  for (const CutState& cut : now().cuts)
    for (const ScalpelPath::Point& p : cut.points) {
      EXPECT_NEAR(p.position.z, 0, 1e-3) << "places are of the skin at rest";
      EXPECT_NEAR(std::abs(p.position.y - 0.7), 6, 0.3);
    }
  EXPECT_NE(status().find("recorded: "), std::string::npos) << status();
  EXPECT_NE(status().find(" Hz, "), std::string::npos) << status();
  widget<QAction>("undo").trigger();
  EXPECT_EQ(now().cuts.size(), 1u);
  EXPECT_TRUE(window_.device().on()) << "what was undone is not felt any more";
  widget<QAction>("redo").trigger();
  EXPECT_EQ(now().cuts.size(), 2u);
  tell("device off");
  EXPECT_FALSE(window_.device().on());
  tell("record " + folder_ / "felt.txt");
  const std::string felt = state_to_json(now());
  Session again(session_services([](const std::string&) {}));
  again.run_script(folder_ / "felt.txt");
  EXPECT_EQ(state_to_json(again.state()), felt) << "a script of it needs no device";
}

TEST_F(DeviceTest, TheSkinDentsByForceOverStiffnessUntilItHoldsNoLonger) {
  go({0, 0, 3}, {0, 0, -1}, 0.2);
  go({0, 0, -1}, {0, 0, -1}, 3);
  play();
  ASSERT_TRUE(soon([&] { return window_.device().state().phase == Phase::contact; }));
  settle(300);
  double lowest = 0;
  for (const Vec3& p : picture().points()) lowest = std::min(lowest, p.z);
  const HapticState& state = window_.device().state();
  EXPECT_NEAR(norm(state.force), 0.3, 0.015) << "1 mm, to 5 %";
  EXPECT_NEAR(lowest, -norm(state.force) / 0.3, 0.05) << "a vertex of the plate is under the tip";
  EXPECT_TRUE(now().cuts.empty());
}

TEST_F(DeviceTest, TheHandFollowsItsPath) {
  tell("open " + study());
  std::ofstream(folder_ / "path.csv") << "x,y,z,nx,ny,nz\n-8,0.7,0,0,0,1\n8,0.9,0,0,0,1\n";
  tell("device hand " + folder_ / "path.csv");
  EXPECT_TRUE(widget<QAction>("device_hand").isChecked());
  ASSERT_TRUE(soon([&] { return now().cuts.size() == 1; })) << window_.message().toStdString();
  double length = 0;
  const auto& points = now().cuts[0].points;
  for (std::size_t i = 1; i < points.size(); ++i) length += norm(points[i].position - points[i - 1].position);
  EXPECT_NEAR(points.front().position.x, -8, 0.3);
  EXPECT_LT(length, 16.01);
  EXPECT_GT(length, 8) << "the hand is behind its path when it lifts the blade";
}

TEST_F(DeviceTest, UnpluggingEndsTheCutAndNothingElse) {
  const double deep = -7;
  go({-8, 0.7, 3}, {-8, 0.7, deep}, 0.5);
  go({-8, 0.7, deep}, {2, 0.7, deep}, 0.8);
  go({2, 0.7, deep}, {2, 0.7, deep}, 1.5, false);
  go({2, 0.7, 5}, {2, 0.7, 5}, 0.2);
  play();
  ASSERT_TRUE(soon([&] { return window_.message().indexOf("is gone") >= 0; }));
  EXPECT_TRUE(soon([&] { return status().find("is gone") != std::string::npos; }));
  ASSERT_TRUE(soon([&] { return now().cuts.size() == 1; }));
  EXPECT_TRUE(window_.device().on());
  ASSERT_TRUE(soon([&] { return window_.device().state().pose.present && window_.message().isEmpty(); }));
  tell("time 3");
}

TEST_F(DeviceTest, TheMouseSinksTheBladeWhereItIsPressed) {
  tell("open " + study());
  settle(20);
  widget<QAction>("device_mouse").trigger();
  ASSERT_TRUE(window_.device().on());
  cut_by_mouse();
  EXPECT_TRUE(now().cuts.empty()) << "it is one when the blade is out";
  EXPECT_GT(picture().duration(), 5) << "and drawn before";
  mouse(window_.scene(), QEvent::MouseButtonRelease, at(0.6));
  ASSERT_TRUE(soon([&] { return now().cuts.size() == 1; })) << window_.message().toStdString();
  widget<QAction>("device_off").trigger();
  EXPECT_FALSE(window_.device().on());
}

TEST_F(DeviceTest, ACutUnderWayIsKeptWhenTheDeviceIsPutAway) {
  tell("open " + study());
  settle(20);
  tell("device mouse");
  cut_by_mouse();
  tell("device off");
  EXPECT_TRUE(soon([&] { return now().cuts.size() == 1; })) << window_.message().toStdString();
}

TEST_F(DeviceTest, SimulatedWoundsAreFeltAndSeenAndNoCutUnderWayIsLost) {
  tell("open " + study());
  tell("cut -8,-5.3,0,0,0,1 0,-5.3,0,0,0,1 8,-5.3,0,0,0,1 depth 2");
  tell("time 100");
  tell("simulate on");
  ASSERT_TRUE(soon([&] { return !real_.simulating(); }));
  ASSERT_TRUE(real_.simulation_note().starts_with("simulated, ")) << real_.simulation_note();
  settle(50);
  const std::vector<Vec3> seen = picture().points();
  tell("device mouse");
  settle(100);
  const std::vector<Vec3> felt = picture().points();
  ASSERT_EQ(felt.size(), seen.size());
  double apart = 0;
  for (std::size_t v = 0; v < felt.size(); ++v) apart = std::max(apart, norm(felt[v] - seen[v]));
  EXPECT_LT(apart, 1e-3) << "mm; the replay is off by 62 %";
  cut_by_mouse(0.3);  // beside the first cut
  tell("simulate off");
  tell("time 3");
  EXPECT_EQ(window_.device().state().phase, Phase::cutting) << "the cut goes on";
  mouse(window_.scene(), QEvent::MouseButtonRelease, at(0.6, 0.3));
  EXPECT_TRUE(soon([&] { return now().cuts.size() == 2; })) << window_.message().toStdString();
}

TEST_F(DeviceTest, WhatIsMissingIsTold) {
  tell("open " + study());
  setenv("SPNAV_SOCKET", (folder_ / "nobody.sock").c_str(), 1);
  const auto refused = [&](const std::string& line, const char* part) {
    EXPECT_FALSE(window_.say(line)) << line;
    EXPECT_GE(window_.message().indexOf(part), 0) << window_.message().toStdString();
  };
  refused("device spacemouse", "install the package spacenavd");
  refused("device phantom", "install OpenHaptics");
  refused("device hand", "hand PATH.csv");
  refused("device recorded /gone.csv", "gone.csv");
  refused("device pen", "there is none of that name");
  EXPECT_FALSE(window_.device().on());
  tell("device mouse");
  refused("device recorded /gone.csv", "gone.csv");
  EXPECT_EQ(window_.device().name(), "mouse") << "the one before stays";
  tell("patch");
  EXPECT_FALSE(window_.device().on());
  refused("device mouse", "there is no mesh");
  Session headless(session_services([](const std::string&) {}));
  try {
    headless.say("device mouse");
    ADD_FAILURE() << "felt by nobody";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("cleft haptic"), std::string::npos);
  }
}

}  // namespace
}  // namespace cleft
