// Whatever mesh, path and lengths come, the work is bounded before it begins, and a refusal says why.
#include <gtest/gtest.h>

#include <ctime>
#include <functional>
#include <random>
#include <string>

#include "base/error.h"
#include "tests/incision/meshes.h"
#include "tests/incision/stress/soundness.h"
#include "tests/support/expect_refusal.h"

namespace cleft {
namespace {

using namespace testing;

SurfaceMesh plate_with_outlier(double far) {
  SurfaceMesh mesh = grid(8, 8, -10, -10, 2.5);
  mesh.points[4 * 9] = {-far, 0, 0.03};  // of triangles that reach up to the path
  return mesh;
}

ScalpelPath across(double y = 0.3) { return path_through({{-6, y, 0}, {0, y, 0}, {6, y, 0}}, up, 1); }

TEST(Bounds, AVertexWhoseRoundingIsCoarserThanTheEdgesIsRefused) {
  for (const double far : {1e14, 1e16, 1e30})
    expect_refusal(std::to_string(far), [&] { Incision(plate_with_outlier(far), across()); },
                   {"vertex at (-1e+", "edges of 0.4", "Remove the vertex"});
}

TEST(Bounds, AFarVertexIsSplitDownToThePath) {
  for (const double far : {1e3, 1e6, 1e9, 1e11}) {
    SCOPED_TRACE(far);
    CutMesh mesh(plate_with_outlier(far));
    Incision cut(mesh, across());
    cut.advance_to(100);
    EXPECT_NEAR(cut.tip(), 12, 1e-9);
    EXPECT_LT(mesh.triangles().size(), 20000u);  // a few for each doubling of the distance
    EXPECT_EQ(stress::Soundness(mesh).whole(), "");
  }
}

TEST(Bounds, EdgesThatTakeTooManyTrianglesAreRefused) {
  IncisionOptions options;
  for (const double edge : {1e-4, 1e-9, 1e-300}) {
    options.max_edge = edge;
    // A strip of 3 by 15 at 0.433 edge^2 each: 2e7 triangles have edges of 0.0023.
    expect_refusal(std::to_string(edge), [&] { Incision(grid(20, 20, -10, -10, 1), across(), options); },
                   {"edges of at most 1e-", "least edge possible along a path of length 12 is 0.00227"});
  }
}

TEST(Bounds, CoordinatesDirectionsAndDepthsThatCannotBeComputedWithAreRefused) {
  const auto path = [](double length, double normal, double depth) {
    return ScalpelPath({{{0, 0, 0}, {0, 0, normal}, depth}, {{length, 0, 0}, {0, 0, normal}, depth}});
  };
  expect_refusal("far path", [&] { path(1e61, 1, 1); }, {"point 2", "1e+61", "1e+60"});
  expect_refusal("short path", [&] { path(1e-51, 1, 1); }, {"1e-51", "1e-50"});
  expect_refusal("long direction", [&] { path(1, 1e200, 1); }, {"point 1", "too long"});
  expect_refusal("short direction", [&] { path(1, 1e-200, 1); }, {"point 1", "is zero"});
  expect_refusal("many points",
                 [] {
                   std::vector<ScalpelPath::Point> points;
                   for (int i = 0; i <= 20000; ++i) points.push_back({{i / 1e3, 0, 0}, {0, 0, 1}, 1});
                   ScalpelPath{points};
                 },
                 {"20001", "leave some out"});
  const SurfaceMesh plate = grid(20, 20, -10, -10, 1);
  expect_refusal("deep", [&] { Incision(plate, path(5, 1, 1e100)); }, {"depth is 1e+100", "1e+60"});
  expect_refusal("shallow", [&] { Incision(plate, path(5, 1, 1e-20)); }, {"depth is ", "e-21", "deeper"});
  SurfaceMesh far = plate;
  far.points[7].x = 1e61;
  expect_refusal("far mesh", [&] { CutMesh{far}; }, {"point 7", "1e+61"});
}

/// Rows of needles `width` long and of height 40 / rows, their upper and lower corners jittered.
SurfaceMesh needles(int rows, double width) {
  SurfaceMesh mesh = grid(1, rows, -width / 2, -20, 40. / rows);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> jitter(-0.3, 0.3);
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    Vec3& p = mesh.points[i];
    p.x = (i % 2 ? 0.5 : -0.5) * width;
    p.y += jitter(random) * 40. / rows;
    p.z = 1e-4 * jitter(random);
  }
  return mesh;
}

ScalpelPath over_needles() { return path_through({{0.1, -9, 0}, {0.9, -1, 0}, {1.9, 9, 0}}, up, 1); }

TEST(Slivers, TakeWorkInProportionToTheirNumber) {
  for (const double width : {1e3, 1e4, 1e6, 1e7}) {
    SCOPED_TRACE(width);
    const std::clock_t before = std::clock();
    CutMesh mesh(needles(2000, width));
    Incision cut(mesh, over_needles());
    cut.advance_to(100);
    // A tenth or less in release; with millions of triangles, or trials without end, a minute.
    EXPECT_LT(double(std::clock() - before) / CLOCKS_PER_SEC, 20);
    EXPECT_LT(mesh.triangles().size(), 250000u);
    EXPECT_NEAR(cut.tip(), cut.path().length(), IncisionTolerances::shortest_rest * cut.path().length());
    EXPECT_EQ(stress::Soundness(mesh).whole(), "");
  }
}

TEST(Slivers, EdgesThatWereAskedForAreMadeOrRefused) {
  CutMesh mesh(needles(2000, 1e4));
  IncisionOptions options;
  options.max_edge = 0.1;
  const std::size_t before = mesh.triangles().size();
  expect_refusal("0.1", [&] { Incision(mesh, over_needles(), options); },
                 {"edges of at most 0.1", "slivers", "permit longer edges"});
  EXPECT_EQ(mesh.triangles().size(), before);
}

}  // namespace
}  // namespace cleft
