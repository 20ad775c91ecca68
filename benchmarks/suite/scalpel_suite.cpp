// The cut in a mesh, and the haptic thread's tick.
#include <time.h>

#include <chrono>
#include <cmath>

#include "benchmarks/suite/suite.h"
#include "explorer/incision/incision.h"
#include "haptic/devices/recorded.h"
#include "haptic/loop.h"
#include "tests/haptic/surfaces.h"

namespace cleft {

namespace {

/// Hills whose triangles the scalpel meets at one scale, however many there are.
testing::Surface hills(int squares) {
  return testing::sheet(squares, 1,
                        [](double x, double y) { return 2 * std::sin(0.11 * x) * std::cos(0.13 * y); });
}
int squares_for(std::int64_t triangles) {
  return static_cast<int>(std::lround(std::sqrt(static_cast<double>(triangles) / 2)));
}

/// Microseconds for each triangle crossed, its walls included.
void cut_step(benchmark::State& state) {
  const testing::Surface surface = hills(squares_for(state.range(0)));
  CutMesh mesh(SurfaceMesh{surface.points, surface.triangles});
  std::vector<ScalpelPath::Point> points;
  for (int i = 0; i <= 120; ++i) {
    const double x = 0.5 * i - 30, y = 3 * std::sin(0.1 * i);
    points.push_back({{x, y, 2 * std::sin(0.11 * x) * std::cos(0.13 * y)}, {0, 0, 1}, 2});
  }
  IncisionOptions options;
  options.max_edge = options.reach = 0;
  std::vector<double> stops, us;
  {
    Incision whole(mesh, ScalpelPath(points), options);
    whole.advance_to(whole.path().length());
    for (const auto& vertex : whole.chain()) stops.push_back(vertex.s);
    whole.undo();
  }
  {
    const WorkCount count(state);
    for (auto _ : state) {
      Incision cut(mesh, ScalpelPath(points), options);
      for (std::size_t i = 1; i < stops.size(); ++i) {
        const auto start = std::chrono::steady_clock::now();
        cut.advance_to(stops[i]);
        us.push_back(
            std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count());
      }
      cut.undo();
    }
  }
  state.counters["work_steps"] = static_cast<double>(stops.size());
  report_quantiles(state, "us_step", us);
}
BENCHMARK(cut_step)->Arg(12000)->Arg(100000)->Arg(1000000)->Iterations(5)->Unit(benchmark::kMillisecond);

/// Microseconds of a tick, by the thread's own clock: a blade that slides over the hills, half a millimetre
/// in.
void haptic_tick(benchmark::State& state) {
  const testing::Surface hill = hills(squares_for(state.range(0)));
  const ContactSurface surface(hill.points, hill.triangles);
  std::vector<RecordedPose> poses;
  for (int i = 0; i < 20000; ++i) {
    ScalpelPose pose;
    const double x = 25 * std::sin(1e-3 * i), y = 0.3;
    pose.tip = {x, y, 2 * std::sin(0.11 * x) * std::cos(0.13 * y) + 2 - 2.5 * std::min(1., 1e-3 * i)};
    pose.cutting = false;
    poses.push_back({1e-3 * i, pose});
  }
  std::vector<double> us;
  us.reserve(poses.size() * 8);
  const auto now = [] {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return 1e6 * static_cast<double>(t.tv_sec) + 1e-3 * static_cast<double>(t.tv_nsec);
  };
  for (auto _ : state) {
    Recorded device(poses);
    HapticLoop loop(device, surface, ForceParameters{});
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const double start = now();
      loop.update(1e-3);
      us.push_back(now() - start);
    }
  }
  report_quantiles(state, "us_tick", us);
}
BENCHMARK(haptic_tick)->Arg(12000)->Arg(100000)->Arg(1000000)->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace

}  // namespace cleft
