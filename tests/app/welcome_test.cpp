// The first page: examples that come with the installation, each with one click or the key Enter.
#include <QClipboard>
#include <QLabel>
#include <QPushButton>
#include <QSlider>
#include <QTest>

#include "tests/app/window_fixture.h"

namespace cleft {
namespace {

class Welcome : public WindowTest {
 protected:
  /// Opening happens when the click is over.
  void click(const char* name) {
    QTest::mouseClick(&widget<QPushButton>(name), Qt::LeftButton);
    settle(50);
  }
};

TEST_F(Welcome, HasThreeStepsAndAStudyAHeadAndAFamily) {
  EXPECT_EQ(widget<QLabel>("steps").text().count("<li>"), 3);
  const std::vector<Example> all = examples_in(examples_folder(), folder_ / "none");
  ASSERT_EQ(all.size(), 3u) << examples_folder();
  for (const Example& example : all) {
    EXPECT_TRUE(widget<QPushButton>(example.name.toStdString().c_str()).isVisible());
    EXPECT_EQ(example.lines.empty(), !example.command.isEmpty()) << example.name.toStdString();
  }
  EXPECT_TRUE(examples_in(folder_ / "nowhere", folder_ / "none").empty())
      << "nothing is offered that is not there";
}

TEST_F(Welcome, AStudyAndAHeadOpenWithOneClick) {
  click("example_study");
  EXPECT_TRUE(now().study.ends_with("share/cleft/examples/demo.dffd")) << window_.message().toStdString();
  EXPECT_EQ(real_.study()->size(), 4);
  EXPECT_TRUE(now().mesh.empty());
  tell("close");
  click("example_head");
  EXPECT_TRUE(now().mesh.ends_with("head.stl")) << window_.message().toStdString();
  ASSERT_EQ(now().cuts.size(), 1u);
  EXPECT_GT(real_.duration(), 60);
  const WoundFigures wound = real_.scene()->wound_figures(now().time).front();
  EXPECT_GT(wound.widest, 1) << "it is open";
}

TEST_F(Welcome, EnterOpensToo) {
  auto& button = widget<QPushButton>("example_study");
  button.setFocus();
  ASSERT_EQ(QApplication::focusWidget(), &button);
  QTest::keyClick(&button, Qt::Key_Return);
  settle(50);
  EXPECT_FALSE(now().study.empty());
}

TEST_F(Welcome, WhatIsComputedFirstIsToldWithItsCommand) {
  const std::string computed = folder_ / "my data";
  Example family = examples_in(examples_folder(), computed).back();
  EXPECT_EQ(family.command.toStdString(),
            "cleft run " + examples_folder() + "/demo_family.toml --out '" + computed + "/family'");
  std::filesystem::create_directories(computed + "/family");
  std::filesystem::copy(examples_folder() + "/demo.dffd", computed + "/family/study.dffd");
  family = examples_in(examples_folder(), computed).back();
  EXPECT_TRUE(family.command.isEmpty()) << "it has been computed";
  for (const std::string& line : family.lines) tell(line);
  EXPECT_EQ(now().study, computed + "/family/study.dffd");
  tell("close");
  if (examples_in(examples_folder(), computed_examples_folder()).back().command.isEmpty())
    GTEST_SKIP() << "somebody has computed the family here";
  click("example_family");
  EXPECT_NE(window_.message().indexOf("cleft run "), -1) << window_.message().toStdString();
  EXPECT_NE(QApplication::clipboard()->text().indexOf("demo_family.toml --out "), -1);
  EXPECT_TRUE(now().study.empty());
}

TEST_F(Welcome, ControlsKeepTheKeysWithoutWhichTheyCannotBeUsed) {
  tell("open " + study());
  tell("time 10");
  auto& loop = widget<QAbstractButton>("loop");
  loop.setFocus();
  QTest::keyClick(&loop, Qt::Key_Space);
  EXPECT_TRUE(now().loop);
  EXPECT_FALSE(now().playing);
  auto& slider = widget<QSlider>("skin.prestress_v");
  slider.setFocus();
  QTest::keyClick(&slider, Qt::Key_End);
  EXPECT_EQ(now().parameters.at("skin.prestress_v"), 0.05);
  QTest::keyClick(&slider, Qt::Key_Space);
  EXPECT_TRUE(now().playing) << "a slider needs no Space";
  tell("pause");
  tell("time 10");
  auto& time = widget<QSlider>("time");
  time.setFocus();
  QTest::keyClick(&time, Qt::Key_Right);
  EXPECT_NEAR(now().time, 11, 1e-9);
}

}  // namespace
}  // namespace cleft
