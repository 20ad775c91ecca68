// A moved surface has no jumps but at the cut. (tests/truth: nor in time, and it does not pass through
// itself.)
#include <gtest/gtest.h>

#include "explorer/wound/replay.h"
#include "tests/incision/meshes.h"
#include "tests/incision/self_intersections.h"
#include "tests/wound/fields.h"

namespace cleft {
namespace {

using namespace testing;

const CanonicalCut canonical{-5, 10, 3};

ScalpelPath arc(double radius, double length) {
  std::vector<Vec3> points;
  for (int i = -20; i <= 20; ++i) {
    const double a = length / 2 * i / 20 / radius;
    points.push_back({radius * std::sin(a), radius * (1 - std::cos(a)), 0});
  }
  return path_through(points, up, 3);
}

/// The largest difference between the displacements of neighbours of the skin.
double largest_jump(const ScalpelPath& path, int parts) {
  const double h = 1. / parts;
  IncisionOptions options;
  options.max_edge = 0;
  // Wider than the patch and its margin, so that what fades out is there too.
  Incision incision(grid(50 * parts, 40 * parts, -25 + 0.013, -20 + 0.017, h), path, options);
  incision.advance_to(path.length());
  const Replay replay(Wound(incision, opening_field(canonical, 20, 16, 6, 2), 1));
  std::vector<Vec3> moved(replay.vertex_count());
  double result = 0;
  replay.positions(path.length(), moved);
  for (const CutMesh::Triangle& t : incision.mesh().triangles()) {
    if (t.region != Region::skin) continue;
    for (int i = 0; i < 3; ++i) {
      const auto a = static_cast<std::size_t>(t.vertex[i]),
                 b = static_cast<std::size_t>(t.vertex[(i + 1) % 3]);
      result = std::max(result, norm((moved[a] - replay.rest()[a]) - (moved[b] - replay.rest()[b])));
    }
  }
  return result;
}

TEST(Continuity, JumpsGoToZeroWithRefinement) {
  // Straight, bent tighter than the patch is wide, and longer than the canonical cut.
  for (const ScalpelPath& path : {arc(1000, 10), arc(5, 10), arc(40, 26)}) {
    const double coarse = largest_jump(path, 1), fine = largest_jump(path, 4);
    // The opening goes as the square root of the distance from its ends: half for a quarter.
    EXPECT_LT(fine, 0.6 * coarse);
    EXPECT_GT(coarse, 0.05);
  }
}

TEST(Continuity, AWoundThatClosesTooFarPassesThroughItself) {
  Incision incision(grid(40, 32, -20 + 0.013, -16 + 0.017, 1), arc(1000, 10));
  incision.advance_to(incision.path().length());
  SurfaceMesh surface = incision.mesh().surface();
  EXPECT_EQ(self_intersections(surface), 0);
  const Replay replay(Wound(incision, opening_field(canonical, 20, 16, 6, -1), 1));
  replay.positions(incision.path().length(), surface.points);
  EXPECT_GT(self_intersections(surface), 0);
}

}  // namespace
}  // namespace cleft
