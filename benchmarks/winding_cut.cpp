#include "benchmarks/winding_cut.h"

#include <cmath>

#include "base/stopwatch.h"
#include "tests/incision/meshes.h"

namespace cleft {

namespace {

double wave_height(double x, double y) { return 2 * std::sin(0.11 * x) * std::cos(0.13 * y); }

/// The mesh's own triangles, neither split nor looked at further than the cut needs.
IncisionOptions as_it_is() {
  IncisionOptions options;
  options.max_edge = options.reach = 0;
  return options;
}

}  // namespace

SurfaceMesh hills(int squares) {
  return testing::grid(squares, squares, -squares / 2., -squares / 2., 1, wave_height);
}

ScalpelPath winding(int number) {
  std::vector<ScalpelPath::Point> points;
  for (int i = 0; i <= 120; ++i) {
    const double x = 0.37 * number - 30 + 0.5 * i, y = 0.83 * number - 5 + 3 * std::sin(0.1 * i);
    points.push_back({{x, y, wave_height(x, y)}, {0, 0, 1}, 2});
  }
  return ScalpelPath(points);
}

WindingCut::WindingCut(CutMesh& mesh, const ScalpelPath& path) : mesh_(mesh), path_(path) {
  Incision whole(mesh, path, as_it_is());
  whole.advance_to(path.length());
  for (const auto& vertex : whole.chain()) stops_.push_back(vertex.s);
  whole.undo();
}

void WindingCut::time(std::vector<double>& microseconds) const {
  Incision cut(mesh_, path_, as_it_is());
  for (std::size_t i = 1; i < stops_.size(); ++i) {
    Stopwatch watch;
    cut.advance_to(stops_[i]);
    microseconds.push_back(1e6 * watch.seconds());
  }
  cut.undo();
}

}  // namespace cleft
