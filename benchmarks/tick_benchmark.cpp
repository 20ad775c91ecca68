// What the ticks of the haptic loop compute while a mesh is cut, whatever else the machine does:
//   cleft-benchmark-ticks [REPEATS]
// Both in turns, and simultaneously by the clock; and so beside two earlier cuts and across a third one.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <tuple>

#include "base/quantiles.h"
#include "benchmarks/cutting_ticks.h"

using namespace cleft;

int main(int argc, char** argv) try {
  const int repeats = argc > 1 ? std::atoi(argv[1]) : 5;
  std::printf("%-13s %10s %8s   microseconds: %6s %6s %6s %6s\n", "", "triangles", "ticks", "p50", "p99",
              "p99.9", "most");
  const auto field = field_of_the_cut();
  for (const int squares : {78, 224, 708}) {
    const SurfaceMesh mesh = hills_to_cut(squares);
    for (const auto& [schedule, beside, what] : {std::tuple{Schedule::in_turns, false, "in turns"},
                                                 {Schedule::by_the_clock, false, "by the clock"},
                                                 {Schedule::by_the_clock, true, "with others"}}) {
      const std::vector<double> ticks = ticks_while_cutting(mesh, field, repeats, schedule, beside);
      const auto at = [&](double part) { return 1e-3 * quantile(ticks, part); };
      std::printf("%-13s %10zu %8zu %22.1f %6.1f %6.1f %6.1f\n", what, mesh.triangles.size(), ticks.size(),
                  at(.5), at(.99), at(.999), at(1));
      std::fflush(stdout);
    }
  }
} catch (const std::exception& e) {
  std::fprintf(stderr, "cleft-benchmark-ticks: %s\n", e.what());
  return 1;
}
