// Every widget, found by its name, says what a user means by it and shows what the session is at.
#include <QAction>
#include <QCheckBox>
#include <QClipboard>
#include <QComboBox>
#include <QDialog>
#include <QDoubleSpinBox>
#include <QDropEvent>
#include <QFileDialog>
#include <QLabel>
#include <QMenu>
#include <QMimeData>
#include <QPushButton>
#include <QSlider>
#include <QTableView>
#include <QTest>
#include <QTextBrowser>
#include <QTimer>
#include <QToolButton>
#include <cstdlib>
#include <fstream>

#include "base/text.h"
#include "explorer/app/plots.h"
#include "explorer/io/formats/mesh_formats.h"
#include "explorer/session/command_table.h"
#include "haptic/devices/list.h"
#include "tests/app/window_fixture.h"

namespace cleft {
namespace {

TEST_F(WindowTest, BeginsWithTheWelcomePageAndRemembersStudies) {
  EXPECT_TRUE(widget<QWidget>("welcome").isVisible());
  tell("open " + study());
  EXPECT_FALSE(widget<QWidget>("welcome").isVisible());
  EXPECT_TRUE(window_.scene().isVisible());
  tell("close");
  EXPECT_TRUE(widget<QWidget>("welcome").isVisible());
  auto& recent = widget<QListWidget>("recent");
  ASSERT_GE(recent.count(), 1);
  EXPECT_EQ(recent.item(0)->text().toStdString(), study());
  emit recent.itemActivated(recent.item(0));
  EXPECT_EQ(now().study, study());
}

TEST_F(WindowTest, TheTimeBarScrubsStepsPlaysAndLoops) {
  tell("open " + study());
  auto& slider = widget<QSlider>("time");
  EXPECT_EQ(slider.value(), slider.maximum());
  slider.setValue(slider.maximum() / 2);
  EXPECT_NEAR(now().time, 15, 1e-9);
  EXPECT_EQ(widget<QLabel>("time_label").text().toStdString(), "15.0 of 30.0 mm cut");
  QTest::mouseClick(&widget<QToolButton>("step_forward"), Qt::LeftButton);
  EXPECT_NEAR(now().time, 16, 1e-9);
  QTest::mouseClick(&widget<QToolButton>("step_back"), Qt::LeftButton);
  EXPECT_NEAR(now().time, 15, 1e-9);
  widget<QCheckBox>("loop").click();
  EXPECT_TRUE(now().loop);
  widget<QDoubleSpinBox>("speed").setValue(25);
  EXPECT_EQ(now().speed, 25);
  QTest::mouseClick(&widget<QToolButton>("play"), Qt::LeftButton);
  EXPECT_TRUE(now().playing);
  settle(150);
  EXPECT_GT(now().time, 15);
  QTest::mouseClick(&widget<QToolButton>("play"), Qt::LeftButton);
  EXPECT_FALSE(now().playing);
  const double stopped = now().time;
  settle(20);
  EXPECT_EQ(now().time, stopped);
}

TEST_F(WindowTest, ASliderForEveryParameterThatVaries) {
  tell("open " + study());
  auto& slider = widget<QSlider>("skin.prestress_v");
  EXPECT_EQ(window_.findChild<QSlider*>("cut.depth"), nullptr) << "all cases have the same";
  slider.setValue(slider.maximum());
  EXPECT_EQ(real_.study()->parameters(now().shown).number("skin.prestress_v"), 0.05);
  EXPECT_TRUE(real_.shows_exactly());
  slider.setValue(slider.maximum() * 2 / 3);
  EXPECT_EQ(real_.study()->parameters(now().shown).number("skin.prestress_v"), 0.05) << "the nearest case";
  for (int tries = 0; tries < 200 && !real_.between(); ++tries) settle(20);
  ASSERT_TRUE(real_.between()) << real_.why_nearest();
  EXPECT_NEAR(real_.between()->parameters->skin.prestress.vv, 0.04, 0.03 / 1000)
      << "as near as the slider can be put";
  EXPECT_NE(widget<QLabel>("parameter_note").text().indexOf("interpolated, not simulated"), -1);
  tell("between off");
  EXPECT_NE(widget<QLabel>("parameter_note").text().indexOf("nearest is shown"), -1);
  EXPECT_NE(slider.toolTip().indexOf("MPa"), -1) << slider.toolTip().toStdString();
  tell("case 1");
  EXPECT_EQ(slider.value(), 0) << "it follows the session";
}

TEST_F(WindowTest, ReadingTheCasesIsShownAndCanBeCancelled) {
  tell("open " + study());
  auto& cancel = widget<QPushButton>("cancel_preparing");
  EXPECT_FALSE(cancel.isVisible());
  auto& slider = widget<QSlider>("skin.prestress_v");
  slider.setValue(slider.maximum() / 2);
  ASSERT_TRUE(real_.preparing());
  EXPECT_TRUE(cancel.isVisible());
  cancel.click();
  EXPECT_FALSE(real_.preparing());
  EXPECT_FALSE(now().between);
  EXPECT_FALSE(cancel.isVisible());
  settle(300);
  EXPECT_FALSE(real_.between()) << "nothing comes later";
  tell("between on");
  for (int tries = 0; tries < 200 && !real_.between(); ++tries) settle(20);
  EXPECT_TRUE(real_.between()) << real_.why_nearest();
  EXPECT_FALSE(cancel.isVisible());
}

TEST_F(WindowTest, ClosingWhileCasesAreReadEndsTheReading) {
  tell("open " + study());
  auto& slider = widget<QSlider>("skin.prestress_v");
  slider.setValue(slider.maximum() / 2);
  ASSERT_TRUE(real_.preparing());
  tell("close");
  EXPECT_FALSE(real_.preparing());
  EXPECT_FALSE(widget<QPushButton>("cancel_preparing").isVisible());
}

TEST_F(WindowTest, TheListOfCasesIsSortedAndChooses) {
  tell("open " + study());
  wait_for_figures();  // figures are read when nothing else is to be done
  auto& table = widget<QTableView>("cases");
  ASSERT_EQ(table.model()->rowCount(), 4);
  const int gape = 3;
  ASSERT_EQ(table.model()->headerData(gape, Qt::Horizontal).toString().toStdString(), "gape\nmm");
  table.sortByColumn(gape, Qt::DescendingOrder);
  EXPECT_EQ(table.model()->index(0, 0).data().toInt(), 4) << "the widest wound is that of the last case";
  EXPECT_NEAR(table.model()->index(0, gape).data(Qt::UserRole).toDouble(), 5.4, 0.1 * 5.4);
  table.setCurrentIndex(table.model()->index(0, 0));
  EXPECT_EQ(now().shown, 3);
  tell("case 2");
  EXPECT_EQ(table.model()->index(table.currentIndex().row(), 0).data().toInt(), 2);
}

TEST_F(WindowTest, DraggingOverAParallelAxisFadesTheOtherCases) {
  tell("open " + study());
  wait_for_figures();
  auto& lines = widget<QWidget>("parallel_coordinates");
  const double x = 34. / lines.width();  // the first axis: skin.prestress_v
  drag_over(lines, x, 0.2, x, 0.5);
  ASSERT_EQ(now().brushes.count("skin.prestress_v"), 1u);
  EXPECT_FALSE(real_.brushed(0));
  EXPECT_TRUE(real_.brushed(3));
  auto& table = widget<QTableView>("cases");
  EXPECT_TRUE(table.model()->index(0, 0).data(Qt::ForegroundRole).isValid()) << "faded";
  EXPECT_FALSE(table.model()->index(3, 0).data(Qt::ForegroundRole).isValid());
  QTest::mouseDClick(&lines, Qt::LeftButton, {}, QPoint(lines.width() / 2 + 20, 4));
  EXPECT_TRUE(now().brushes.empty());
}

TEST_F(WindowTest, ColouringsAreChosen) {
  tell("open " + study());
  auto& box = widget<QComboBox>("coloring");
  EXPECT_EQ(box.currentText(), "displacement");
  box.setCurrentIndex(box.findText("strain"));
  emit box.activated(box.currentIndex());
  EXPECT_EQ(now().coloring, Coloring::strain);
  tell("color gape");
  EXPECT_EQ(box.currentText(), "gape");
  box.setCurrentIndex(box.findText("difference"));
  emit box.activated(box.currentIndex());
  EXPECT_NE(window_.message().indexOf("difference N"), -1) << "from which case?";
  EXPECT_EQ(box.currentText(), "gape") << "the box comes back to what is shown";
}

TEST_F(WindowTest, PressingAndDraggingCutsTheSkin) {
  tell("open " + study());
  tell("mesh " + mesh());
  settle(20);
  auto& scalpel = widget<QAction>("scalpel");
  ASSERT_TRUE(scalpel.isEnabled());
  scalpel.trigger();
  widget<QDoubleSpinBox>("depth").setValue(2);
  drag_over(window_.scene(), 0.35, 0.5, 0.65, 0.5);
  ASSERT_EQ(now().cuts.size(), 1u) << window_.message().toStdString();
  ASSERT_TRUE(now().camera.pose) << "the picture does not turn under the hand";
  EXPECT_NEAR(now().camera.pose->position.x, 0, 1e-6);
  for (const ScalpelPath::Point& p : now().cuts[0].points) {
    EXPECT_NEAR(p.position.z, 0, 1e-3);
    EXPECT_GT(p.outward.z, 0.999);
    EXPECT_EQ(p.depth, 2);
  }
  EXPECT_GT(real_.duration(), 10);
  QTest::keyClick(&window_, Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(now().cuts.size(), 0u);
  widget<QAction>("redo").trigger();
  EXPECT_EQ(now().cuts.size(), 1u);
  widget<QAction>("patch").trigger();
  EXPECT_FALSE(scalpel.isEnabled());
  EXPECT_FALSE(window_.scene().cutting());
}

TEST_F(WindowTest, ALevelOfDetailIsChosenAndTold) {
  tell("open " + study());
  tell("mesh " + mesh());
  tell("cut -15,0.7,0,0,0,1 0,0.7,0,0,0,1 15,0.7,0,0,0,1");
  EXPECT_TRUE(widget<QAction>("detail_off").isChecked());
  EXPECT_EQ(widget<QLabel>("status").text().indexOf("left at rest"), -1);
  widget<QAction>("detail_1px").trigger();
  EXPECT_EQ(text_of(*now().detail), "1px");
  EXPECT_TRUE(widget<QAction>("detail_1px").isChecked());
  EXPECT_FALSE(widget<QAction>("detail_off").isChecked());
  EXPECT_NE(widget<QLabel>("status").text().indexOf("left at rest"), -1);
  ASSERT_TRUE(real_.seen());
  const std::size_t before = real_.seen()->left_out.vertices;
  EXPECT_GT(before, 0u);
  EXPECT_LE(real_.seen()->pixels, 1);
  tell("camera 0 0 4");
  EXPECT_LT(real_.seen()->left_out.vertices, before);
  widget<QAction>("detail_off").trigger();
  EXPECT_FALSE(now().detail);
  EXPECT_FALSE(real_.seen());
}

TEST_F(WindowTest, CutsAreSimulatedWhileTheWindowGoesOn) {
  tell("open " + study());
  EXPECT_FALSE(widget<QAction>("simulate").isEnabled()) << "there is no mesh";
  tell("mesh " + mesh());
  tell("cut -8,0.7,0,0,0,1 0,0.7,0,0,0,1 8,0.7,0,0,0,1 depth 2");
  widget<QAction>("simulate").trigger();
  EXPECT_TRUE(now().simulate);
  EXPECT_TRUE(real_.simulating());
  tell("time 3");  // the window takes lines meanwhile
  for (int tries = 0; tries < 600 && real_.simulating(); ++tries) settle(100);
  EXPECT_TRUE(real_.simulation_note().starts_with("simulated, ")) << real_.simulation_note();
  widget<QAction>("simulate").trigger();
  EXPECT_FALSE(now().simulate);
  EXPECT_EQ(real_.simulation_note(), "");
}

TEST_F(WindowTest, CurvesAreThoseOfTheWoundWithItsExpectedError) {
  tell("open " + study());
  tell("mesh " + mesh());
  tell("cut -15,0.7,0,0,0,1 0,0.7,0,0,0,1 15,0.7,0,0,0,1");
  const Plots* plots = nullptr;
  for (QWidget* one : window_.findChildren<QWidget*>())
    if (!plots) plots = dynamic_cast<const Plots*>(one);
  ASSERT_TRUE(plots);
  const Curve& curve = plots->profile();
  for (int tries = 0; tries < 100 && curve.x.empty(); ++tries) settle(20);  // it is drawn soon after
  const std::vector<double>& error = plots->profile_error();
  ASSERT_GT(curve.x.size(), 10u);
  ASSERT_EQ(error.size(), curve.x.size());
  EXPECT_NEAR(curve.x.back(), 30, 1e-6);
  const auto openings = real_.scene()->openings(now().time);
  EXPECT_EQ(curve.y, openings.front().values);
  const double widest = *std::max_element(curve.y.begin(), curve.y.end());
  EXPECT_GT(widest, 1);
  const double largest = real_.validity().front().expected_error.largest;
  EXPECT_NEAR(*std::max_element(error.begin(), error.end()), largest * widest, 0.02 * largest * widest);
  EXPECT_EQ(error.back(), 0) << "the end is closed";
}

TEST_F(WindowTest, CurvesKeepTheWoundsThatTheyAreOf) {
  tell("open " + study());
  tell("mesh " + mesh());
  tell("cut -15,0.7,0,0,0,1 0,0.7,0,0,0,1 15,0.7,0,0,0,1");
  settle(500);  // the curves are drawn
  const std::weak_ptr<const WoundScene> wounds = real_.scene();
  tell("undo");
  EXPECT_FALSE(wounds.expired()) << "another wound could take its place in memory, and its curves";
  settle(500);
  EXPECT_TRUE(wounds.expired()) << "until other curves are drawn";
}

TEST_F(WindowTest, WithoutTheScalpelDraggingTurnsThePicture) {
  tell("open " + study());
  tell("mesh " + mesh());
  settle(20);
  drag_over(window_.scene(), 0.5, 0.5, 0.7, 0.6);
  EXPECT_TRUE(now().camera.pose.has_value());
  EXPECT_TRUE(now().cuts.empty());
  widget<QAction>("front").trigger();
  EXPECT_FALSE(now().camera.pose.has_value());
}

TEST_F(WindowTest, ErrorsAreToldAndTheSessionIsIntact) {
  tell("open " + study());
  tell("time 12");
  const std::string before = state_to_json(now());
  std::ofstream(folder_ / "lines.obj") << "v 0 0 0\nv 1 0 0\nl 1 2\n";
  std::ofstream(folder_ / "torn.dffd") << "HDF";
  for (const std::string& line :
       {"mesh " + folder_ / "lines.obj", "open " + folder_ / "torn.dffd", std::string("open /gone"),
        "screenshot " + folder_ / "no/such/folder.png", "export " + folder_ / "a.xyz"}) {
    EXPECT_FALSE(window_.say(line)) << line;
    EXPECT_TRUE(widget<QWidget>("message_bar").isVisible()) << line;
    EXPECT_EQ(state_to_json(now()), before) << line;
  }
  widget<QPushButton>("copy_message").click();
  EXPECT_EQ(QApplication::clipboard()->text(), window_.message());
  tell("time 13");
  EXPECT_FALSE(widget<QWidget>("message_bar").isVisible());
}

TEST_F(WindowTest, FilesAreDropped) {
  const auto drop = [&](const std::string& file) {
    QMimeData data;
    data.setUrls({QUrl::fromLocalFile(QString::fromStdString(file))});
    QDragEnterEvent enter({10, 10}, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(&window_, &enter);
    QDropEvent event({10, 10}, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(&window_, &event);
  };
  drop(study());
  EXPECT_EQ(now().study, study());
  drop(mesh());
  EXPECT_EQ(now().mesh, mesh());
  const std::string capitals = folder_ / "HEAD.STL";
  write_mesh(capitals, flat_plate());
  drop(capitals);
  EXPECT_EQ(now().mesh, capitals) << "endings are compared without regard to case";
  drop(mesh());
  tell("time 0");
  tell("screenshot " + folder_ / "a.png 320 200");
  tell("close");
  drop(folder_ / "a.png");
  EXPECT_EQ(now().mesh, mesh()) << "a picture holds its session";
}

TEST_F(WindowTest, DialogsAndTheWelcomePageNameTheFormatsOfTheTable) {
  EXPECT_NE(widget<QLabel>("hint").text().toStdString().find(
                "(" + mesh_endings(MeshKind::surface, MeshUse::read) + ")"),
            std::string::npos);
  tell("mesh " + mesh());
  for (const auto& [action, use] : {std::pair{"open_mesh", MeshUse::read}, {"export", MeshUse::write}}) {
    QStringList filters;
    QTimer::singleShot(300, [&filters] {
      auto* dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
      if (!dialog) return;
      filters = dialog->nameFilters();
      dialog->reject();
    });
    widget<QAction>(action).trigger();
    ASSERT_EQ(filters.size(), 1) << action;
    EXPECT_EQ(filters[0].toStdString(), surface_filter(use)) << action;
  }
}

TEST_F(WindowTest, TheMenuHasEveryDeviceOfTheTable) {
  for (const DeviceKind& kind : built_in_devices()) {
    const auto& action = widget<QAction>(("device_" + kind.name).c_str());
    EXPECT_EQ(action.text().toStdString(), kind.title);
    EXPECT_EQ(action.toolTip().toStdString(), kind.help);
  }
  // Plug-ins are looked for when the menu opens; one that cannot be used is there with the reason.
  std::ofstream(folder_ / "torn.so") << "no library";
  setenv("CLEFT_DEVICES", (folder_ / "").c_str(), 1);
  auto* menu = qobject_cast<QMenu*>(widget<QAction>("device_off").associatedWidgets().front());
  ASSERT_TRUE(menu);
  emit menu->aboutToShow();
  unsetenv("CLEFT_DEVICES");
  const auto& torn = widget<QAction>("device_torn");
  EXPECT_FALSE(torn.isEnabled());
  EXPECT_GE(torn.toolTip().indexOf("cannot be loaded"), 0) << torn.toolTip().toStdString();
}

TEST_F(WindowTest, TheHelpSheetNamesEveryCommand) {
  QTest::keyClick(&window_, Qt::Key_F1);
  settle(50);
  auto& help = widget<QDialog>("help");
  EXPECT_TRUE(help.isVisible());
  const std::string text = widget<QTextBrowser>("help_text").toPlainText().toStdString();
  for (const CommandGroup& group : command_groups())
    for (const Command& c : group.commands) EXPECT_NE(text.find(c.name), std::string::npos) << c.name;
}

TEST_F(WindowTest, TheCommandLineTakesCommands) {
  auto& line = widget<QLineEdit>("command_line");
  QTest::keyClicks(&line, QString::fromStdString("open " + study()));
  QTest::keyClick(&line, Qt::Key_Return);
  EXPECT_EQ(now().study, study());
  EXPECT_TRUE(line.text().isEmpty());
  QTest::keyClicks(&line, "tme 3");
  QTest::keyClick(&line, Qt::Key_Return);
  EXPECT_NE(window_.message().indexOf("'time'"), -1);
  EXPECT_EQ(line.text(), "tme 3") << "to be mended";
}

TEST_F(WindowTest, DarkAndLightAndSideBySide) {
  tell("open " + study());
  widget<QAction>("dark").trigger();
  EXPECT_TRUE(now().dark);
  EXPECT_LT(QApplication::palette().color(QPalette::Window).lightness(), 80);
  widget<QAction>("compare").trigger();
  EXPECT_EQ(now().compared, (std::vector{0, 1, 2, 3}));
  EXPECT_EQ(window_.scene().stage().views(), 4);
  widget<QAction>("single").trigger();
  EXPECT_EQ(window_.scene().stage().views(), 1);
  widget<QAction>("dark").trigger();
  EXPECT_GT(QApplication::palette().color(QPalette::Window).lightness(), 180);
}

TEST_F(WindowTest, WhatIsDoneByHandIsARecordingThatLeadsToTheSameState) {
  tell("open " + study());
  widget<QSlider>("tissue.young_modulus").setValue(1000);
  tell("mesh " + mesh());
  settle(20);
  widget<QAction>("scalpel").trigger();
  drag_over(window_.scene(), 0.35, 0.45, 0.65, 0.55);
  widget<QAction>("scalpel").trigger();
  window_.scene().set_cutting(false);
  drag_over(window_.scene(), 0.5, 0.5, 0.6, 0.6);
  widget<QSlider>("time").setValue(4000);
  tell("record " + folder_ / "hand.txt");
  const std::string by_hand = state_to_json(now());
  Session again(session_services([](const std::string&) {}));
  again.run_script(folder_ / "hand.txt");
  EXPECT_EQ(state_to_json(again.state()), by_hand);
  tell("screenshot " + folder_ / "hand.png 320 200");
  again.say("screenshot " + folder_ / "again.png 320 200");
  EXPECT_EQ(read_text_file(folder_ / "hand.png"), read_text_file(folder_ / "again.png")) << "byte for byte";
}

}  // namespace
}  // namespace cleft
