// The cut in a mesh, and the haptic thread's tick.
#include <cmath>

#include "benchmarks/cutting_ticks.h"
#include "benchmarks/suite/suite.h"
#include "benchmarks/winding_cut.h"

namespace cleft {

namespace {

int squares_for(std::int64_t triangles) {
  return static_cast<int>(std::lround(std::sqrt(static_cast<double>(triangles) / 2)));
}

/// Microseconds for each triangle crossed, its walls included.
void cut_step(benchmark::State& state) {
  CutMesh mesh(hills(squares_for(state.range(0))));
  const WindingCut cut(mesh, winding(0));
  std::vector<double> us;
  {
    const WorkCount count(state);
    for (auto _ : state) cut.time(us);
  }
  state.counters["work_steps"] = static_cast<double>(cut.steps());
  report_quantiles(state, "us_step", us);
}
BENCHMARK(cut_step)->Arg(12000)->Arg(100000)->Arg(1000000)->Iterations(5)->Unit(benchmark::kMillisecond);

/// Microseconds of a tick while another thread cuts.
void haptic_tick(benchmark::State& state) {
  constexpr int repeats = 2;
  const SurfaceMesh mesh = hills_to_cut(squares_for(state.range(0)));
  const auto field = field_of_the_cut();
  std::vector<double> ticks;
  for (auto _ : state) ticks = ticks_while_cutting(mesh, field, repeats, Schedule::in_turns);
  for (double& tick : ticks) tick *= 1e-3;
  state.counters["work_ticks"] = static_cast<double>(ticks.size());
  report_quantiles(state, "us_tick", ticks);
}
BENCHMARK(haptic_tick)->Arg(12000)->Arg(100000)->Arg(1000000)->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace

}  // namespace cleft
