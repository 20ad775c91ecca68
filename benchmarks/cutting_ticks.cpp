#include "benchmarks/cutting_ticks.h"

#include <atomic>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <thread>

#include "explorer/scalpel/hand_script.h"
#include "explorer/scalpel/scalpel_cutting.h"
#include "haptic/loop.h"
#include "haptic/real_time.h"
#include "tests/incision/meshes.h"
#include "tests/wound/fields.h"

namespace cleft {

namespace {

constexpr double side = 100, depth = 3, speed = 30;  // mm, mm, mm/s
constexpr int ticks_a_frame = 16;

double hill_height(double x, double y) { return 3 * std::sin(x / 12) * std::cos(y / 15); }

Vec3 up_on_hills(const Vec3& p) {
  return normalized(
      {-0.25 * std::cos(p.x / 12) * std::cos(p.y / 15), 0.2 * std::sin(p.x / 12) * std::sin(p.y / 15), 1});
}

/// `aside`: mm beside the one over the middle.
ScalpelPath winding(double aside = 0) {
  std::vector<Vec3> points;
  for (int i = 0; i <= 200; ++i) {
    const double s = i / 200., x = -30 + 60 * s, y = aside + 8 * std::sin(5 * s);
    points.push_back({x, y, hill_height(x, y)});
  }
  return testing::path_through(points, up_on_hills, depth);
}

std::vector<ScalpelPath> earlier_cuts() {
  constexpr double away = 12;
  std::vector<Vec3> across;
  for (int i = 0; i <= 50; ++i) across.push_back({3, -9. + 0.4 * i, hill_height(3, -9. + 0.4 * i)});
  return {winding(away), winding(-away), testing::path_through(across, up_on_hills, depth)};
}

/// A thread that does the same work whenever it is told to, while the one that tells waits awake.
class InTurns {
 public:
  explicit InTurns(std::function<void()> work) : work_(std::move(work)), thread_([this] { follow(); }) {}
  ~InTurns() {
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
class Ticks {
 public:
  Ticks(const SurfaceMesh& mesh, const std::shared_ptr<const Field>& field, bool beside)
      : cutting_(mesh,
                 {winding(), beside ? earlier_cuts() : std::vector<ScalpelPath>{}, CutFields(field), 1, 0}),
        hand_({}, hand_along(winding(), 1, speed, {}, force_)),
        loop_(hand_, cutting_.surface(), force_) {
    times_.reserve(static_cast<std::size_t>(1e3 * hand_.duration()) + 1);
  }

  std::vector<double> in_turns() {
    InTurns frames([this] { cutting_.step(loop_.for_cutting()); });
    while (going()) {
      tick();
      if (times_.size() % ticks_a_frame == 0) frames.once();
    }
    return checked();
  }

  std::vector<double> by_the_clock() {
    std::atomic<bool> over = false;
    std::thread frames([&] {
      repeat(
          clock_second / 60, [&] { return over.load(); }, [&] { cutting_.step(loop_.for_cutting()); });
    });
    {
      const TickingThread thread(true);
      for (std::int64_t due = clock_time(CLOCK_MONOTONIC); going();
           due = std::max(due, clock_time(CLOCK_MONOTONIC))) {
        be_awake_at(due += clock_second / 1000);
        tick();
      }
    }
    over = true;
    frames.join();
    cutting_.step(loop_.for_cutting());
    return checked();
  }

 private:
  bool going() const { return loop_.state().time < hand_.duration(); }
  void tick() {
    const std::int64_t before = clock_time(CLOCK_THREAD_CPUTIME_ID);
    loop_.update(1e-3);
    times_.push_back(static_cast<double>(clock_time(CLOCK_THREAD_CPUTIME_ID) - before));
  }
  std::vector<double> checked() const {
    if (const double cut = cutting_.cut_length(); cut < 50)
      throw std::runtime_error("the blade cut " + std::to_string(cut) + " mm, not all its way");
    return times_;
  }

  const ForceParameters force_;
  ScalpelCutting cutting_;
  Hand hand_;
  HapticLoop loop_;
  std::vector<double> times_;
};

}  // namespace

SurfaceMesh hills_to_cut(int squares) {
  return testing::grid(squares, squares, -side / 2, -side / 2, side / squares, hill_height);
}

std::shared_ptr<const Field> field_of_the_cut() {
  return std::make_shared<const Field>(testing::opening_field({-15, 30, 3}, 50, 50, 6, 3));
}

std::vector<double> ticks_while_cutting(const SurfaceMesh& mesh, const std::shared_ptr<const Field>& field,
                                        int repeats, Schedule schedule, bool beside) {
  std::vector<double> least;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    Ticks ticks(mesh, field, beside);
    const std::vector<double> times =
        schedule == Schedule::in_turns ? ticks.in_turns() : ticks.by_the_clock();
    if (repeat == 0) least = times;
    if (times.size() != least.size()) throw std::runtime_error("the cut did not repeat");
    for (std::size_t i = 0; i < times.size(); ++i) least[i] = std::min(least[i], times[i]);
  }
  return least;
}

}  // namespace cleft
