// What the explorer's window costs: xvfb-run cleft-benchmark-explorer STUDY [MESH PATH.csv]
// Of a study: the first picture; from a slider to the picture of what lies between the cases; brushing. Of a
// mesh with a cut: pictures of the wound while it opens, processor and wall time. 1280 x 720.
#include <QApplication>
#include <QSlider>
#include <QStyleFactory>
#include <QSurfaceFormat>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>

#include "base/quantiles.h"
#include "base/stopwatch.h"
#include "base/text.h"
#include "explorer/app/main_window.h"
#include "explorer/scene/session/command_table.h"
#include "explorer/view/picture.h"

using namespace cleft;

namespace {

/// Wall and processor milliseconds of each call: median, 95th percentile, most.
void time_calls(const char* what, int count, const std::function<void(int)>& call) {
  std::vector<double> wall, cpu;
  for (int i = 0; i < count; ++i) {
    Stopwatch watch;
    const std::clock_t begin = std::clock();
    call(i);
    QApplication::processEvents();
    wall.push_back(1e3 * watch.seconds());
    cpu.push_back(1e3 * double(std::clock() - begin) / CLOCKS_PER_SEC);
  }
  std::printf("%-34s wall %6.1f %6.1f %6.1f ms   processor %6.1f %6.1f %6.1f ms (median, p95, most)\n", what,
              median(wall), quantile(wall, 0.95), quantile(wall, 1), median(cpu), quantile(cpu, 0.95),
              quantile(cpu, 1));
}

/// Until every case's figures are known and nothing is being read.
void settle(Session& session) {
  const auto busy = [&] {
    if (session.preparing()) return true;
    for (int i = 0; i < session.study()->size(); ++i)
      if (!session.knows_figures(i)) return true;
    return false;
  };
  while (busy()) QApplication::processEvents(QEventLoop::AllEvents, 50);
  for (int i = 0; i < 20; ++i) QApplication::processEvents(QEventLoop::AllEvents, 20);
}

/// Says a line, and ends the program where it cannot be done.
void say(MainWindow& window, const std::string& line) {
  if (window.say(line)) return;
  std::fprintf(stderr, "%s: %s\n", line.c_str(), window.message().toUtf8().constData());
  std::exit(1);
}

void study(MainWindow& window, Session& session, const std::string& path) {
  Stopwatch watch;
  say(window, "open " + quoted(path));
  QApplication::processEvents();
  std::printf("%d cases: first picture after %.0f ms", session.study()->size(), 1e3 * watch.seconds());
  settle(session);
  std::printf(", all figures after %.1f s\n", watch.seconds());
  if (session.study()->varying().empty()) return;
  for (const std::string& name : session.study()->varying()) {
    auto* slider = window.findChild<QSlider*>(QString::fromStdString(name));
    if (!slider) continue;
    watch = Stopwatch();
    slider->setValue(501);
    settle(session);
    std::printf("%s: first between cases after %.1f s\n", name.c_str(), watch.seconds());
    time_calls("a slider to the picture", 100, [&](int i) { slider->setValue(505 + 3 * i); });
    break;
  }
  const std::string name = session.study()->varying().front();
  double least = HUGE_VAL, greatest = -HUGE_VAL;
  for (int i = 0; i < session.study()->size(); ++i) {
    least = std::min(least, session.column_value(i, name));
    greatest = std::max(greatest, session.column_value(i, name));
  }
  time_calls("brushing", 60, [&](int i) {
    say(window,
        "brush " + name + " " + shortest(least) + " " + shortest(least + (greatest - least) * (i + 1) / 60));
  });
  say(window, "brush clear");
}

void mesh(MainWindow& window, Session& session, const std::string& file, const std::string& path) {
  say(window, "mesh " + quoted(file));
  say(window, "cut-file " + quoted(path));
  settle(session);
  const double end = session.duration();
  std::printf("mesh of %zu triangles, a cut of %.0f mm\n", session.scene()->surface().triangles.size(), end);
  const auto open_it = [&](int i) { say(window, "time " + shortest(end * (i + 1) / 100)); };
  window.scene().set_slowest(HUGE_VAL);
  time_calls("the wound opens: whole pictures", 100, open_it);
  window.scene().set_slowest(0.066);
  time_calls(" as they are while time runs", 100, open_it);
  std::printf("%36s%s\n", "", window.scene().coarse() ? "at half the resolution" : "at the whole resolution");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2 && argc != 4) return std::fprintf(stderr, "cleft-benchmark-explorer STUDY [MESH PATH]\n"), 2;
  QSurfaceFormat format = QVTKOpenGLNativeWidget::defaultFormat();
  format.setSamples(0);
  QSurfaceFormat::setDefaultFormat(format);
  QApplication application(argc, argv);
  QApplication::setStyle(QStyleFactory::create("Fusion"));
  Session session(session_services([](const std::string&) {}));
  MainWindow window(session);
  window.resize(1280, 720);
  window.show();
  QApplication::processEvents();
  study(window, session, argv[1]);
  if (argc == 4) mesh(window, session, argv[2], argv[3]);
  return 0;
}
