#include "benchmarks/cutting_ticks.h"

#include <atomic>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <thread>

#include "base/stopwatch.h"
#include "explorer/scene/hand_script.h"
#include "explorer/scene/scalpel_cutting.h"
#include "haptic/loop.h"
#include "tests/incision/fields.h"
#include "tests/incision/meshes.h"

namespace cleft {

namespace {

constexpr double side = 100, depth = 3, speed = 30;  // mm, mm, mm/s
constexpr int ticks_a_frame = 16;

double height(double x, double y) { return 3 * std::sin(x / 12) * std::cos(y / 15); }

Vec3 up_on_hills(const Vec3& p) {
  return normalized(
      {-0.25 * std::cos(p.x / 12) * std::cos(p.y / 15), 0.2 * std::sin(p.x / 12) * std::sin(p.y / 15), 1});
}

ScalpelPath winding() {
  std::vector<Vec3> points;
  for (int i = 0; i <= 200; ++i) {
    const double s = i / 200., x = -30 + 60 * s, y = 8 * std::sin(5 * s);
    points.push_back({x, y, height(x, y)});
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
  const ScalpelPath path = winding();
  ScalpelCutting cutting(mesh, {path, {}, CutFields(field), 1, 0});
  const ForceParameters force;
  Hand hand({}, hand_along(path, 1, speed, {}, force));
  HapticLoop loop(hand, cutting.surface(), force);
  Beside frames([&] { cutting.step(loop.for_cutting()); });
  std::vector<double> times;
  while (loop.state().time < hand.duration()) {
    Stopwatch watch;
    loop.update(1e-3);
    times.push_back(1e9 * watch.seconds());
    if (times.size() % ticks_a_frame == 0) frames.once();
  }
  if (cutting.cut_length() < 50) throw std::runtime_error("the blade did not cut all its way");
  return times;
}

}  // namespace

SurfaceMesh hills_to_cut(int squares) {
  return testing::grid(squares, squares, -side / 2, -side / 2, side / squares, height);
}

std::shared_ptr<const Field> field_of_the_cut() {
  return std::make_shared<const Field>(testing::opening_field({-15, 30, 3}, 50, 50, 6, 3));
}

std::vector<double> ticks_while_cutting(const SurfaceMesh& mesh, const std::shared_ptr<const Field>& field,
                                        int repeats) {
  std::vector<double> least = ticks_of(mesh, field);
  for (int repeat = 1; repeat < repeats; ++repeat) {
    const std::vector<double> times = ticks_of(mesh, field);
    if (times.size() != least.size()) throw std::runtime_error("the cut did not repeat");
    for (std::size_t i = 0; i < times.size(); ++i) least[i] = std::min(least[i], times[i]);
  }
  return least;
}

}  // namespace cleft
