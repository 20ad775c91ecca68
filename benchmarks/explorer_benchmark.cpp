// What the explorer's window costs: xvfb-run cleft-benchmark-explorer STUDY [MESH PATH.csv [MM_PER_UNIT]]
// Of a study: the first picture; from a slider to the picture of a field between the cases; brushing. Of a
// mesh with a cut: pictures of the wound while it opens, processor and wall time. 1280 x 720. And the same at
// levels of detail, from afar and near, in a picture of 1280 x 720.
#include <QApplication>
#include <QDockWidget>
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
#include "explorer/session/command_table.h"
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

/// Of what is left at rest, the largest way in the picture that it would go, pixels.
double measured(SceneWidget& scene, const WoundScene& whole, const WoundScene& some) {
  vtkRenderer* renderer = scene.stage().view(0).renderer();
  const auto pixel = [&](const Vec3& x) {
    renderer->SetWorldPoint(x.x, x.y, x.z, 1);
    renderer->WorldToDisplay();
    return std::pair{renderer->GetDisplayPoint()[0], renderer->GetDisplayPoint()[1]};
  };
  const std::vector<Vec3>& rest = whole.surface().points;
  const std::vector<bool> moving = some.moving();
  std::vector<Vec3> x;
  double worst = 0;
  for (int i = 0; i <= 50; ++i) {
    whole.positions(whole.duration() * i / 50, x);
    for (std::size_t v = 0; v < rest.size(); ++v) {
      if (moving[v] || x[v] == rest[v]) continue;
      const auto [a, b] = pixel(rest[v]);
      const auto [c, d] = pixel(x[v]);
      if (renderer->IsInViewport(static_cast<int>(a), static_cast<int>(b)))
        worst = std::max(worst, std::hypot(c - a, d - b));
    }
  }
  return worst;
}

/// Microseconds of a frame's positions, the median.
double frame_us(const WoundScene& scene) {
  std::vector<Vec3> x;
  std::vector<double> us;
  for (int i = 0; i < 1000; ++i) {
    Stopwatch watch;
    scene.positions(scene.duration() * (i % 100 + 1) / 100, x);
    us.push_back(1e6 * watch.seconds());
  }
  return median(us);
}

void details(MainWindow& window, Session& session, const std::function<void(int)>& open_it) {
  window.scene().set_slowest(HUGE_VAL);
  window.scene().rest();
  for (const char* detail : {"off", "0.1px", "0.25px", "0.5px", "1px"}) {
    const Stopwatch watch;
    say(window, std::string("detail ") + detail);
    const double ms = 1e3 * watch.seconds();
    const auto whole = session.scene();
    if (const auto& seen = session.seen()) {
      const auto some = whole->with_detail(seen->left_out.error);
      std::printf(
          "detail %s: %zu of %zu at rest, off by %.3f mm and %.3f pixels at most, measured %.3f; "
          "first picture after %.1f ms, positions in %.1f us\n",
          detail, seen->left_out.vertices, seen->left_out.of, seen->left_out.error, seen->pixels,
          measured(window.scene(), *whole, *some), ms, frame_us(*some));
    } else {
      std::printf("detail off: positions in %.1f us\n", frame_us(*whole));
    }
    time_calls(" whole pictures", 20, [&](int i) { open_it(5 * i + 4); });
  }
}

void shadings(MainWindow& window, const std::function<void(int)>& open_it) {
  window.scene().set_slowest(HUGE_VAL);
  window.scene().rest();
  for (const char* shading : {"plain", "skin", "plain", "skin"}) {
    const Stopwatch watch;
    say(window, std::string("shading ") + shading);
    QApplication::processEvents();
    std::printf("shading %s: first picture after %.0f ms\n", shading, 1e3 * watch.seconds());
    time_calls(" the wound opens: whole pictures", 40, open_it);
    window.scene().set_slowest(0);
    time_calls(" scenes at half the resolution", 40, open_it);
    window.scene().set_slowest(HUGE_VAL);
    window.scene().rest();
  }
}

void mesh(MainWindow& window, Session& session, const std::string& file, const std::string& path,
          const std::string& scale) {
  say(window, "mesh " + quoted(file) + " " + scale);
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
  for (auto* dock : window.findChildren<QDockWidget*>()) dock->hide();
  window.scene().setFixedSize(1280, 720);
  QApplication::processEvents();
  shadings(window, open_it);
  details(window, session, open_it);
  say(window, "camera 0 0 4");
  details(window, session, open_it);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2 && argc != 4 && argc != 5)
    return std::fprintf(stderr, "cleft-benchmark-explorer STUDY [MESH PATH [MM_PER_UNIT]]\n"), 2;
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
  if (argc >= 4) mesh(window, session, argv[2], argv[3], argc == 5 ? argv[4] : "1");
  return 0;
}
