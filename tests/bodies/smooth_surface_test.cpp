#include "explorer/body/smooth_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "explorer/body/body_maker.h"
#include "tests/incision/meshes.h"

namespace cleft {

namespace {

constexpr double radius = 60;

double off_sphere(const std::vector<Vec3>& points) {
  double most = 0;
  for (const Vec3& p : points) most = std::max(most, std::abs(norm(p) - radius));
  return most;
}

/// Places of the triangles themselves.
std::vector<Vec3> places_on(const SurfaceMesh& mesh) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(0, 1);
  std::vector<Vec3> places;
  for (const auto& t : mesh.triangles) {
    const double a = any(random), b = any(random) * (1 - a);
    places.push_back(a * mesh.points[t[0]] + b * mesh.points[t[1]] + (1 - a - b) * mesh.points[t[2]]);
  }
  return places;
}

}  // namespace

TEST(SmoothSurface, OfACoarseSphereIsNearlyTheSphere) {
  const SurfaceMesh mesh = testing::sphere(4, radius);
  const std::vector<Vec3> places = places_on(mesh);
  const SmoothSurface smooth(mesh, places);
  std::vector<Vec3> moved;
  moved.reserve(places.size());
  for (const Vec3& p : places) moved.push_back(smooth.nearest(p));
  EXPECT_GT(off_sphere(places), 0.03) << "its triangles, with edges of about 4";
  EXPECT_LT(off_sphere(moved), off_sphere(places) / 50);
}

/// A cubic patch's edge depends on its two ends alone.
TEST(SmoothSurface, GoesOnAcrossEdges) {
  SurfaceMesh mesh = testing::sphere(2, radius);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-1, 1);
  for (Vec3& p : mesh.points) p += 2 * Vec3{any(random), any(random), any(random)};
  const SmoothSurface smooth(mesh, mesh.points);
  for (const auto& t : mesh.triangles)
    for (int i = 0; i < 3; ++i) {
      const Vec3 a = mesh.points[t[i]], b = mesh.points[t[(i + 1) % 3]], c = mesh.points[t[(i + 2) % 3]];
      const Vec3 on = a + 0.3 * (b - a);
      EXPECT_LT(norm(smooth.nearest(on + 1e-6 * (c - on)) - smooth.nearest(on - 1e-6 * (c - on))), 1e-4);
    }
  for (const Vec3& p : mesh.points) EXPECT_LT(norm(smooth.nearest(p) - p), 1e-9);
}

/// Two planes that meet at a right angle: what lies on them stays there.
TEST(SmoothSurface, LeavesFeaturesAsTheyAre) {
  SurfaceMesh mesh = testing::grid(20, 20, -10, -10, 1);
  for (Vec3& p : mesh.points)
    if (p.x > 0) p = {0, p.y, -p.x};
  const std::vector<Vec3> places = places_on(mesh);
  const SmoothSurface smooth(mesh, places);
  for (const Vec3& p : places)
    EXPECT_LT(norm(smooth.nearest(p) - p), 1e-9) << p.x << ' ' << p.y << ' ' << p.z;
}

/// Elements of 1 mm below triangles of 4: on the triangles themselves the skin would be off by 0.03 mm, with
/// an edge of them at every fourth node.
TEST(SmoothSurface, IsWhereTheSkinOfABodyLies) {
  BodyRequest request;
  request.skin = testing::sphere(4, radius);
  std::vector<ScalpelPath::Point> path;
  for (const double angle : {-0.2, -0.1, 0., 0.1, 0.2}) {
    const Vec3 out{std::sin(angle), 0, std::cos(angle)};
    path.push_back({radius * out, out, 3});
  }
  request.paths = {ScalpelPath(path)};
  request.parameters.mesh.element_size = 1;
  request.reach = 15;
  const Body body = make_body(request);
  std::vector<Vec3> skin;
  for (const auto& t : body.skin)
    for (const int p : t) skin.push_back(body.points[p]);
  EXPECT_LT(off_sphere(skin), 0.03 / 30);
}

}  // namespace cleft
