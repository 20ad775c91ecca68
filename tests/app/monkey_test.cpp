// Random actions of a user with a seed: nothing crashes, and the recording leads to the same state. More of
// them: app_test --actions 1000 --seed 7 --gtest_filter='Monkey.*' (or MONKEY and MONKEY_SEED).
#include <QAbstractButton>
#include <QAction>
#include <QScrollBar>
#include <QSlider>
#include <QTest>
#include <cstdlib>
#include <iostream>
#include <random>
#include <set>

#include "base/stopwatch.h"
#include "tests/app/window_fixture.h"
#include "tests/session/raw_study.h"

namespace cleft {
namespace {

class Monkey : public WindowTest {
 protected:
  static int number_of(const char* name, int otherwise) {
    const char* text = std::getenv(name);
    return text ? std::atoi(text) : otherwise;
  }
  std::size_t below(std::size_t count) {
    return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_);
  }
  double part() { return std::uniform_real_distribution<double>(0.02, 0.98)(random_); }
  std::string whole(int most) { return std::to_string(below(static_cast<std::size_t>(most)) + 1); }
  std::string number(double from, double to) { return std::to_string(from + (to - from) * part()); }

  /// Some are wrong, as a user's are.
  std::string line() {
    const std::vector<std::string> lines{
        "open " + study(),
        "open " + raw_study(),
        "mesh " + mesh(),
        "mesh " + mesh() + " " + number(0.01, 3),
        "patch",
        "close",
        "case " + whole(5),
        "set skin.prestress_v " + number(0.01, 0.07),
        "set tissue.young_modulus " + number(0.005, 0.05),
        "compare " + whole(4) + " " + whole(4),
        "find gape > " + number(0, 6) + " and t < " + number(0, 40),
        "found " + whole(4),
        "filter on",
        "select " + whole(4) + " " + whole(4),
        "sort gape down",
        "wall on",
        "find clear",
        "brush gape " + number(0, 3) + " " + number(3, 6),
        "brush clear",
        "cut -12," + number(-9, 9) + ",0,0,0,1 12," + number(-9, 9) + ",0,0,0,1",
        "recut -8,1,0,0,0,1 9," + number(-9, 9) + ",0,0,0,1 depth 2",
        "edit-cut 1 point 1 " + number(-20, 20) + "," + number(-15, 15) + ",0 reach " + number(0, 9),
        "edit-cut " + whole(2) + " depth " + number(0.5, 6) + " tilt " + number(-40, 40),
        "handles " + whole(2),
        "undo",
        "undo any",
        "redo any",
        "time " + number(0, 40),
        "color strain",
        "color gape",
        "color error",
        "difference " + whole(4),
        "probe " + number(-20, 20) + "," + number(-15, 15) + ",0",
        "zoom " + number(-20, 20) + "," + number(-15, 15) + ",0",
        "camera " + number(-60, 60) + " " + number(-60, 60) + " " + number(0.5, 3),
        "wound " + whole(2),
        "wounds",
        "detail 0.5px",
        "tornado",
        "tme 3"};
    return lines[below(lines.size())];
  }

  void trigger() {
    // Those that ask for a file, take long, or end the window.
    static const std::set<std::string> left_out{
        "open",    "open_mesh",   "open_path", "save", "load",     "screenshot", "screenshot_transparent",
        "movie",   "export",      "record",    "quit", "simulate", "fit",        "propose",
        "analyze", "copy_message"};
    QList<QAction*> actions;
    for (QAction* action : window_.findChildren<QAction*>()) {
      const std::string name = action->objectName().toStdString();
      if (action->isEnabled() && !name.empty() && left_out.count(name) == 0 && !name.starts_with("device_"))
        actions << action;
    }
    QAction* action = actions[static_cast<int>(below(static_cast<std::size_t>(actions.size())))];
    done_ = "the action " + action->objectName().toStdString();
    action->trigger();
  }

  void slide() {
    const QList<QSlider*> sliders = window_.findChildren<QSlider*>();
    QSlider* slider = sliders[static_cast<int>(below(static_cast<std::size_t>(sliders.size())))];
    done_ = "the slider " + slider->objectName().toStdString();
    if (slider->isEnabled()) slider->setValue(static_cast<int>(part() * slider->maximum()));
  }

  /// Of a cut's handles, where some are drawn.
  bool drag_handle() {
    const Overlay overlay = real_.overlay();
    if (overlay.handles.empty() || window_.scene().stage().views() != 1) return false;
    const Vec3& place = overlay.handles[below(overlay.handles.size())].place;
    vtkRenderer* renderer = window_.scene().stage().view(0).renderer();
    renderer->SetWorldPoint(place.x, place.y, place.z, 1);
    renderer->WorldToDisplay();
    const double* at = renderer->GetDisplayPoint();
    const double ratio = window_.scene().devicePixelRatioF();
    const double x = at[0] / ratio / window_.scene().width(),
                 y = 1 - at[1] / ratio / window_.scene().height();
    drag_over(window_.scene(), x, y, x + 0.2 * (part() - 0.5), y + 0.2 * (part() - 0.5), 6);
    return true;
  }

  void press_key() {
    constexpr Qt::Key keys[] = {Qt::Key_Space,    Qt::Key_Left,   Qt::Key_Right, Qt::Key_PageUp,
                                Qt::Key_PageDown, Qt::Key_Escape, Qt::Key_P,     Qt::Key_Z,
                                Qt::Key_C,        Qt::Key_T,      Qt::Key_1,     Qt::Key_4,
                                Qt::Key_Home,     Qt::Key_H,      Qt::Key_E,     Qt::Key_M};
    const Qt::Key key = keys[below(std::size(keys))];
    done_ = "the key " + QKeySequence(key).toString().toStdString();
    QTest::keyClick(&window_, key);
  }

  void act() {
    switch (below(6)) {
      case 0:
        return trigger();
      case 1:
        return slide();
      case 2:
        return press_key();
      case 3:
        done_ = "a drag";
        return below(3) == 0 && drag_handle() ? void()
                                              : drag_over(window_.scene(), part(), part(), part(), part(), 6);
      default:
        window_.say(done_ = line());
    }
  }

  std::string done_;  // the present action, in words
  std::mt19937 random_{static_cast<unsigned>(number_of("MONKEY_SEED", 1))};
};

TEST_F(Monkey, RandomActionsLeadWhereTheirRecordingLeads) {
  const int count = number_of("MONKEY", 120);
  tell("open " + study());
  double slowest = 0;
  std::string slowest_action;
  for (int k = 0; k < count; ++k) {
    const Stopwatch watch;
    done_.clear();
    act();
    QApplication::processEvents();
    if (watch.seconds() > slowest) slowest = watch.seconds(), slowest_action = done_;
    // The machine may be busy; a second without a sign of progress is what a user takes for a hang.
    if (watch.seconds() > 1)
      std::cout << "action " << k << ", " << done_ << ": " << watch.seconds() << " s\n";
  }
  std::cout << count << " actions, the slowest (" << slowest_action << ") took " << slowest << " s, "
            << real_.said().size() << " lines were recorded\n";
  for (int tries = 0; tries < 200 && real_.preparing(); ++tries) settle(20);
  tell("pause");
  if (real_.has_scene()) tell("time 7");  // no time that a clock has chosen
  tell("record " + folder_ / "monkey.txt");
  const std::string by_monkey = state_to_json(now());
  Session again(session_services([](const std::string&) {}));
  again.run_script(folder_ / "monkey.txt");
  EXPECT_EQ(state_to_json(again.state()), by_monkey);
  Session loaded(session_services([](const std::string&) {}));
  tell("save " + folder_ / "monkey.json");
  loaded.say("load " + folder_ / "monkey.json");
  EXPECT_EQ(state_to_json(loaded.state()), by_monkey);
}

}  // namespace
}  // namespace cleft
