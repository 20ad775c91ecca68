// The local shape of paths and skins, compared with closed forms.
#include "explorer/wound/path_shape.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "base/error.h"
#include "tests/incision/meshes.h"

namespace cleft {
namespace {

using namespace testing;
using std::numbers::pi;

/// A skin z = height(x, y) in -size..size of triangles with edges of about h, irregular by `jitter` of an
/// edge, with the height off by `noise`, mm.
SurfaceMesh skin(double size, double h, double jitter, const std::function<double(double, double)>& height,
                 double noise = 0) {
  const int n = static_cast<int>(std::ceil(2 * size / h));
  SurfaceMesh mesh = grid(n, n, -size, -size, 2 * size / n);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> off(-jitter * h, jitter * h);
  std::normal_distribution<double> error(0, 1);
  for (Vec3& p : mesh.points) {
    p.x += off(random), p.y += off(random);
    p.z = height(p.x, p.y) + noise * error(random);
  }
  return mesh;
}

double flat(double, double) { return 0; }

/// Points every `step` mm on an arc in the plane z = 0 that begins at (-length / 2, 0) along x.
std::vector<Vec3> arc(double radius, double length, double step) {
  std::vector<Vec3> points;
  const int n = static_cast<int>(std::ceil(length / step));
  for (int i = 0; i <= n; ++i) {
    const double angle = length * i / n / radius;
    points.push_back({radius * std::sin(angle) - length / 2, radius * (1 - std::cos(angle)), 0});
  }
  return points;
}

Incision incision(const SurfaceMesh& mesh, const std::vector<Vec3>& points, double depth = 3,
                  const std::function<Vec3(const Vec3&)>& outward = up) {
  return Incision(mesh, path_through(points, outward, depth));
}

struct Worst {
  double curvature = 0, u = 0, v = 0, uv = 0, tilt = 0, rate = 0;
};

/// The largest errors along a path against what it should be, s in mm.
Worst errors(const Incision& cut, double smoothing, const std::function<LocalShape(double)>& exact) {
  Worst worst;
  const auto raise = [](double& most, double by) {
    EXPECT_TRUE(std::isfinite(by));
    most = std::max(most, std::abs(by));
  };
  const PathShape shape = shape_along(cut, 1, {smoothing, smoothing});
  for (std::size_t i = 0; i < shape.stations.size(); ++i) {
    const LocalShape is = shape.values[i], should = exact(shape.stations[i]);
    raise(worst.curvature, is.curvature - should.curvature), raise(worst.tilt, is.tilt - should.tilt);
    raise(worst.u, is.skin_u - should.skin_u), raise(worst.v, is.skin_v - should.skin_v);
    raise(worst.uv, is.skin_uv - should.skin_uv);
    raise(worst.rate, is.curvature_rate - should.curvature_rate);
  }
  return worst;
}

/// For the report: the largest errors.
void record(const std::string& what, const Worst& w) {
  std::printf("  %-42s curvature %.1e, skin %.1e %.1e %.1e 1/mm, tilt %.2f degrees\n", what.c_str(),
              w.curvature, w.u, w.v, w.uv, w.tilt);
}

TEST(PathShape, ArcsHaveTheirCurvatureToTheEnds) {
  const SurfaceMesh plate = skin(45, 3, 0, flat);
  double most = 0;
  for (const double smoothing : {5., 8., 12.})
    for (const double radius : {15., 30., 60., 200.})
      for (const double step : {1., 2., 3.5, 5.})
        for (const int sign : {1, -1}) {
          std::vector<Vec3> points = arc(radius, 40, step);
          for (Vec3& p : points) p.y *= sign;
          const Worst worst = errors(incision(plate, points), smoothing,
                                     [&](double) { return LocalShape{.curvature = sign / radius}; });
          most = std::max(most, worst.curvature * radius);
          EXPECT_LT(worst.curvature * radius, 0.01) << smoothing << ' ' << radius << ' ' << step;
          EXPECT_LT(worst.u + worst.v + worst.uv, 1e-12);
        }
  std::printf("  arcs: largest error %.3f %%\n", 100 * most);
}

TEST(PathShape, ACurvatureThatChangesIsFollowed) {
  const SurfaceMesh plate = skin(45, 3, 0, flat);
  std::vector<Vec3> spiral;  // curvature from -1/25 to 1/25 over 50 mm
  Vec3 p{-25, 0, 0};
  constexpr int steps = 5000;
  constexpr double length = 50, rate = 2. / 25 / length;
  for (int i = 0; i <= steps; ++i) {
    if (i % 200 == 0) spiral.push_back(p);
    const double s = length * (i + 0.5) / steps, angle = 0.6 - s / 25 + rate * s * s / 2;
    p += length / steps * Vec3{std::cos(angle), std::sin(angle), 0};
  }
  for (const double smoothing : {5., 8., 16.}) {
    const Worst worst = errors(incision(plate, spiral), smoothing, [&](double s) {
      return LocalShape{.curvature = -1. / 25 + rate * s, .curvature_rate = rate};
    });
    record("clothoid of +-1/25, smoothing " + std::to_string(int(smoothing)), worst);
    EXPECT_LT(worst.curvature, 0.04 * (smoothing == 8 ? 0.18 : 0.1));  // at the ends; less between
    if (smoothing > 8) EXPECT_LT(worst.rate, 0.2 * rate);              // at the ends
  }
}

/// Neither of the path nor of the skin, whose tensor is that along the way of the hand.
TEST(PathShape, ATremorIsNoCurvature) {
  constexpr double r = 50;
  const SurfaceMesh tube = skin(35, 3, 0.1, [](double, double y) { return std::sqrt(r * r - y * y) - r; });
  for (const double smoothing : {5., 8., 12.}) {
    Worst all;
    for (const double phase : {0., 0.7, 1.6, 2.5}) {
      std::vector<Vec3> points;
      for (int i = 0; i <= 160; ++i) {
        const double y = 0.3 * std::sin(2 * pi * i * 0.25 / 3 + phase);
        points.push_back({-20 + i * 0.25, y, std::sqrt(r * r - y * y) - r});
      }
      const Incision cut = incision(tube, points, 3, [](const Vec3& p) { return Vec3{0, p.y, p.z + r}; });
      const Worst worst = errors(cut, smoothing, [](double) { return LocalShape{.skin_v = 1 / r}; });
      all = {std::max(all.curvature, worst.curvature), std::max(all.u, worst.u), std::max(all.v, worst.v),
             std::max(all.uv, worst.uv), std::max(all.tilt, worst.tilt)};
    }
    record("tremor, smoothing " + std::to_string(int(smoothing)), all);
    EXPECT_LT(all.curvature, smoothing < 8 ? 0.08 : 0.03);
    EXPECT_LT(std::max(all.u, all.v), 0.05 / r);
    EXPECT_LT(all.uv, (smoothing < 8 ? 0.25 : 0.1) / r);
  }
}

/// On a sphere and a cylinder, of irregular triangles too.
TEST(PathShape, IsThatInTheSkin) {
  constexpr double r = 40;
  const auto ball = [](double x, double y) { return std::sqrt(r * r - x * x - y * y) - r; };
  const auto from_center = [](const Vec3& p) { return p + Vec3{0, 0, r}; };
  for (const double jitter : {0., 0.25}) {
    const SurfaceMesh sphere = skin(24, 2, jitter, ball);
    std::vector<Vec3> great, latitude;
    const double polar = 0.35;  // of the circle of latitude about the x axis turned to y
    for (int i = -8; i <= 8; ++i) {
      const double angle = i * 0.05;
      great.push_back({r * std::sin(angle), 0, r * std::cos(angle) - r});
      latitude.push_back({r * std::cos(polar) * std::sin(angle), r * std::sin(polar),
                          r * std::cos(polar) * std::cos(angle) - r});
    }
    const LocalShape round{.skin_u = 1 / r, .skin_v = 1 / r};
    Worst worst = errors(incision(sphere, great, 3, from_center), 8, [&](double) { return round; });
    record("great circle, sphere of 40", worst);
    EXPECT_LT(worst.curvature, 0.01 / r);
    EXPECT_LT(worst.u + worst.v + worst.uv, 0.03 / r);
    LocalShape should = round;
    should.curvature = std::tan(polar) / r;
    worst = errors(incision(sphere, latitude, 3, from_center), 8, [&](double) { return should; });
    record("circle of latitude, sphere of 40", worst);
    EXPECT_LT(worst.curvature, 0.02 * should.curvature);
    EXPECT_LT(worst.tilt, 1);
  }
}

TEST(PathShape, CylindersInAnyDirection) {
  for (const double r : {30., 50., 100.})
    for (const double h : {1., 2.5, 5.})
      for (const double jitter : {0., 0.25}) {
        const SurfaceMesh tube =
            skin(26, h, jitter, [r](double x, double) { return std::sqrt(r * r - x * x) - r; });
        Worst all;
        for (const double turn : {0., 0.5, pi / 4, 1.2, pi / 2}) {
          std::vector<Vec3> helix;
          for (int i = -15; i <= 15; ++i) {
            const double s = i, angle = s * std::cos(turn) / r;
            helix.push_back({r * std::sin(angle), s * std::sin(turn), r * std::cos(angle) - r});
          }
          const double c = std::cos(turn), n = std::sin(turn);
          const Incision cut = incision(tube, helix, 3, [r](const Vec3& p) { return Vec3{p.x, 0, p.z + r}; });
          const Worst worst = errors(cut, 8, [&](double) {
            return LocalShape{.skin_u = c * c / r, .skin_v = n * n / r, .skin_uv = -c * n / r};
          });
          all = {std::max(all.curvature, worst.curvature), std::max(all.u, worst.u), std::max(all.v, worst.v),
                 std::max(all.uv, worst.uv), std::max(all.tilt, worst.tilt)};
        }
        record("cylinder of " + std::to_string(int(r)) + ", edges " + std::to_string(h).substr(0, 3) +
                   (jitter > 0 ? ", irregular" : ""),
               all);
        EXPECT_LT(all.u, 0.03 / r);
        EXPECT_LT(all.v, 0.03 / r);
        EXPECT_LT(all.uv, 0.03 / r);
        EXPECT_LT(all.curvature, 0.03 / r);
        EXPECT_LT(all.tilt, 2);
      }
}

TEST(PathShape, Saddles) {
  for (const double h : {1.5, 4.})
    for (const double jitter : {0., 0.25}) {
      // x y / 40 at the origin, along x: the normal curvatures vanish, and the tensor's shear is -1/40.
      const Incision cut = incision(skin(26, h, jitter, [](double x, double y) { return x * y / 40; }),
                                    {{-8, 0, 0}, {0, 0, 0}, {8, 0, 0}});
      const LocalShape at = local_shape(cut, 1, 8, {8, 8});
      EXPECT_NEAR(at.skin_uv, -1. / 40, 0.03 / 40);
      EXPECT_NEAR(at.skin_u, 0, 0.03 / 40);
      EXPECT_NEAR(at.skin_v, 0, 0.03 / 40);
    }
}

TEST(PathShape, TorusInsideAndOutside) {
  constexpr double ring_radius = 60, inner = 30;
  const SurfaceMesh torus = ring(180, 90, ring_radius, inner, true);
  for (const double q : {0., 1., pi / 2, pi}) {  // pi: its inner side
    std::vector<Vec3> points;
    const double r = ring_radius + inner * std::cos(q);
    const auto outward = [&](const Vec3& p) {
      const double far = std::hypot(p.x, p.y);
      return Vec3{p.x / far * std::cos(q), p.y / far * std::cos(q), std::sin(q)};
    };
    for (int i = -10; i <= 10; ++i)
      points.push_back({r * std::cos(i * 1.5 / r), r * std::sin(i * 1.5 / r), inner * std::sin(q)});
    // Along a parallel, whose geodesic curvature is sin q / r, to the side of the ring's axis: across =
    // outward x along is toward it above.
    const Worst worst = errors(incision(torus, points, 3, outward), 8, [&](double) {
      return LocalShape{.curvature = std::sin(q) / r, .skin_u = std::cos(q) / r, .skin_v = 1 / inner};
    });
    record("torus, angle " + std::to_string(q).substr(0, 3), worst);
    EXPECT_LT(std::max({worst.u, worst.v, worst.uv}), 0.03 / inner);
    EXPECT_LT(worst.curvature, 0.0005);
  }
}

TEST(PathShape, NoiseOfAScanIsSmallBesideCurvature) {
  constexpr double r = 50;
  const SurfaceMesh rough = skin(
      26, 1.5, 0.2, [](double x, double) { return std::sqrt(r * r - x * x) - r; }, 0.05);
  std::vector<Vec3> points;
  for (int i = -10; i <= 10; ++i) points.push_back({0, 1.5 * i, 0});
  const Worst worst = errors(incision(rough, points), 8, [](double) { return LocalShape{.skin_v = 1 / r}; });
  record("noise of 0.05 mm", worst);
  EXPECT_LT(std::max({worst.u, worst.v, worst.uv, worst.curvature}), 0.002);
}

/// Of a cubic, against the residual of the same fit at its own places; of a quadric none.
TEST(PathShape, SkinThatIsNoQuadricIsUneven) {
  constexpr double cubic = 0.002, distance = 9;
  const auto of = [&](const std::function<double(double, double)>& height) {
    const Incision cut = incision(skin(30, 1, 0, height), {{-15, 0, 0}, {0, 0, 0}, {15, 0, 0}});
    return local_shape(cut, 1, 15, {distance, distance}).skin_uneven;
  };
  EXPECT_LT(of(flat), 1e-12);
  EXPECT_LT(of([](double x, double y) { return (x * x - 2 * x * y + y * y / 2) / 100; }), 0.01);
  // y^3 / 6 without its part in y: both over the disc with the weight 1 - r^2, in polar coordinates.
  // The means of y^2, y^4 and y^6 there are 1/6, 1/16 and 1/32.
  const double of_y = (1. / 16) / (1. / 6), left = std::sqrt(1. / 32 - of_y * (1. / 16)) / 6;
  EXPECT_NEAR(of([](double, double y) { return cubic * y * y * y / 6; }),
              cubic * std::pow(distance, 3) * left, 0.05 * cubic * std::pow(distance, 3) * left);
}

TEST(PathShape, TiltAndDepthAreTheBlades) {
  const SurfaceMesh plate = skin(30, 3, 0, flat);
  for (const double degrees : {-40., 20., 45.}) {
    // Across is +y for a path along +x: the bottom is there if the blade's outward direction is toward -y.
    const double tilt = degrees * pi / 180;
    const Incision cut = incision(plate, {{-15, 0, 0}, {0, 0, 0}, {15, 0, 0}}, 2.5, [&](const Vec3&) {
      return Vec3{0, -std::sin(tilt), std::cos(tilt)};
    });
    const LocalShape at = local_shape(cut, 2, 7, {6, 6});
    EXPECT_NEAR(at.tilt, degrees, 1e-9);
    EXPECT_NEAR(at.depth, 5, 1e-12);
  }
}

TEST(PathShape, LengthsAreInMm) {
  const auto ball = [](double x, double y) { return std::sqrt(40. * 40 - x * x - y * y) - 40; };
  SurfaceMesh mesh = skin(24, 2, 0.2, ball);
  const auto outward = [](const Vec3& p) { return p + Vec3{0, 0, 40}; };
  std::vector<Vec3> points;
  for (int i = -8; i <= 8; ++i) points.push_back({1.5 * i, 0.05 * i * i, ball(1.5 * i, 0.05 * i * i)});
  const Incision cut = incision(mesh, points, 3, outward);
  for (Vec3& p : mesh.points) p *= 0.1;
  for (Vec3& p : points) p *= 0.1;
  const Incision in_cm = incision(mesh, points, 0.3, [](const Vec3& p) { return p + Vec3{0, 0, 4}; });
  const PathShape a = shape_along(cut, 1, {6, 6}), b = shape_along(in_cm, 10, {6, 6});
  ASSERT_EQ(a.stations.size(), b.stations.size());
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    EXPECT_NEAR(a.values[i].curvature, b.values[i].curvature, 1e-6);
    EXPECT_NEAR(a.values[i].skin_u, b.values[i].skin_u, 1e-6);
    EXPECT_NEAR(a.values[i].skin_v, b.values[i].skin_v, 1e-6);
    EXPECT_NEAR(a.values[i].depth, b.values[i].depth, 1e-6);
  }
}

/// What the cut adds, moves and parts does not change the shape.
TEST(PathShape, IsTheSameAfterTheCut) {
  constexpr double r = 30;
  const SurfaceMesh tube = skin(26, 4, 0.25, [](double x, double) { return std::sqrt(r * r - x * x) - r; });
  std::vector<Vec3> points;
  for (int i = -10; i <= 10; ++i) points.push_back({0.3 * i, 1.5 * i, std::sqrt(r * r - 0.09 * i * i) - r});
  Incision cut = incision(tube, points, 3, [](const Vec3& p) { return Vec3{p.x, 0, p.z + r}; });
  const PathShape before = shape_along(cut, 1, {6, 6});
  cut.advance_to(cut.path().length());
  const PathShape after = shape_along(cut, 1, {6, 6});
  for (std::size_t i = 0; i < before.values.size(); ++i) {
    EXPECT_EQ(before.values[i].skin_u, after.values[i].skin_u);
    EXPECT_EQ(before.values[i].skin_v, after.values[i].skin_v);
    EXPECT_EQ(before.values[i].tilt, after.values[i].tilt);
    EXPECT_EQ(before.values[i].curvature, after.values[i].curvature);
  }
}

/// An earlier wound, which crosses the path, is closed at rest.
TEST(PathShape, IsTheSameOverAnEarlierWound) {
  constexpr double r = 30;
  const SurfaceMesh tube = skin(26, 3, 0.25, [](double x, double) { return std::sqrt(r * r - x * x) - r; });
  const auto outward = [](const Vec3& p) { return Vec3{p.x, 0, p.z + r}; };
  std::vector<Vec3> points, other;
  for (int i = -10; i <= 10; ++i) points.push_back({0, 1.5 * i, 0});
  for (int i = -6; i <= 6; ++i) other.push_back({1.0 * i, 1, std::sqrt(r * r - i * i) - r});
  CutMesh mesh(tube);
  Incision first(mesh, path_through(other, outward, 3), {});
  first.advance_to(first.path().length());
  const Worst worst = errors(Incision(mesh, path_through(points, outward, 3)), 6,
                             [](double) { return LocalShape{.skin_v = 1 / r}; });
  record("over an earlier wound, cylinder of 30", worst);
  EXPECT_LT(std::max({worst.u, worst.v, worst.uv}), 0.001 / r);
  EXPECT_LT(worst.curvature, 1e-6);
}

/// Where points are few the path is what is interpolated between them.
TEST(PathShape, OfSparsePoints) {
  const SurfaceMesh plate = skin(45, 3, 0, flat);
  for (const LocalShape& at : shape_along(incision(plate, {{-30, 3, 0}, {30, 3, 0}}), 1, {5, 5}).values)
    EXPECT_NEAR(at.curvature, 0, 1e-12);
  const Incision bent = incision(plate, {{-30, 0, 0}, {0, 6, 0}, {30, 0, 0}});  // a natural spline
  // y = 6 - 3 (x / 30)^2 (3 - |x| / 30), whose curvature at the middle is -18 / 900.
  EXPECT_NEAR(shape_along(bent, 1, {5, 5}).at(bent.path().length() / 2).curvature, -18. / 900,
              0.15 * 18. / 900);
  EXPECT_NEAR(shape_along(bent, 1, {5, 5}).at(0).curvature, 0, 0.2 * 18. / 900);
}

/// What lies across the path changes its sign; the skin's tensor does not.
TEST(PathShape, OfTheWayBack) {
  const SurfaceMesh tube = skin(26, 2, 0.2, [](double x, double) { return std::sqrt(900 - x * x) - 30; });
  const auto outward = [](const Vec3& p) { return Vec3{p.x, -5, p.z + 30}; };
  std::vector<Vec3> points;
  for (int i = -10; i <= 10; ++i) {
    const double x = i, y = 0.8 * i + 0.02 * i * i;
    points.push_back({x, y, std::sqrt(900 - x * x) - 30});
  }
  const PathShape there = shape_along(incision(tube, points, 3, outward), 1, {6, 6});
  std::reverse(points.begin(), points.end());
  const PathShape back = shape_along(incision(tube, points, 3, outward), 1, {6, 6});
  for (double s = 0; s <= there.stations.back(); s += 1) {
    const LocalShape a = there.at(s), b = back.at(there.stations.back() - s);
    EXPECT_GT(a.curvature, 0.008);
    EXPECT_NEAR(a.curvature, -b.curvature, 2e-4);
    EXPECT_GT(a.tilt, 3);
    EXPECT_NEAR(a.tilt, -b.tilt, 0.1);
    EXPECT_NEAR(a.skin_u, b.skin_u, 2e-4);
    EXPECT_NEAR(a.skin_v, b.skin_v, 2e-4);
    EXPECT_NEAR(a.skin_uv, b.skin_uv, 2e-4);
  }
}

TEST(ScalpelPath, KnowsThePointsItWasMadeOf) {
  ScalpelPath path = path_through({{0, 0, 0}, {1, 0, 0}, {3, 0, 0}}, up, 1);
  const auto places = [](const ScalpelPath& p) { return p.given(); };
  ASSERT_EQ(places(path).size(), 3u);
  EXPECT_NEAR(places(path)[1], 1, 1e-12);
  EXPECT_EQ(places(path)[2], path.length());
  EXPECT_NEAR(places(path.scaled(2))[1], 2, 1e-12);
  const double next = path.extend(2, {{2.5, 0, 0}, {0, 0, 1}, 1}, 4);
  ASSERT_EQ(places(path).size(), 4u);
  EXPECT_EQ(places(path)[2], 2);
  EXPECT_EQ(places(path)[3], next);
}

/// Two plates, one above the other, that are joined at one edge: the lower one is skin of its own.
TEST(PathShape, TheFarSideOfAFoldDoesNotCount) {
  SurfaceMesh fold;
  constexpr double gap = 2;
  const int around = 6, flat_cells = 20;
  std::vector<std::pair<double, double>> profile;  // x, z
  for (int i = 0; i <= flat_cells; ++i) profile.emplace_back(-flat_cells + i, 0.);
  for (int i = 1; i < around; ++i)
    profile.emplace_back(gap / 2 * std::sin(pi * i / around), gap / 2 * (std::cos(pi * i / around) - 1));
  for (int i = 0; i <= flat_cells; ++i) profile.emplace_back(-i, -gap);
  const int rows = 41, columns = static_cast<int>(profile.size());
  for (int j = 0; j < rows; ++j)
    for (const auto& [x, z] : profile) fold.points.push_back({x, j - 20., z});
  for (int j = 0; j + 1 < rows; ++j)
    for (int i = 0; i + 1 < columns; ++i) {
      const int a = j * columns + i, b = a + 1, c = a + columns, d = c + 1;
      fold.triangles.push_back({a, b, d});
      fold.triangles.push_back({a, d, c});
    }
  const Incision cut = incision(fold, {{-5, -8, 0}, {-5, 0, 0}, {-5, 8, 0}}, 1);
  for (const LocalShape& at : shape_along(cut, 1, {4.5, 4.5}).values) {
    EXPECT_NEAR(at.skin_u, 0, 1e-12);
    EXPECT_NEAR(at.skin_v, 0, 1e-12);
  }
  for (const LocalShape& at : shape_along(cut, 1, {7, 7}).values) {  // as far as the bent edge: it bulges
    EXPECT_NEAR(at.skin_u, 0, 1e-3);
    EXPECT_GT(at.skin_v, 0);
    EXPECT_LT(at.skin_v, 0.01);
  }
}

TEST(PathShape, IsFiniteAtRimsOfShortPathsAndOfLoops) {
  constexpr double r = 30;
  const auto shape = [](double x, double) { return std::sqrt(r * r - x * x) - r; };
  const SurfaceMesh tube = skin(12, 2, 0.2, shape);
  const auto outward = [](const Vec3& p) { return Vec3{p.x, 0, p.z + r}; };
  const auto finite = [](const PathShape& all) {
    for (const LocalShape& at : all.values)
      for (const double x : {at.curvature, at.tilt, at.depth, at.skin_u, at.skin_v, at.skin_uv})
        EXPECT_TRUE(std::isfinite(x) && std::abs(x) < 10);
  };
  std::vector<Vec3> rim, loop;
  for (int i = -11; i <= 11; ++i) rim.push_back({11, double(i), shape(11, 0)});
  const Incision at_rim = incision(tube, rim, 3, outward);
  finite(shape_along(at_rim, 1, {6, 6}));
  const Worst worst = errors(at_rim, 6, [](double) { return LocalShape{.skin_v = 1 / r}; });
  record("1 mm from the rim of a cylinder of 30", worst);
  EXPECT_LT(std::max({worst.u, worst.v, worst.uv}), 0.1 / r);
  for (int i = 0; i <= 40; ++i) {
    const double x = 6 * std::cos(2 * pi * i / 40), y = 6 * std::sin(2 * pi * i / 40);
    loop.push_back({x, y, shape(x, y)});
  }
  const PathShape round = shape_along(incision(tube, loop, 3, outward), 1, {6, 6});
  finite(round);
  for (const LocalShape& at : round.values) EXPECT_NEAR(at.curvature, 1. / 6, 0.02 / 6);
  const PathShape little =
      shape_along(incision(tube, {{0, 0, 0}, {0, 1.1, 0}, {0, 2, 0}}, 3, outward), 1, {6, 6});
  finite(little);
  EXPECT_NEAR(little.at(1).skin_v, 1 / r, 0.03 / r);
  finite(shape_along(incision(tube, {{0, 0, 0}, {0, 1, 0}, {0.5, 1.7, 0}}, 3, outward), 1, {6, 6}));
  const SurfaceMesh few{{{-9, -9, 0}, {9, -9, 0}, {0, 9, 0}}, {{0, 1, 2}}};
  finite(shape_along(incision(few, {{-2, -2, 0}, {2, -2, 0}}), 1, {5, 5}));
}

/// A path that is found as the blade moves has the shape of what has been cut.
TEST(PathShape, OfALiveCutEndsAtTheBlade) {
  const SurfaceMesh plate = skin(45, 2, 0.2, flat);
  const std::vector<Vec3> points = arc(25, 40, 1);
  Incision cut = incision(plate, {points[0], points[1]});
  for (std::size_t i = 1; i < points.size(); ++i) cut.extend({points[i], {0, 0, 1}, 3}, 5);
  const PathShape shape = shape_along(cut, 1, {8, 8});
  EXPECT_NEAR(shape.stations.back(), cut.extended_to(), 1e-12);
  for (const LocalShape& at : shape.values) EXPECT_NEAR(at.curvature, 1. / 25, 0.02 / 25);
  EXPECT_EQ(local_shape(cut, 1, shape.stations.back(), {8, 8}).curvature, shape.values.back().curvature);
}

TEST(PathShape, TakesMillisecondsOnALargeMesh) {
  const SurfaceMesh large = skin(160, 1, 0.2, [](double x, double y) { return -(x * x + y * y) / 400; });
  std::vector<Vec3> points;
  for (int i = -30; i <= 30; ++i) points.push_back({double(i), 0, -i * i / 400.});
  IncisionOptions options;
  options.reach = 25;
  const Incision cut(large, path_through(points, up, 3), options);
  const auto begin = std::chrono::steady_clock::now();
  const PathShape shape = shape_along(cut, 1, {8, 8});
  const double all = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const auto then = std::chrono::steady_clock::now();
  for (int i = 0; i < 20; ++i) local_shape(cut, 1, 20 + i, {8, 8});
  const double one = std::chrono::duration<double>(std::chrono::steady_clock::now() - then).count() / 20;
  std::printf("  %zu vertices: %zu stations in %.1f ms, one in %.2f ms\n", cut.mesh().vertices().size(),
              shape.stations.size(), 1e3 * all, 1e3 * one);
  EXPECT_LT(all, 1);
}

TEST(PathShape, IsLinearBetweenStations) {
  const PathShape shape{{0, 2}, {{.curvature = 1, .skin_uv = 4}, {.curvature = 3, .tilt = 10}}};
  EXPECT_EQ(shape.at(-1).curvature, 1);
  EXPECT_EQ(shape.at(0.5).curvature, 1.5);
  EXPECT_EQ(shape.at(0.5).tilt, 2.5);
  EXPECT_EQ(shape.at(1).skin_uv, 2);
  EXPECT_EQ(shape.at(5).curvature, 3);
}

TEST(PathShape, RefusesWhatIsNoLength) {
  const Incision cut = incision(skin(20, 3, 0, flat), {{-5, 0, 0}, {5, 0, 0}});
  EXPECT_THROW(shape_along(cut, 1, {0, 0}), InputError);
  EXPECT_THROW(local_shape(cut, 0, 1, {5, 5}), InputError);
}

}  // namespace
}  // namespace cleft
