// cleft-benchmark-incision: microseconds for a step of the cut, one triangle crossed, walls and their column
// included, on flat meshes of different sizes, whose triangles the path meets at the same scale; and for a
// frame of the wound as it opens.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <vector>

#include "base/quantiles.h"
#include "benchmarks/winding_cut.h"
#include "explorer/wound/live_replay.h"
#include "tests/wound/fields.h"

namespace {

using namespace cleft;
using Clock = std::chrono::steady_clock;

/// Of cuts here and there. Returns p99, us.
double measure(int squares, int paths) {
  CutMesh mesh(hills(squares));
  std::vector<double> us;
  for (int number = 0; number < paths; ++number) WindingCut(mesh, winding(number)).time(us);
  const auto at = [&us](double part) { return quantile(us, part); };
  std::printf("%9d triangles: %6zu steps, p50 %6.1f us, p90 %6.1f, p99 %6.1f, p99.9 %6.1f, largest %7.1f\n",
              2 * squares * squares, us.size(), at(.5), at(.9), at(.99), at(.999), at(1));
  return at(.99);
}

/// A cut as long as the field's, so that all the patch moves in every frame.
void measure_frames() {
  const Field field = testing::opening_field({-15, 30, 3}, 50, 50, 6, 3);
  SurfaceMesh mesh = hills(98);
  for (Vec3& p : mesh.points) p = {p.x / 2, p.y / 2, 0};
  IncisionOptions options;
  options.max_edge = 0;
  Incision incision(mesh, ScalpelPath({{{-15, 0.1, 0}, {0, 0, 1}, 2}, {{15, 0.1, 0}, {0, 0, 1}, 2}}),
                    options);
  Wound wound(incision, field, 1);
  LiveReplay live(wound);
  std::vector<double> follow, move;
  for (double s = 0.25; s < 30; s += 0.25) {
    incision.advance_to(s);
    const auto start = Clock::now();
    live.follow();
    const auto middle = Clock::now();
    live.move_to(s);
    follow.push_back(std::chrono::duration<double, std::micro>(middle - start).count());
    move.push_back(std::chrono::duration<double, std::micro>(Clock::now() - middle).count());
  }
  std::printf("%9zu active vertices: step p50 %6.1f us, p90 %6.1f; frame p50 %6.1f us, p90 %6.1f\n",
              live.active(), median(follow), quantile(follow, .9), median(move), quantile(move, .9));
}

}  // namespace

int main() {
  measure_frames();
  measure(78, 20);  // warms caches and memory up
  measure(224, 20);
  // In turns, so that whatever else the machine does falls on both.
  std::vector<double> ratios;
  for (int round = 0; round < 3; ++round) {
    const double small = measure(78, 20);        // 12,168
    ratios.push_back(measure(708, 20) / small);  // 1,002,528
  }
  std::printf("p99 at a million triangles over p99 at 12,168: %.2f (median of three)\n", median(ratios));
}
