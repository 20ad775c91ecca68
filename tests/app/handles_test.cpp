// The handles of a cut, dragged with a mouse over the picture.
#include <QAction>
#include <QTabWidget>
#include <QTableWidget>
#include <QTest>
#include <cmath>

#include "tests/app/window_fixture.h"

namespace cleft {
namespace {

class Handles : public WindowTest {
 protected:
  Handles() {
    tell("open " + study());
    tell("mesh " + mesh());
    tell("cut -15,0.7,0,0,0,1 0,0.7,0,0,0,1 15,0.7,0,0,0,1 depth 4");
    tell("cut -10,12,0,0,0,1 10,12,0,0,0,1 depth 2");
    tell("time 0");  // the skin lies where it is at rest
    tell("camera 0 0");
    tell("handles 1");
    window_.scene().set_slowest(1000);  // on a busy machine, too, a pixel is a pixel
    settle(50);
  }
  /// Where a place in space is in the widget.
  QPointF at(const Vec3& x) {
    vtkRenderer* renderer = window_.scene().stage().view(0).renderer();
    renderer->SetWorldPoint(x.x, x.y, x.z, 1);
    renderer->WorldToDisplay();
    const double* shown = renderer->GetDisplayPoint();
    const double ratio = window_.scene().devicePixelRatioF();
    return {shown[0] / ratio, window_.scene().height() - 1 - shown[1] / ratio};
  }
  double mm_a_pixel() { return 10 / QLineF(at({}), at({10, 0, 0})).length(); }
  void hold(const QPointF& from, const QPointF& to) {
    QWidget& scene = window_.scene();
    mouse(scene, QEvent::MouseButtonPress, from);
    for (int i = 1; i <= 5; ++i) {
      mouse(scene, QEvent::MouseMove, from + i / 5. * (to - from));
      QApplication::processEvents();
    }
  }
  void drag(const QPointF& from, const QPointF& to) {
    hold(from, to);
    mouse(window_.scene(), QEvent::MouseButtonRelease, to);
    settle(20);
  }
  const CutState& first() const { return now().cuts[0]; }
};

TEST_F(Handles, APointIsDraggedOverTheSkinInOneStepOfUndo) {
  const std::string before = cut_line("cut", first());
  const std::size_t lines = real_.said().size();
  const Vec3 to{2, -6, 0};
  hold(at({0, 0.7, 0}), at(to));
  EXPECT_EQ(cut_line("cut", first()), before) << "while it is dragged only a line is drawn";
  EXPECT_NEAR(real_.overlay().handles[1].place.y, -6, 2 * mm_a_pixel());
  if (const char* file = std::getenv("HANDLES_PICTURE")) window_.grab().save(file);
  mouse(window_.scene(), QEvent::MouseButtonRelease, at(to));
  ASSERT_EQ(now().cuts.size(), 2u) << window_.message().toStdString();
  EXPECT_NEAR(first().points[1].position.x, 2, 2 * mm_a_pixel());
  EXPECT_NEAR(first().points[1].position.y, -6, 2 * mm_a_pixel());
  EXPECT_NEAR(first().points[1].position.z, 0, 1e-3) << "on the skin";
  EXPECT_EQ(first().points[0].position, (Vec3{-15, 0.7, 0}));
  ASSERT_EQ(real_.said().size(), lines + 2);
  EXPECT_TRUE(real_.said()[lines].starts_with("look ")) << "the picture does not turn under the hand";
  EXPECT_TRUE(real_.said()[lines + 1].starts_with("edit-cut 1 point 2 ")) << real_.said().back();
  QTest::keyClick(&window_, Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(cut_line("cut", first()), before);
  EXPECT_EQ(now().cuts.size(), 2u);
}

TEST_F(Handles, DepthGoesWithTheMousesHeightFromTheFrontAndAlongTheBladeFromTheSide) {
  const double pixels = 60;
  const Vec3 handle = real_.handles()->depth_handle();
  drag(at(handle), at(handle) + QPointF(0, pixels));
  EXPECT_NEAR(first().points[1].depth, 4 + pixels * mm_a_pixel(), 0.5) << "60 pixels down";
  tell("edit-cut 1 depth 4");
  tell("look 0,-150,20 0,0,0 0,0,1");
  settle(20);
  drag(at(real_.handles()->depth_handle()), at(real_.handles()->depth.foot - Vec3{0, 0, 7}));
  EXPECT_NEAR(first().points[1].depth, 7, 0.3) << window_.message().toStdString();
}

TEST_F(Handles, TheBladeIsTilted) {
  tell("look -150,0,20 0,0,0 0,0,1");  // along the cut
  settle(20);
  const CutHandles handles = *real_.handles();
  const double lever = handles.lever, tilt = 30 * M_PI / 180;
  drag(at(handles.tilt_handle()), at(handles.tilt.foot + lever * Vec3{0, -std::sin(tilt), std::cos(tilt)}));
  const Vec3& outward = first().points[1].outward;
  EXPECT_NEAR(std::atan2(-outward.y, outward.z) * 180 / M_PI, 30, 2) << window_.message().toStdString();
  EXPECT_NEAR(real_.handles()->tilt.tilt, 30, 2);
}

TEST_F(Handles, WhatCannotBeCutIsToldAndTheOldCutStays) {
  const std::string before = cut_line("cut", first());
  // Both ends and the middle in one place are no path: what the mouse leads to is not taken.
  tell("edit-cut 2 point 1 0,12,0 point 2 3,12,0");
  tell("handles 2");
  settle(20);
  const std::string second = cut_line("cut", now().cuts[1]);
  EXPECT_FALSE(window_.say("edit-cut 2 point 1 3,12,0"));
  EXPECT_NE(window_.message().indexOf("2 different points"), -1) << window_.message().toStdString();
  EXPECT_EQ(cut_line("cut", now().cuts[1]), second);
  EXPECT_EQ(cut_line("cut", first()), before);
  // Beside the plate there is no skin: the last place on it counts.
  tell("handles 1");
  settle(20);
  drag(at({15, 0.7, 0}), at({80, 0.7, 0}));
  EXPECT_LE(first().points[2].position.x, 30 + 1e-6);
  EXPECT_GT(first().points[2].position.x, 16);
}

TEST_F(Handles, ACutIsChosenInThePictureInTheTableAndByItsKey) {
  const QPointF place = at({5, 12, 0});
  mouse(window_.scene(), QEvent::MouseButtonPress, place);
  mouse(window_.scene(), QEvent::MouseButtonRelease, place);
  EXPECT_EQ(now().handled, 1);
  widget<QTabWidget>("plot_pages").setCurrentIndex(3);
  settle(300);
  auto& table = widget<QTableWidget>("wounds");
  ASSERT_EQ(table.rowCount(), 2);
  EXPECT_EQ(table.selectionModel()->selectedRows().front().row(), 1);
  QTest::mouseClick(table.viewport(), Qt::LeftButton, {}, table.visualItemRect(table.item(0, 0)).center());
  EXPECT_EQ(now().handled, 0);
  EXPECT_TRUE(widget<QAction>("handles").isChecked());
  QTest::keyClick(&window_, Qt::Key_H);
  EXPECT_EQ(now().handled, -1);
  QTest::keyClick(&window_, Qt::Key_H);
  EXPECT_EQ(now().handled, 1) << "the last";
  tell("patch");
  EXPECT_FALSE(widget<QAction>("handles").isEnabled());
}

TEST_F(Handles, TheTableOfWoundsHasNoExponents) {
  tell("set skin.prestress_v 0.05");
  tell("undo"), tell("undo");
  tell("cut -28,0.7,0,0,0,1 0,0.7,0,0,0,1 28,0.7,0,0,0,1 depth 25");
  ASSERT_GT(real_.scene()->wound_figures(now().time).front().volume, 1000);
  widget<QTabWidget>("plot_pages").setCurrentIndex(3);
  settle(300);
  const QString volume = widget<QTableWidget>("wounds").item(0, 4)->text();
  EXPECT_EQ(volume.indexOf("e"), -1) << volume.toStdString();
}

TEST_F(Handles, APressBesideAHandleTurnsThePictureAndChangesNoCut) {
  const std::string before = cut_line("cut", first());
  drag(at({-5, -15, 0}), at({5, -12, 0}));
  EXPECT_EQ(cut_line("cut", first()), before);
  EXPECT_TRUE(now().camera.pose);
  drag(at({0, 0.7, 0}), at({0, 0.7, 0}));
  tell("time 10");
  EXPECT_EQ(first().points.size(), 3u);
}

}  // namespace
}  // namespace cleft
