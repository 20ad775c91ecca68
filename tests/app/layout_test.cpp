// Where things are in the window: panels, keys, lists; and what it says where something cannot be shown.
#include <QAction>
#include <QCheckBox>
#include <QDialog>
#include <QDockWidget>
#include <QDropEvent>
#include <QItemSelectionModel>
#include <QLabel>
#include <QMimeData>
#include <QPushButton>
#include <QRadioButton>
#include <QSettings>
#include <QSlider>
#include <QTableView>
#include <QTableWidget>
#include <QTest>
#include <QTextBrowser>
#include <QTimer>
#include <QToolButton>
#include <algorithm>
#include <cmath>
#include <set>

#include "explorer/app/analysis_panel.h"
#include "explorer/app/parameter_panel.h"
#include "explorer/app/plots.h"
#include "tests/app/window_fixture.h"
#include "tests/session/raw_study.h"

namespace cleft {
namespace {

class WindowLayout : public WindowTest {
 protected:
  template <class T>
  T& of_type() {
    for (QWidget* one : window_.findChildren<QWidget*>())
      if (auto* found = dynamic_cast<T*>(one)) return *found;
    throw std::runtime_error("no such widget");
  }
  std::vector<int> sizes_of_docks() {
    std::vector<int> sizes;
    for (const char* name : {"parameter_dock", "case_dock", "plot_dock", "line_dock"}) {
      const QDockWidget& dock = widget<QDockWidget>(name);
      sizes.push_back(dock.width()), sizes.push_back(dock.height());
    }
    return sizes;
  }
};

TEST_F(WindowLayout, TheTimeSliderStaysAt800Pixels) {
  tell("open " + study());
  window_.resize(800, 600);
  settle(50);
  EXPECT_EQ(window_.width(), 800) << "no panel needs more";
  EXPECT_EQ(window_.height(), 600);
  const QSlider& time = widget<QSlider>("time");
  EXPECT_TRUE(time.isVisible());
  EXPECT_GE(time.width(), 100);
  EXPECT_TRUE(widget<QLabel>("time_label").isVisible());
  tell("find gape > 5");
  tell("set skin.prestress_v 0.09");
  tell("mesh " + mesh());
  tell("cut -15,0.7,0,0,0,1 0,0.7,0,0,0,1 15,0.7,0,0,0,1");
  settle(50);
  EXPECT_EQ(window_.width(), 800) << "later neither";
  EXPECT_GE(widget<QWidget>("cases").width(), 150);
  EXPECT_GE(window_.scene().width(), 300);
  window_.resize(1280, 720);
  settle(50);
  EXPECT_TRUE(widget<QCheckBox>("loop").isVisible()) << "where there is room";
}

TEST_F(WindowLayout, DocksKeepTheirSizes) {
  window_.resize(1000, 640);
  settle(50);
  const std::vector<int> before = sizes_of_docks();
  tell("open " + study());
  wait_for_figures();
  EXPECT_EQ(sizes_of_docks(), before);
  tell("set skin.prestress_v 0.09");
  tell("between off");
  EXPECT_FALSE(window_.say("tme 3"));
  tell("mesh " + mesh());
  tell("cut -15,0.7,0,0,0,1 0,0.7,0,0,0,1 15,0.7,0,0,0,1");
  settle(50);
  EXPECT_EQ(sizes_of_docks(), before);
  EXPECT_EQ(window_.width(), 1000);
}

TEST_F(WindowLayout, TheLayoutIsRememberedAndClosedPanelsComeBack) {
  auto& dock = widget<QDockWidget>("case_dock");
  QAction* shown = dock.toggleViewAction();
  QMenu* panels = nullptr;
  for (QWidget* menu : shown->associatedWidgets())
    if (auto* found = qobject_cast<QMenu*>(menu)) panels = found;
  ASSERT_TRUE(panels) << "in the menu View";
  dock.close();
  EXPECT_FALSE(shown->isChecked());
  shown->trigger();
  EXPECT_TRUE(dock.isVisible());
  dock.close();
  window_.resizeDocks({&widget<QDockWidget>("plot_dock")}, {420}, Qt::Horizontal);
  settle(50);
  const int width = widget<QDockWidget>("plot_dock").width();
  EXPECT_GT(width, 370) << "it was 310 wide";
  window_.close();
  MainWindow again(real_);
  again.resize(1280, 720);
  again.restore_layout(false);
  again.show();
  settle(50);
  EXPECT_FALSE(again.findChild<QDockWidget*>("case_dock")->isVisible());
  EXPECT_EQ(again.findChild<QDockWidget*>("plot_dock")->width(), width);
  again.findChild<QAction*>("arrange")->trigger();
  settle(50);
  EXPECT_TRUE(again.findChild<QDockWidget*>("case_dock")->isVisible());
  QSettings settings("cleft", "explore");
  settings.remove("layout"), settings.remove("geometry");
}

TEST_F(WindowLayout, MeshesAreRecentFilesToo) {
  tell("mesh " + mesh());
  tell("close");
  auto& recent = widget<QListWidget>("recent");
  ASSERT_GE(recent.count(), 1);
  EXPECT_EQ(recent.item(0)->text().toStdString(), mesh());
  emit recent.itemActivated(recent.item(0));
  EXPECT_EQ(now().mesh, mesh());
}

TEST_F(WindowLayout, AfterACommandSpaceAndArrowsBelongToThePicture) {
  tell("open " + study());
  auto& line = widget<QLineEdit>("command_line");
  line.setFocus();
  ASSERT_EQ(QApplication::focusWidget(), &line);
  QTest::keyClicks(&line, "time 12");
  QTest::keyClick(&line, Qt::Key_Return);
  EXPECT_EQ(QApplication::focusWidget(), &window_.scene());
  QTest::keyClick(QApplication::focusWidget(), Qt::Key_Right);
  EXPECT_NEAR(now().time, 13, 1e-9);
  QTest::keyClick(QApplication::focusWidget(), Qt::Key_Space);
  EXPECT_TRUE(now().playing);
  tell("pause");
  widget<QAction>("command").trigger();
  EXPECT_EQ(QApplication::focusWidget(), &line);
  QTest::keyClicks(&line, "tme 3");
  QTest::keyClick(&line, Qt::Key_Return);
  EXPECT_EQ(QApplication::focusWidget(), &line) << "it is to be mended";
}

TEST_F(WindowLayout, TheSelectedCasesAreCompared) {
  tell("open " + study());
  auto& table = widget<QTableView>("cases");
  const auto select = [&](int row) {
    table.selectionModel()->select(table.model()->index(row, 0),
                                   QItemSelectionModel::Select | QItemSelectionModel::Rows);
  };
  tell("case 2");
  select(3);
  widget<QAction>("compare").trigger();
  EXPECT_EQ(now().compared, (std::vector{1, 3}));
}

TEST_F(WindowLayout, BetweenTheCasesNoRowIsHighlightedAndOutsideIsSaid) {
  tell("open " + study());
  auto& table = widget<QTableView>("cases");
  tell("case 2");
  EXPECT_EQ(table.selectionModel()->selectedRows().size(), 1);
  tell("set skin.prestress_v 0.04");
  for (int tries = 0; tries < 200 && !real_.between(); ++tries) settle(20);
  ASSERT_TRUE(real_.between()) << real_.why_nearest();
  EXPECT_EQ(table.selectionModel()->selectedRows().size(), 0);
  const int shown = now().shown;
  table.setCurrentIndex(table.model()->index(shown, 0));
  EXPECT_TRUE(real_.shows_exactly()) << "a click on the nearest case shows it";
  tell("set skin.prestress_v 0.09");
  settle(50);
  auto& note = widget<QLabel>("parameter_note");
  EXPECT_EQ(note.text().indexOf("Between the cases"), -1) << note.text().toStdString();
  bool told = false;
  for (const QLabel* label : of_type<ParameterPanel>().findChildren<QLabel*>())
    told = told || label->text().contains("0.09 is <b>outside</b> the study");
  EXPECT_TRUE(told);
  EXPECT_NE(real_.note_of(now().shown).find("outside the study"), std::string::npos) << "in the picture";
  EXPECT_EQ(table.selectionModel()->selectedRows().size(), 1) << "a case is shown";
}

TEST_F(WindowLayout, FindCountsFiltersAndIsClicked) {
  tell("open " + study());
  wait_for_figures();
  tell("find gape > 5 and t < 20");
  auto& table = widget<QTableView>("cases");
  EXPECT_EQ(widget<QLabel>("found").text(), "2 of 4 cases");
  EXPECT_EQ(table.model()->rowCount(), 4);
  widget<QCheckBox>("filter").click();
  ASSERT_EQ(table.model()->rowCount(), 2);
  tell("case 1");
  table.setCurrentIndex(table.model()->index(1, 0));
  EXPECT_EQ(now().shown, 3);
  EXPECT_GT(now().time, 0);
  EXPECT_LT(now().time, 20) << "where the condition holds";
  EXPECT_EQ(real_.said().back(), "found 4");
  widget<QCheckBox>("filter").click();
  EXPECT_EQ(table.model()->rowCount(), 4);
  tell("find clear");
  EXPECT_EQ(widget<QLabel>("found").text(), "");
}

TEST_F(WindowLayout, AnEmptyPlaceOrAMeshIsSaidToHaveNothingToZoomTo) {
  tell("open " + raw_study());
  settle(20);
  widget<QAction>("zoom").trigger();
  QWidget& scene = window_.scene();
  mouse(scene, QEvent::MouseButtonPress, {3, 3});
  mouse(scene, QEvent::MouseButtonRelease, {3, 3});
  EXPECT_NE(window_.message().indexOf("no skin at this place"), -1) << window_.message().toStdString();
  tell("mesh " + mesh());
  QTest::keyClick(&window_, Qt::Key_Z);
  EXPECT_NE(window_.message().indexOf("the patch that was simulated"), -1) << window_.message().toStdString();
  EXPECT_FALSE(widget<QAction>("zoom").isChecked());
}

TEST_F(WindowLayout, TheUnitOfAMeshIsAskedForWhereItsSizeIsNotThatOfMillimetres) {
  tell("open " + study());
  SurfaceMesh small = flat_plate();
  for (Vec3& x : small.points) x *= 0.05;
  const std::string file = folder_ / "decimetres.stl";
  write_mesh(file, small);
  const auto drop = [&] {
    QMimeData data;
    data.setUrls({QUrl::fromLocalFile(QString::fromStdString(file))});
    QDragEnterEvent enter({10, 10}, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(&window_, &enter);
    QDropEvent event({10, 10}, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(&window_, &event);
  };
  QTimer::singleShot(300, [] {
    auto* dialog = qobject_cast<QDialog*>(QApplication::activeModalWidget());
    ASSERT_TRUE(dialog);
    EXPECT_TRUE(dialog->findChild<QRadioButton*>("unit_dm")->isChecked()) << "guessed";
    EXPECT_NE(dialog->findChild<QRadioButton*>("unit_dm")->text().indexOf("300 mm long"), -1);
    dialog->accept();
  });
  drop();
  EXPECT_EQ(now().mesh, file);
  EXPECT_EQ(now().scale, 100);
  QTimer::singleShot(300, [] { qobject_cast<QDialog*>(QApplication::activeModalWidget())->reject(); });
  tell("close");
  drop();
  EXPECT_EQ(now().mesh, "") << "nothing was opened";
}

TEST_F(WindowLayout, TensionIsPaintedWithABrush) {
  write_study_of_prestresses(folder_ / "three");
  tell("open " + (folder_ / "three"));
  tell("mesh " + mesh());
  settle(20);
  widget<QAction>("scalpel").trigger();
  widget<QAction>("tension_brush").trigger();
  EXPECT_FALSE(widget<QAction>("scalpel").isChecked()) << "one or the other";
  drag_over(window_.scene(), 0.4, 0.5, 0.6, 0.5);
  EXPECT_TRUE(now().cuts.empty());
  ASSERT_TRUE(now().tension && now().tension->lines) << window_.message().toStdString();
  for (const TensionLine& line : *now().tension->lines)
    EXPECT_GT(std::abs(normalized(line.direction).x), 0.99);
  widget<QAction>("undo").trigger();
  EXPECT_FALSE(now().tension);
}

TEST_F(WindowLayout, ADragThatIsTooShortSaysSo) {
  tell("open " + study());
  tell("mesh " + mesh() + " 0.01");  // a plate in decimetres, read as millimetres
  settle(20);
  widget<QAction>("scalpel").trigger();
  drag_over(window_.scene(), 0.4, 0.5, 0.6, 0.5);
  EXPECT_TRUE(now().cuts.empty());
  EXPECT_NE(window_.message().indexOf("is the unit of the mesh right"), -1)
      << window_.message().toStdString() << real_.said().back();
}

TEST_F(WindowLayout, AWarningOfACutIsANumberWithItsReasonOnAClick) {
  tell("open " + study());
  tell("mesh " + mesh());
  auto& certainty = widget<QToolButton>("certainty");
  EXPECT_EQ(certainty.text(), "");
  std::string arc = "cut";
  for (int i = -8; i <= 8; ++i) {
    const double a = 0.05 * i;
    arc += " " + std::to_string(20 * std::sin(a)) + "," + std::to_string(20 * (1 - std::cos(a))) + ",0,0,0,1";
  }
  tell(arc);
  ASSERT_FALSE(real_.warnings().empty());
  EXPECT_FALSE(widget<QWidget>("message_bar").isVisible()) << "the picture keeps its place";
  EXPECT_NE(certainty.text().indexOf("expected error of the opening"), -1);
  certainty.click();
  EXPECT_NE(window_.message().indexOf("mostly uncertain because the path bends"), -1)
      << window_.message().toStdString();
  widget<QTabWidget>("plot_pages").setCurrentWidget(&widget<QWidget>("wounds"));
  settle(50);
  auto& wounds = widget<QTableWidget>("wounds");
  ASSERT_EQ(wounds.rowCount(), 1);
  EXPECT_NE(wounds.item(0, 2)->text().indexOf(QChar(0xb1)), -1) << "more or less";
  emit wounds.cellDoubleClicked(0, 0);
  EXPECT_EQ(real_.said().back(), "wound 1");
}

TEST_F(WindowLayout, TheStudyAnswersWhatAFigureDependsOnAndWhatFits) {
  tell("open " + study());
  wait_for_figures();
  auto& pages = widget<QTabWidget>("plot_pages");
  auto& plot = static_cast<AnalysisPlot&>(widget<QWidget>("analysis_plot"));
  EXPECT_FALSE(plot.analysis());
  widget<QPushButton>("analyze").click();
  ASSERT_TRUE(plot.analysis()) << window_.message().toStdString();
  EXPECT_EQ(now().analyzed, "gape");
  EXPECT_TRUE(pages.currentWidget()->isAncestorOf(&plot)) << "it comes to the front";
  settle(50);
  EXPECT_EQ(plot.analysis()->effects[0].name, "skin.prestress_v") << "2 to 5 mm";
  QTest::mouseClick(&plot, Qt::LeftButton, {}, plot.dot_of(0, 2).toPoint());
  EXPECT_EQ(now().shown, 2);
  // Around the dot of the third case, then with Shift around the first's: cases whose dots lie within 7
  // pixels.
  const auto drag_around = [&](int i, Qt::KeyboardModifiers keys) {
    const QPoint dot = plot.dot_of(0, i).toPoint();
    constexpr int reach = 7;
    QTest::mousePress(&plot, Qt::LeftButton, keys, dot + QPoint(-reach, -reach));
    for (const QPoint& corner : {QPoint(reach, -reach), QPoint(reach, reach), QPoint(-reach, reach)}) {
      QMouseEvent move(QEvent::MouseMove, dot + corner, Qt::NoButton, Qt::LeftButton, keys);
      QApplication::sendEvent(&plot, &move);
    }
    QTest::mouseRelease(&plot, Qt::LeftButton, keys, dot + QPoint(-reach, reach));
    std::set<int> around;
    for (std::size_t row = 0; row < plot.analysis()->effects.size(); ++row)
      for (int other = 0; other < 4; ++other) {
        const QPointF off = plot.dot_of(row, other) - dot;
        if (std::max(std::abs(off.x()), std::abs(off.y())) < reach) around.insert(other);
      }
    return around;
  };
  std::set<int> around = drag_around(2, {});
  EXPECT_EQ(now().selected, std::vector<int>(around.begin(), around.end()));
  ASSERT_LT(around.size(), 4u) << "the first case's dot is elsewhere";
  around.merge(drag_around(0, Qt::ShiftModifier));
  EXPECT_EQ(now().selected, std::vector<int>(around.begin(), around.end()));
  EXPECT_EQ(now().shown, 2) << "a drag shows no case";
  write_text_file(folder_ / "measured.csv", "u,gape,deviation\n0,3.5,0.1\n");
  QMimeData data;
  data.setUrls({QUrl::fromLocalFile(QString::fromStdString(folder_ / "measured.csv"))});
  QDragEnterEvent enter({10, 10}, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QApplication::sendEvent(&window_, &enter);
  QDropEvent event({10, 10}, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QApplication::sendEvent(&window_, &event);
  EXPECT_NE(window_.message().indexOf("90 % from"), -1) << window_.message().toStdString();
  EXPECT_TRUE(real_.cases().last_fit());
}

TEST_F(WindowLayout, TheHelpSheetHasTheKeyOfEveryAction) {
  QTest::keyClick(&window_, Qt::Key_F1);
  const QString text = widget<QTextBrowser>("help_text").toPlainText();
  int keys = 0;
  for (const QAction* action : window_.findChildren<QAction*>()) {
    if (action->shortcut().isEmpty()) continue;
    ++keys;
    EXPECT_NE(text.indexOf(action->shortcut().toString(QKeySequence::NativeText)), -1)
        << action->objectName().toStdString();
    EXPECT_NE(text.indexOf(QString(action->text()).remove('&').remove(" ...")), -1)
        << action->objectName().toStdString();
  }
  EXPECT_GT(keys, 20);
}

TEST_F(WindowLayout, FurtherCutsDoNotTurnAPictureThatWordsHaveAimed) {
  tell("open " + study());
  tell("mesh " + mesh());
  tell("cut -15,0.7,0,0,0,1 0,0.7,0,0,0,1 15,0.7,0,0,0,1");
  tell("camera 30 20 1.5");
  const CameraState::Pose before = window_.scene().stage().camera();
  tell("recut -10,-8,0,0.3,0,1 0,-8,0,0.3,0,1 10,-3,0,0.3,0,1");
  tell("cut 18,-8,0,0,0.2,1 18,0,0,0,0.2,1 18,8,0,0,0.2,1");
  const CameraState::Pose after = window_.scene().stage().camera();
  EXPECT_LT(norm(after.position - before.position), 1e-9);
  EXPECT_LT(norm(after.focal_point - before.focal_point), 1e-9);
}

TEST_F(WindowLayout, TheProbesCurvesAreOfOnePlaceAndHaveABand) {
  tell("open " + raw_study());
  settle(20);
  tell("probe 0.7,3.1,-0.4");
  settle(50);
  const Motion motion = real_.probed_motion();
  ASSERT_TRUE(motion.node);
  EXPECT_GT(norm(*motion.node - now().probe->uvw), 0.5);
  const auto& plots = of_type<Plots>();
  const auto field = real_.field();
  ASSERT_FALSE(plots.probed(1).x.empty());
  for (std::size_t i = 0; i < plots.probed(1).x.size(); ++i)
    EXPECT_EQ(plots.probed(1).y[i], field->displacement(*motion.node, Side::both, plots.probed(1).x[i]).y)
        << "where the dots are from";
  EXPECT_EQ(norm(real_.probed_place() - *motion.node), 0) << "and the dot in the picture";
  ASSERT_TRUE(plots.probed_error());
  EXPECT_EQ(*plots.probed_error(), field->report.spline_error * field->report.largest_displacement);
}

}  // namespace
}  // namespace cleft
