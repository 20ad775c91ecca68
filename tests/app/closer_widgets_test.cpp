// Looking closer in the window: picking points, plots, progress, messages about a study.
#include <QAction>
#include <QLabel>
#include <QProgressDialog>
#include <QPushButton>
#include <QTabWidget>
#include <QTest>
#include <QTimer>

#include "explorer/app/tornado_plot.h"
#include "tests/app/window_fixture.h"
#include "tests/session/raw_study.h"

namespace cleft {
namespace {

class CloserWindow : public WindowTest {
 protected:
  void press(double x, double y) {
    QWidget& scene = window_.scene();
    const QPointF at(scene.width() * x, scene.height() * y);
    mouse(scene, QEvent::MouseButtonPress, at);
    mouse(scene, QEvent::MouseButtonRelease, at);
    QApplication::processEvents();
  }
};

TEST_F(CloserWindow, PointsArePickedToBeProbedAndZoomedTo) {
  tell("open " + raw_study());
  tell("time 0");
  settle(20);
  QTest::keyClick(&window_, Qt::Key_P);
  EXPECT_TRUE(widget<QAction>("probe").isChecked());
  press(0.5, 0.35);
  ASSERT_TRUE(now().probe) << window_.message().toStdString();
  EXPECT_NEAR(now().probe->uvw.x, 0, 0.6) << "the middle of the picture";
  EXPECT_GT(now().probe->uvw.y, 1) << "above it";
  EXPECT_EQ(widget<QTabWidget>("plot_pages").currentIndex(), 1);
  EXPECT_NE(widget<QLabel>("probe_note").text().indexOf("simulation's node"), -1);
  widget<QAction>("zoom").trigger();
  EXPECT_FALSE(widget<QAction>("probe").isChecked());
  press(0.6, 0.5);
  ASSERT_TRUE(now().zoom) << window_.message().toStdString();
  EXPECT_NE(window_.message().indexOf("nodes of the simulation"), -1);
  QTest::keyClick(&window_, Qt::Key_Escape);
  EXPECT_FALSE(now().probe || now().zoom);
  tell("case 2");
  widget<QAction>("zoom").trigger();
  press(0.5, 0.5);
  EXPECT_NE(window_.message().indexOf("case1/case.h5"), -1) << "said in the window";
}

TEST_F(CloserWindow, PlacesAreClickedToBeMeasured) {
  tell("open " + raw_study());
  settle(20);
  QTest::keyClick(&window_, Qt::Key_M);
  EXPECT_TRUE(widget<QAction>("measure").isChecked());
  press(0.5, 0.3);
  press(0.5, 0.7);
  ASSERT_EQ(now().ruler.size(), 2u) << window_.message().toStdString();
  EXPECT_NE(window_.message().indexOf("(at rest"), -1) << window_.message().toStdString();
  EXPECT_GT(now().ruler[0].y, 1) << "above the cut";
  EXPECT_LT(now().ruler[1].y, -1);
  QTest::keyClick(&window_, Qt::Key_M);
  EXPECT_FALSE(widget<QAction>("measure").isChecked());
  EXPECT_EQ(now().ruler.size(), 2u) << "it stays";
  QTest::keyClick(&window_, Qt::Key_M);
  EXPECT_TRUE(now().ruler.empty()) << "another begins";
  press(0.5, 0.3);
  QTest::keyClick(&window_, Qt::Key_Escape);
  EXPECT_TRUE(now().ruler.empty());
  EXPECT_FALSE(widget<QAction>("measure").isChecked());
}

TEST_F(CloserWindow, TheTornadoIsThatOfTheSession) {
  tell("open " + study());
  wait_for_figures();
  widget<QTabWidget>("plot_pages").setCurrentIndex(2);
  settle(50);
  auto* plot = static_cast<TornadoPlot*>(window_.findChild<QWidget*>("tornado"));
  ASSERT_TRUE(plot->tornado());
  EXPECT_EQ(plot->tornado()->bars.size(), 2u);
  EXPECT_EQ(plot->tornado()->bars[0].parameter, "skin.prestress_v") << "2 to 5 mm";
}

TEST_F(CloserWindow, FiguresAndInterpolationAreChosen) {
  tell("open " + study());
  widget<QAction>("figure_lattice").trigger();
  EXPECT_EQ(now().figure, "lattice");
  EXPECT_TRUE(widget<QAction>("figure_lattice").isChecked());
  widget<QAction>("figure_volume").trigger();
  EXPECT_EQ(now().figure, "lattice") << "there is no mesh";
  widget<QAction>("figure_off").trigger();
  EXPECT_EQ(now().figure, "");
  EXPECT_TRUE(widget<QAction>("between").isChecked());
  widget<QAction>("between").trigger();
  EXPECT_FALSE(now().between);
}

TEST_F(CloserWindow, WhatTakesLongShowsProgressAndIsCancelled) {
  tell("open " + study());
  tell("speed 0.5");
  bool shown = false;
  QTimer watch;
  QObject::connect(&watch, &QTimer::timeout, [&] {
    if (auto* dialog = window_.findChild<QProgressDialog*>("progress"); dialog && dialog->isVisible())
      shown = true, dialog->findChild<QPushButton*>()->click();
  });
  watch.start(20);
  const std::string before = state_to_json(now());
  EXPECT_FALSE(window_.say("movie " + folder_ / "long.ogv 64 36 100"));
  EXPECT_TRUE(shown);
  EXPECT_NE(window_.message().indexOf("cancelled"), -1) << window_.message().toStdString();
  EXPECT_EQ(state_to_json(now()), before);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "long.ogv"));
  EXPECT_EQ(window_.findChild<QProgressDialog*>("progress"), nullptr);
}

TEST_F(CloserWindow, ASlowPictureIsCoarseWhileItIsTurned) {
  tell("open " + study());
  settle(20);
  SceneWidget& scene = window_.scene();
  const auto press_and_move = [&] {
    mouse(scene, QEvent::MouseButtonPress, {100, 100});
    mouse(scene, QEvent::MouseMove, {120, 110});
  };
  scene.set_slowest(1000);
  press_and_move();
  EXPECT_FALSE(scene.coarse());
  mouse(scene, QEvent::MouseButtonRelease, {120, 110});
  scene.set_slowest(0);
  const int width = scene.renderWindow()->GetSize()[0];
  press_and_move();
  EXPECT_TRUE(scene.coarse());
  EXPECT_EQ(scene.renderWindow()->GetSize()[0], width) << "the window's size stays";
  if (const char* file = std::getenv("COARSE_PICTURE")) window_.grab().save(file);
  mouse(scene, QEvent::MouseButtonRelease, {120, 110});
  EXPECT_FALSE(scene.coarse());
  EXPECT_EQ(scene.renderWindow()->GetSize()[0], width);
}

/// The largest difference of a colour in a part of two pictures, of 255, and the sum of all over their
/// number.
std::pair<int, double> differences(const QImage& a, const QImage& b, const QRect& part) {
  int most = 0;
  double sum = 0;
  for (int y = part.top(); y <= part.bottom(); ++y)
    for (int x = part.left(); x <= part.right(); ++x) {
      const QRgb p = a.pixel(x, y), q = b.pixel(x, y);
      for (const int d : {qRed(p) - qRed(q), qGreen(p) - qGreen(q), qBlue(p) - qBlue(q)})
        most = std::max(most, std::abs(d)), sum += std::abs(d);
    }
  return {most, sum / (3. * part.width() * part.height())};
}

TEST_F(CloserWindow, LabelsOfACoarsePictureAreWhole) {
  tell("open " + study());
  tell("camera 0 -60 0.5");  // the patch is far from the labels
  settle(400);
  SceneWidget& scene = window_.scene();
  const auto picture = [&] {
    scene.renderWindow()->Render();
    return scene.grabFramebuffer().convertToFormat(QImage::Format_RGB888);
  };
  scene.set_slowest(1000);
  const QImage whole = picture();
  scene.set_slowest(0);
  for (const int value : {1000, 1500, 2000}) widget<QSlider>("time").setValue(value);
  tell("end");
  ASSERT_TRUE(scene.coarse());
  const QImage coarse = picture();
  ASSERT_EQ(coarse.size(), whole.size());
  const QRect title(0, 0, 300, 40), ruler(whole.width() - 250, whole.height() - 60, 250, 60);
  for (const QRect& part : {title, ruler}) {
    const auto [most, mean] = differences(whole, coarse, part);
    EXPECT_LT(most, 8) << "of 255: the background is stretched, the letters are not";
    EXPECT_GT(differences(whole, QImage(whole.scaled(whole.size() / 2)).scaled(whole.size()), part).first, 60)
        << "letters at half the resolution would be seen";
  }
  EXPECT_GT(differences(whole, coarse, whole.rect()).first, 20) << "edges of the patch are coarse";
  EXPECT_LT(differences(whole, coarse, whole.rect()).second, 2) << "and where they are in the whole picture";
  settle(600);
  EXPECT_FALSE(scene.coarse());
  EXPECT_EQ(differences(whole, picture(), whole.rect()).first, 0) << "and all is as before";
  for (const char* line : {"time 3", "compare 1 2 3", "time 5", "single", "time 9"}) window_.say(line);
  EXPECT_TRUE(scene.coarse()) << "views come and go while it is";
}

TEST_F(CloserWindow, ASlowPictureIsCoarseWhileTimeIsDraggedAndWholeWhenItRests) {
  tell("open " + study());
  settle(400);
  SceneWidget& scene = window_.scene();
  vtkRenderer* renderer = scene.stage().view(0).renderer();
  const auto drag = [&] {
    for (const int value : {1000, 1500, 2000}) widget<QSlider>("time").setValue(value);
  };
  scene.set_slowest(1000);
  drag();
  EXPECT_FALSE(scene.coarse());
  EXPECT_TRUE(renderer->GetUseFXAA());
  scene.set_slowest(0);
  drag();
  EXPECT_TRUE(scene.coarse());
  EXPECT_FALSE(renderer->GetUseFXAA());
  settle(600);
  EXPECT_FALSE(scene.coarse());
  EXPECT_TRUE(renderer->GetUseFXAA());
  tell("time 3");
  EXPECT_FALSE(scene.coarse()) << "a picture alone is no motion";
}

}  // namespace
}  // namespace cleft
