#include "explorer/body/extrusion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "params/meshed_cut.h"
#include "tests/bodies/subjects.h"

namespace cleft {

namespace {

LinedSurface uncut(const testing::Bend& bend) {
  LinedSurface s;
  s.mesh = testing::sheet(bend, 12, 12, 1.5, 0.2);
  s.outline.assign(s.mesh.points.size(), false);
  return s;
}

}  // namespace

/// They go on below the cut with the grading; the case's depth is above the closed nodes by the front.
TEST(Extrusion, LayersBeginAtTheSkinAndEndAtTheThickness) {
  for (const double size : {0.5, 1., 2.})
    for (const double depth : {1., 3., 4.5}) {
      Parameters p;
      p.patch.height = 8, p.mesh.element_size = size, p.mesh.grading = 1.3;
      const Layers layers = make_layers(p, depth);
      ASSERT_EQ(layers.depth.front(), 0);
      EXPECT_DOUBLE_EQ(layers.depth.back(), 8);
      EXPECT_NEAR(layers.depth[layers.bottom] - layers.front, depth, 1e-12);
      const double step = layers.depth[1];
      EXPECT_NEAR(layers.front, front_parts(p).bottom * step, 1e-12);
      EXPECT_LE(step, size * 1.3 + 1e-12);
      for (std::size_t k = 1; k < layers.depth.size(); ++k) {
        const double here = layers.depth[k] - layers.depth[k - 1];
        if (static_cast<int>(k) <= layers.bottom)
          EXPECT_NEAR(here, step, 1e-12);
        else
          EXPECT_LE(here, 1.3 * (layers.depth[k - 1] - layers.depth[k - 2]) + 1e-12);
      }
    }
}

TEST(Extrusion, ACutAsDeepAsTheTissueIsRefused) {
  Parameters p;
  p.patch.height = 3;
  try {
    make_layers(p, 3);
    FAIL() << "not refused";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("patch.height = 3"), std::string::npos) << e.what();
  }
}

/// Columns end at bone, and keep the layers of the cut as far as they fit.
TEST(Extrusion, ColumnsEndAtBone) {
  Parameters p;
  p.patch.height = 8;
  const LinedSurface s = uncut(testing::flat);
  const auto depth = [](double x, double) { return 6 + 0.3 * x; };  // 2.4 to 9.6 mm
  const SurfaceIndex bone(testing::sheet(testing::below(testing::flat, depth), 20, 20, 1));
  const Layers layers = make_layers(p, 2);
  const Extrusion e = extrude(s, layers, std::vector<Vec3>(s.mesh.points.size()), &bone);
  for (int point = 0; point < static_cast<int>(s.mesh.points.size()); ++point) {
    const Vec3& at = s.mesh.points[point];
    EXPECT_EQ(e.on_bone[point], depth(at.x, 0) < 8) << at.x;
    EXPECT_NEAR(e.thickness[point], std::min(8., depth(at.x, 0)), 1e-9);
    const int last = static_cast<int>(layers.depth.size()) - 1;
    EXPECT_NEAR(e.node(s, layers, point, last).z, -e.thickness[point], 1e-9);
    const double cut = layers.depth[layers.bottom];
    EXPECT_NEAR(e.cut_depth(layers, point), std::min(cut, 0.8 * e.thickness[point]), 1e-12);
    EXPECT_NEAR(e.node(s, layers, point, layers.bottom).z, -e.cut_depth(layers, point), 1e-9);
  }
}

TEST(Extrusion, BoneAboveTheSkinIsRefused) {
  const LinedSurface s = uncut(testing::flat);
  const SurfaceIndex bone(
      testing::sheet(testing::below(testing::flat, [](double x, double) { return 2 - x; }), 20, 20, 1));
  try {
    extrude(s, make_layers({}, 2), std::vector<Vec3>(s.mesh.points.size()), &bone);
    FAIL() << "not refused";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("bone lies above the skin at ("), std::string::npos) << e.what();
  }
}

/// Below a leaning blade columns lean as it does, and less and less away from it; all end at the same depth,
/// none is thinned.
TEST(Extrusion, ALeaningBladeThinsNothing) {
  for (const double degrees : {0., 15., 30., 45., 60.})
    for (const auto& bend : {testing::Bend(testing::flat), testing::sphere_cap(80)}) {
      LinedSurface s;
      s.mesh = testing::sheet(bend, 44, 44, 1.1);
      s.outline.assign(s.mesh.points.size(), false);
      const Layers layers = make_layers({}, 3);
      const double angle = degrees * std::numbers::pi / 180, tangent = std::tan(angle);
      std::vector<Vec3> blade(s.mesh.points.size());
      const std::vector<Vec3> normals = normals_of(s.mesh);
      for (std::size_t p = 0; p < blade.size(); ++p) {
        const Vec3 &at = s.mesh.points[p], &normal = normals[p];
        if (std::abs(at.y) > 1e-9 || std::abs(at.x) > 8.9) continue;
        const Vec3 across = normalized(Vec3{0, 1, 0} - normal.y * normal);
        blade[p] = -std::cos(angle) * normal + std::sin(angle) * across;
      }
      const Extrusion e = extrude(s, layers, blade, nullptr);
      EXPECT_EQ(e.thinned, 0) << degrees;
      EXPECT_TRUE(e.turned.empty());
      EXPECT_GT(e.least_determinant, 0.3) << degrees;
      for (std::size_t p = 0; p < blade.size(); ++p) {
        if (squared_norm(blade[p]) > 0) EXPECT_LT(norm(e.inward[p] - blade[p]), 1e-12);
        // Directions are means; of a sphere's outline the normals are of half a neighbourhood.
        const double deep = -e.thickness[p] * dot(e.inward[p], normals[p]);
        EXPECT_NEAR(deep, 8, 0.05 * 8 * std::max(1., tangent)) << degrees << " " << s.mesh.points[p].y;
        if (norm(s.mesh.points[p]) > 3 * 8 * tangent + 20)
          EXPECT_GT(-dot(e.inward[p], normals[p]), 0.99) << degrees;
      }
    }
}

/// A path with the normals of a coarse mesh's vertices turns its blade faster than wedges as wide as elements
/// bear: columns go by the mean of those around them, rather than that the cut becomes shallow.
TEST(Extrusion, BladesThatTurnFastAreEvenedOut) {
  for (const double degrees : {10., 25., 40.}) {
    LinedSurface s;
    s.mesh = testing::sheet(testing::sphere_cap(40), 30, 30, 1);
    s.outline.assign(s.mesh.points.size(), false);
    const Layers layers = make_layers({}, 3);
    const double angle = degrees * std::numbers::pi / 180;
    std::vector<Vec3> blade(s.mesh.points.size());
    const std::vector<Vec3> normals = normals_of(s.mesh);
    for (std::size_t p = 0; p < blade.size(); ++p) {
      const Vec3& at = s.mesh.points[p];
      if (std::abs(at.y) > 1e-9 || std::abs(at.x) > 8.9) continue;
      const bool odd = static_cast<int>(std::floor(at.x / 2)) % 2 != 0;
      const Vec3 along = normalized(Vec3{1, 0, 0} - normals[p].x * normals[p]);
      blade[p] = -std::cos(angle) * normals[p] + (odd ? 1 : -1) * std::sin(angle) * along;
    }
    const Extrusion e = extrude(s, layers, blade, nullptr);
    EXPECT_TRUE(e.turned.empty()) << degrees;
    EXPECT_GE(e.least_determinant, 0.2) << degrees;
    double largest = 0;
    for (std::size_t p = 0; p < blade.size(); ++p)
      if (squared_norm(blade[p]) > 0) {
        EXPECT_GT(e.cut_depth(layers, static_cast<int>(p)), 0.65 * layers.depth[layers.bottom]) << degrees;
        largest = std::max(largest, std::acos(std::min(1., dot(blade[p], e.inward[p]))));
      }
    EXPECT_NEAR(e.blade_turn, largest, 1e-6) << degrees;
    EXPECT_LT(largest, angle) << degrees;
  }
}

/// A sharp ridge and a thin lamella are too thin for the whole thickness: the tissue becomes thinner there,
/// and no wedge is turned inside out.
TEST(Extrusion, NoWedgeTurnsInsideOut) {
  for (const auto& bend : {testing::ridge(2, 0.5), testing::lamella(5, 3), testing::saddle(10),
                           testing::cylinder_along(6), testing::sphere_cap(15)}) {
    const LinedSurface s = uncut(bend);
    const Layers layers = make_layers({}, 2);
    const Extrusion e = extrude(s, layers, std::vector<Vec3>(s.mesh.points.size()), nullptr);
    double least = 1e9;
    for (int t = 0; t < static_cast<int>(s.mesh.triangles.size()); ++t) {
      if (std::find(e.turned.begin(), e.turned.end(), t) != e.turned.end()) continue;
      const auto& c = s.mesh.triangles[t];
      for (std::size_t k = 0; k + 1 < layers.depth.size(); ++k)
        for (const int layer : {0, 1})
          for (int i = 0; i < 3; ++i) {
            const auto node = [&](int corner, int l) {
              return e.node(s, layers, c[corner % 3], static_cast<int>(k) + l);
            };
            const Vec3 here = node(i, layer);
            least = std::min(least, dot(cross(node(i + 1, layer) - here, node(i + 2, layer) - here),
                                        node(i, 0) - node(i, 1)));
          }
    }
    EXPECT_GT(least, 0);
    EXPECT_LT(e.turned.size(), s.mesh.triangles.size() / 20);
    for (const double thickness : e.thickness) EXPECT_GE(thickness, 0.1 * 8 - 1e-12);
  }
}

}  // namespace cleft
