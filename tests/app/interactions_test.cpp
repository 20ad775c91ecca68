// Recorded interactions, done twice in one window: both times the picture is the same byte for byte, and it
// is that of tests/app/interactions, to within what another version of the software renderer may round
// otherwise. To draw those anew, after looking at them: INTERACTIONS=renew app_test
// --gtest_filter='Interactions.*'
#include <QAction>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QImage>
#include <QLineEdit>
#include <QSlider>
#include <QTest>
#include <QToolButton>
#include <QWheelEvent>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>

#include "explorer/session/command_table.h"
#include "tests/app/window_fixture.h"

namespace cleft {
namespace {

struct Interaction {
  std::string name;
  std::vector<std::string> lines;
};

std::vector<Interaction> recorded() {
  std::vector<Interaction> all;
  std::ifstream file(INTERACTIONS_FOLDER ".txt");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("== "))
      all.push_back({line.substr(3), {}});
    else if (!line.empty() && line[0] != '#' && !all.empty())
      all.back().lines.push_back(line);
  }
  return all;
}

class Interactions : public WindowTest {
 protected:
  Interactions() {
    window_.resize(640, 360);
    window_.scene().setFixedSize(508, 490);  // pictures do not depend on the panels beside them
    window_.scene().set_slowest(1e9);        // a slow machine turns pictures by whole pixels too
    for (const char* dock : {"case_dock", "plot_dock", "line_dock"}) widget<QWidget>(dock).hide();
    settle(20);
  }

  void begin() {
    widget<QAction>("scalpel").setChecked(false);
    window_.scene().set_cutting(false);
    window_.scene().set_picking("");
    widget<QDoubleSpinBox>("depth").setValue(0);
    widget<QDoubleSpinBox>("tilt").setValue(0);
    tell("close");
    tell("open " + study());
    tell("between off");  // no picture of a moment in which cases are still being read
    tell("time 12");
  }

  void act(const std::string& line) {
    const std::vector<std::string> w = split_line(line);
    QWidget& scene = window_.scene();
    const auto at = [&](std::size_t k) {
      return QPointF(scene.width() * std::stod(w.at(k)), scene.height() * std::stod(w.at(k + 1)));
    };
    const auto named = [&](std::size_t k) { return w.at(k).c_str(); };
    if (w[0] == "drag") {
      drag_over(scene, std::stod(w.at(1)), std::stod(w.at(2)), std::stod(w.at(3)), std::stod(w.at(4)), 5);
    } else if (w[0] == "press") {
      mouse(scene, QEvent::MouseButtonPress, at(1));
      mouse(scene, QEvent::MouseButtonRelease, at(1));
    } else if (w[0] == "wheel") {
      const int steps = std::stoi(w.at(1));
      const QPointF middle(scene.width() / 2., scene.height() / 2.);
      for (int k = 0; k < std::abs(steps); ++k) {
        QWheelEvent event(middle, scene.mapToGlobal(middle.toPoint()), {}, {0, steps > 0 ? 120 : -120},
                          Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase, false);
        QApplication::sendEvent(&scene, &event);
      }
    } else if (w[0] == "key") {
      const QKeySequence key(QString::fromStdString(w.at(1)));
      QTest::keyClick(&window_, static_cast<Qt::Key>(key[0] & ~Qt::KeyboardModifierMask),
                      Qt::KeyboardModifiers(key[0] & Qt::KeyboardModifierMask));
    } else if (w[0] == "click") {
      if (auto* action = window_.findChild<QAction*>(named(1)))
        action->trigger();
      else
        QTest::mouseClick(&widget<QToolButton>(named(1)), Qt::LeftButton);
    } else if (w[0] == "slide") {
      widget<QSlider>(named(1)).setValue(std::stoi(w.at(2)));
    } else if (w[0] == "spin") {
      widget<QDoubleSpinBox>(named(1)).setValue(std::stod(w.at(2)));
    } else if (w[0] == "choose") {
      auto& box = widget<QComboBox>(named(1));
      box.setCurrentIndex(box.findText(QString::fromStdString(w.at(2))));
      emit box.activated(box.currentIndex());
    } else if (w[0] == "type") {
      auto& edit = widget<QLineEdit>(named(1));
      edit.setText(QString::fromStdString(w.at(2)));
      QTest::keyClick(&edit, Qt::Key_Return);
    } else {
      std::string said = line;
      if (const std::size_t place = said.find("MESH"); place != std::string::npos)
        said.replace(place, 4, mesh());
      window_.say(said);
    }
    QApplication::processEvents();
  }

  QImage picture(const Interaction& interaction) {
    begin();
    for (const std::string& line : interaction.lines) act(line);
    window_.scene().rest();
    EXPECT_FALSE(window_.scene().coarse()) << interaction.name << ": the last picture is a whole one";
    window_.scene().renderWindow()->Render();
    return window_.scene().grabFramebuffer().convertToFormat(QImage::Format_RGB888);
  }

  /// Mean absolute difference of colours, of 255.
  static double difference(const QImage& a, const QImage& b) {
    if (a.size() != b.size()) return 255;
    double sum = 0;
    for (int y = 0; y < a.height(); ++y)
      for (int x = 0; x < 3 * a.width(); ++x) sum += std::abs(int(a.scanLine(y)[x]) - int(b.scanLine(y)[x]));
    return sum / (3. * a.width() * a.height());
  }
};

TEST_F(Interactions, LeadToTheSamePictures) {
  const std::vector<Interaction> all = recorded();
  ASSERT_GE(all.size(), 30u);
  const bool renew = std::getenv("INTERACTIONS") && std::string(std::getenv("INTERACTIONS")) == "renew";
  picture(all.front());  // a window that has just been opened still arranges itself
  std::map<std::string, QImage> first;
  for (const Interaction& one : all) first[one.name] = picture(one);
  for (std::size_t i = 0; i < all.size(); i += 3)  // a third of them again: all take too long
    EXPECT_TRUE(picture(all[i]) == first[all[i].name]) << all[i].name << ": another picture the second time";
  for (const Interaction& one : all) {
    const QImage& before = first[one.name];
    const QString file = QString(INTERACTIONS_FOLDER) + "/" + QString::fromStdString(one.name) + ".png";
    const QImage small = before.scaledToWidth(200, Qt::SmoothTransformation);
    if (renew) {
      small.save(file, "PNG", 0);
      continue;
    }
    const QImage kept = QImage(file).convertToFormat(QImage::Format_RGB888);
    if (kept.isNull()) {
      std::cout << one.name << ": no picture is kept to compare with\n";
      continue;
    }
    // Another scene, colour or camera differs by 1 and more; a renderer that rounds otherwise by less than
    // 0.2.
    EXPECT_LT(difference(small.convertToFormat(QImage::Format_RGB888), kept), 0.5) << one.name;
  }
}

}  // namespace
}  // namespace cleft
