// cleft-benchmark-incision: microseconds for a step of the cut, one triangle crossed, walls and their column
// included, on flat meshes of different sizes, whose triangles the path meets at the same scale; and for a
// frame of the wound as it opens.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <vector>

#include "base/quantiles.h"
#include "explorer/incision/incision.h"
#include "explorer/scene/live_replay.h"
#include "tests/incision/fields.h"

namespace {

using namespace cleft;
using Clock = std::chrono::steady_clock;

SurfaceMesh hills(int squares) {
  SurfaceMesh mesh;
  for (int j = 0; j <= squares; ++j)
    for (int i = 0; i <= squares; ++i)
      mesh.points.push_back({double(i), double(j), 2 * std::sin(0.11 * i) * std::cos(0.13 * j)});
  for (int j = 0; j < squares; ++j)
    for (int i = 0; i < squares; ++i) {
      const int a = j * (squares + 1) + i, b = a + 1, c = a + squares + 1, d = c + 1;
      mesh.triangles.push_back({a, b, d});
      mesh.triangles.push_back({a, d, c});
    }
  return mesh;
}

/// A winding path over most of the smallest mesh, beginning elsewhere each time.
ScalpelPath winding(int number, int squares) {
  const double x0 = squares / 2. - 30 + 0.37 * number, y0 = squares / 2. + 0.83 * number - 5;
  std::vector<ScalpelPath::Point> points;
  for (int i = 0; i <= 120; ++i) {
    const double x = x0 + 0.5 * i, y = y0 + 3 * std::sin(0.1 * i);
    points.push_back({{x, y, 2 * std::sin(0.11 * x) * std::cos(0.13 * y)}, {0, 0, 1}, 2});
  }
  return ScalpelPath(points);
}

/// One step of the chain at a time: the time of every advance that went on by one vertex. Returns p99, us.
double measure(int squares, int paths) {
  CutMesh mesh(hills(squares));
  std::vector<double> us;
  for (int number = 0; number < paths; ++number) {
    IncisionOptions options;
    options.max_edge = 0;
    options.reach = 0;
    Incision whole(mesh, winding(number, squares), options);
    whole.advance_to(whole.path().length());
    std::vector<double> stops;
    for (const auto& c : whole.chain()) stops.push_back(c.s);
    whole.undo();
    Incision cut(mesh, winding(number, squares), options);
    for (std::size_t i = 1; i < stops.size(); ++i) {
      const auto start = Clock::now();
      cut.advance_to(stops[i]);
      us.push_back(std::chrono::duration<double, std::micro>(Clock::now() - start).count());
    }
    cut.undo();
  }
  const auto at = [&us](double part) { return quantile(us, part); };
  std::printf("%9d triangles: %6zu steps, p50 %6.1f us, p90 %6.1f, p99 %6.1f, p99.9 %6.1f, largest %7.1f\n",
              2 * squares * squares, us.size(), at(.5), at(.9), at(.99), at(.999), at(1));
  return at(.99);
}

/// A cut as long as the field's, so that all the patch moves in every frame.
void measure_frames() {
  const Field field = testing::opening_field({-15, 30, 3}, 50, 50, 6, 3);
  SurfaceMesh mesh = hills(98);
  for (Vec3& p : mesh.points) p = {(p.x - 49) / 2, (p.y - 49) / 2, 0};
  IncisionOptions options;
  options.max_edge = 0;
  Incision incision(mesh, ScalpelPath({{{-15, 0.1, 0}, {0, 0, 1}, 2}, {{15, 0.1, 0}, {0, 0, 1}, 2}}),
                    options);
  LiveReplay live(field, incision, 1);
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
