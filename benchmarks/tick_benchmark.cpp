// What the ticks of the haptic loop compute while a mesh is cut, whatever else the machine does:
//   cleft-benchmark-ticks [REPEATS]
// The same cut again and again, ticks and cutting in turns on two threads; of every tick the least time of
// all repeats. What interrupts, other programs and other machines on the same host add falls on other ticks
// each time; what a tick itself needs (surface just changed, new cells, what the other core has written) does
// not.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <thread>

#include "base/quantiles.h"
#include "explorer/scene/hand_script.h"
#include "explorer/scene/scalpel_cutting.h"
#include "haptic/loop.h"
#include "tests/incision/fields.h"
#include "tests/incision/meshes.h"

using namespace cleft;

namespace {

constexpr double side = 100, depth = 3, speed = 30;  // mm, mm, mm/s
constexpr int ticks_a_frame = 16;

double hills(double x, double y) { return 3 * std::sin(x / 12) * std::cos(y / 15); }

Vec3 up_on_hills(const Vec3& p) {
  return normalized(
      {-0.25 * std::cos(p.x / 12) * std::cos(p.y / 15), 0.2 * std::sin(p.x / 12) * std::sin(p.y / 15), 1});
}

ScalpelPath winding() {
  std::vector<Vec3> points;
  for (int i = 0; i <= 200; ++i) {
    const double s = i / 200., x = -30 + 60 * s, y = 8 * std::sin(5 * s);
    points.push_back({x, y, hills(x, y)});
  }
  return testing::path_through(points, up_on_hills, depth);
}

/// A thread that does the same work whenever it is told to, while the one that tells waits awake.
class Beside {
 public:
  explicit Beside(std::function<void()> work) : work_(std::move(work)), thread_([this] { follow(); }) {}
  ~Beside() {
    turn_ = Turn::over;
    thread_.join();
  }
  void once() {
    turn_ = Turn::its;
    while (turn_ == Turn::its) std::this_thread::yield();
  }

 private:
  enum class Turn { mine, its, over };
  void follow() {
    for (Turn now = turn_; now != Turn::over; now = turn_) {
      if (now != Turn::its) {
        std::this_thread::yield();
        continue;
      }
      work_();
      turn_ = Turn::mine;
    }
  }

  std::function<void()> work_;
  std::atomic<Turn> turn_ = Turn::mine;
  std::thread thread_;
};

/// Of every tick of the cut, nanoseconds.
std::vector<double> ticks_of(const SurfaceMesh& mesh, const std::shared_ptr<const Field>& field) {
  using Clock = std::chrono::steady_clock;
  const ScalpelPath path = winding();
  ScalpelCutting cutting(mesh, {path, {}, CutFields(field), 1, 0});
  const ForceParameters force;
  Hand hand({}, hand_along(path, 1, speed, {}, force));
  HapticLoop loop(hand, cutting.surface(), force);
  Beside frames([&] { cutting.step(loop.for_cutting()); });
  std::vector<double> times;
  while (loop.state().time < hand.duration()) {
    const auto start = Clock::now();
    loop.update(1e-3);
    times.push_back(std::chrono::duration<double, std::nano>(Clock::now() - start).count());
    if (times.size() % ticks_a_frame == 0) frames.once();
  }
  if (cutting.cut_length() < 50) std::fprintf(stderr, "only %.1f mm were cut\n", cutting.cut_length());
  return times;
}

}  // namespace

int main(int argc, char** argv) {
  const int repeats = argc > 1 ? std::atoi(argv[1]) : 5;
  const auto field = std::make_shared<const Field>(testing::opening_field({-15, 30, 3}, 50, 50, 6, 3));
  std::printf("%10s %8s   microseconds: %6s %6s %6s %6s\n", "triangles", "ticks", "p50", "p99", "p99.9",
              "most");
  for (const int squares : {78, 224, 708}) {
    const SurfaceMesh mesh = testing::grid(squares, squares, -side / 2, -side / 2, side / squares, hills);
    std::vector<double> least;
    for (int repeat = 0; repeat < repeats; ++repeat) {
      const std::vector<double> times = ticks_of(mesh, field);
      if (least.empty()) least = times;
      if (times.size() != least.size()) return std::fprintf(stderr, "the cut did not repeat\n"), 1;
      for (std::size_t i = 0; i < times.size(); ++i) least[i] = std::min(least[i], times[i]);
    }
    const auto at = [&](double part) { return 1e-3 * quantile(least, part); };
    std::printf("%10zu %8zu %22.1f %6.1f %6.1f %6.1f\n", mesh.triangles.size(), least.size(), at(.5), at(.99),
                at(.999), at(1));
    std::fflush(stdout);
  }
}
