// The maps of shaped patches against closed forms, and the meshes made with them.
#include "solver/patch_shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "params/consistency.h"
#include "params/meshed_cut.h"
#include "params/parameters/table.h"
#include "solver/patch_mesh.h"

namespace cleft {

namespace {

/// A coarse patch whose cut of 12 mm has nodes every 2 mm.
Parameters coarse() {
  Parameters p;
  p.patch.length = p.patch.width = 60, p.patch.height = 6;
  p.mesh.element_size = 2;
  p.cut.length = 12, p.cut.depth = 3;
  return p;
}

std::string refusal_of(const Parameters& p) {
  try {
    check_consistency(p, "here");
    make_patch_mesh(p);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

/// The nearest place of a cut of curvature k, which grows by `rate` for each mm, and half length h, with
/// straight continuations, by search.
std::array<double, 2> searched(const Vec3& at, double k, double rate, double h) {
  std::array<double, 2> best{};
  double nearest = 1e9;
  constexpr double step = 1e-3;
  for (const double way : {1., -1.}) {
    Vec3 c;
    double a = 0;
    for (double s = 0; s <= 40; s += step) {
      const Vec3 off = at - c;
      if (norm(off) < nearest) {  // within half a step: the distance is the one across the curve there
        nearest = norm(off);
        best = {way * s, std::cos(a) * off.y - std::sin(a) * off.x};
      }
      const double inside = std::clamp(h - s, 0., step);
      const double turn = (k + rate * way * (s + inside / 2)) * way * inside;
      c += way * step * Vec3{std::cos(a + turn / 2), std::sin(a + turn / 2), 0};
      a += turn;
    }
  }
  return best;
}

}  // namespace

TEST(PatchShape, AStraightOneIsTheBoxItself) {
  const PatchShape shape{Parameters()};
  for (const Vec3& at : {Vec3{0, 0, 0}, Vec3{-31, 7, -3}, Vec3{50, -50, -8}}) {
    EXPECT_EQ(shape.depth(at.y, at.z), -at.z);
    EXPECT_EQ(shape.place(at.x, at.y, -at.z), at);
    EXPECT_EQ(shape.coordinates(at.x, at.y), (std::array{at.x, at.y}));
    EXPECT_EQ(shape.frame(at.x), (std::array{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}));
  }
  const PatchMesh mesh = make_patch_mesh(coarse());
  EXPECT_TRUE(mesh.canonical.empty() && mesh.frames.empty() && mesh.tension.empty() && mesh.on_bone.empty());
}

TEST(PatchShape, ACurvedCutIsAnArcOfItsLength) {
  for (const double k : {0.05, -0.1}) {
    Parameters p = coarse();
    p.cut.curvature = k;
    const PatchMesh mesh = make_patch_mesh(p);
    for (const NodePair& pair : mesh.pairs) {
      const Vec3& at = mesh.points[pair.left];
      const double angle = k * pair.along;
      EXPECT_NEAR(at.x, std::sin(angle) / k, 1e-8);
      EXPECT_NEAR(at.y, (1 - std::cos(angle)) / k, 1e-8);
      EXPECT_EQ(mesh.canonical[pair.left], (Vec3{pair.along, 0, -pair.depth}));
      EXPECT_NEAR(norm(pair.normal - Vec3{-std::sin(angle), std::cos(angle), 0}), 0, 1e-12);
      EXPECT_NEAR(norm(mesh.frames[pair.right][0] - Vec3{std::cos(angle), std::sin(angle), 0}), 0, 1e-12);
    }
  }
}

TEST(PatchShape, CoordinatesAreThoseOfTheNearestPlace) {
  Parameters p = coarse();
  for (const auto& [k, rate] : {std::pair{0.03, 0.}, {-0.12, 0.}, {0., 0.02}, {0.05, -0.015}}) {
    p.cut.curvature = k, p.cut.curvature_rate = rate;
    const PatchShape shape(p);
    const double h = meshed_cut(p).length / 2;
    for (const double u : {-20., -7., -2.5, 0.3, 6., 11.})
      for (const double v : {-15., -4., 0.5, 3., 12.}) {
        const auto [along, across] = shape.coordinates(u, v);
        const auto [s, d] = searched(shape.place(u, v, 0), k, rate, h);
        EXPECT_NEAR(across, d, 1e-6) << k << " " << u << " " << v;
        EXPECT_NEAR(along, s, 1e-2) << k << " " << u << " " << v;
      }
  }
}

TEST(PatchShape, ThePlanesDeterminantIsThatOfItsMap) {
  Parameters p = coarse();
  constexpr double h = 1e-3;
  for (const auto& [k, rate] : {std::pair{0.1, 0.}, {0.02, 0.01}}) {
    p.cut.curvature = k, p.cut.curvature_rate = rate;
    const PatchShape shape(p);
    for (const double u : {-25., -8., -3., 0.7, 6.5, 9., 14.})
      for (const double v : {-20., -5., -1., 2., 9., 25.}) {
        const Vec3 along = 0.5 / h * (shape.place(u + h, v, 0) - shape.place(u - h, v, 0));
        const Vec3 across = 0.5 / h * (shape.place(u, v + h, 0) - shape.place(u, v - h, 0));
        EXPECT_NEAR(shape.plane_determinant(u, v), along.x * across.y - along.y * across.x, 1e-5);
        EXPECT_GT(shape.plane_determinant(u, v), 0.1);
      }
  }
}

TEST(PatchShape, NearTheCutTheSkinIsACylinderOrASphere) {
  const auto deviation = [](const Parameters& p, double radius, const auto& from_axis) {
    const PatchMesh mesh = make_patch_mesh(p);
    double worst = 0;
    for (std::size_t n = 0; n < mesh.points.size(); ++n)
      if (const Vec3& c = mesh.canonical[n]; std::abs(c.x) < 8 && std::abs(c.y) < 8)
        worst = std::max(worst, std::abs(from_axis(mesh.points[n] + Vec3{0, 0, radius}) - (radius + c.z)));
    return worst;
  };
  Parameters p = coarse();
  p.skin.curvature_v = 0.05;
  EXPECT_LT(deviation(p, 20, [](const Vec3& r) { return std::hypot(r.y, r.z); }), 1e-7);
  p.skin.curvature_u = 0.05;
  EXPECT_LT(deviation(p, 20, [](const Vec3& r) { return norm(r); }), 1e-7);
  p.skin.curvature_v = 0;
  EXPECT_LT(deviation(p, 20, [](const Vec3& r) { return std::hypot(r.x, r.z); }), 1e-7);
}

/// The second fundamental form in the middle, by differences of the surface's place.
TEST(PatchShape, TheSkinHasTheCurvaturesThatAreAskedFor) {
  Parameters p = coarse();
  p.skin.curvature_u = 0.02, p.skin.curvature_v = -0.03, p.skin.curvature_uv = 0.015;
  const PatchShape shape(p);
  constexpr double h = 0.05;
  const auto height = [&](double u, double v) { return shape.place(u, v, 0).z; };
  EXPECT_NEAR((height(h, 0) + height(-h, 0)) / (h * h), -0.02, 1e-5);
  EXPECT_NEAR((height(0, h) + height(0, -h)) / (h * h), 0.03, 1e-5);
  EXPECT_NEAR((height(h, h) - height(h, -h) - height(-h, h) + height(-h, -h)) / (4 * h * h), -0.015, 1e-5);
  // The frame of the cut turns with the skin.
  const auto [along, across, outward] = shape.frame(4);
  EXPECT_NEAR(norm(cross(along, across) - outward), 0, 1e-12);
  const Vec3 tangent = 1e4 * (shape.place(4 + 5e-5, 0, 0) - shape.place(4 - 5e-5, 0, 0));
  EXPECT_NEAR(norm(along - tangent), 0, 1e-6);
  EXPECT_NEAR(norm(shape.place(4, 0, 2) - shape.place(4, 0, 0) + 2 * outward), 0, 1e-12);
  EXPECT_NEAR(norm(shape.tension(4, 0) - along), 0, 1e-12);
}

/// Everywhere, by differences: near the cut, and where curvatures turn back.
TEST(PatchShape, DepthIsAlongTheNormalAndTensionAlongTheImageOfTheFirstAxis) {
  Parameters p = coarse();
  p.skin.curvature_u = 0.02, p.skin.curvature_v = -0.03, p.skin.curvature_uv = 0.015;
  const PatchShape shape(p);
  constexpr double h = 1e-4;
  for (const double u : {-28., -14., -4., 3., 11., 17., 24.})
    for (const double v : {-29., -19., -6., 2., 8., 16., 22.}) {
      const Vec3 along = 0.5 / h * (shape.place(u + h, v, 0) - shape.place(u - h, v, 0));
      const Vec3 across = 0.5 / h * (shape.place(u, v + h, 0) - shape.place(u, v - h, 0));
      EXPECT_NEAR(norm(shape.tension(u, v) - normalized(along)), 0, 1e-6);
      const Vec3 outward = shape.place(u, v, 0) - shape.place(u, v, 1);
      EXPECT_NEAR(norm(outward - normalized(cross(along, across))), 0, 1e-6);
    }
}

/// Twist as at 45 degrees on a cylinder of 30 mm, together with what else a family has.
TEST(PatchShape, TwistedPatchesDoNotFold) {
  Parameters p;
  p.cut.length = 36, p.mesh.element_size = 2, p.skin.curvature_uv = 1 / 60.;
  for (const auto& [other, most] : {std::pair{&p.skin.curvature_u, 1 / 30.},
                                    {&p.skin.curvature_v, 1 / 30.},
                                    {&p.cut.curvature, 1 / 15.},
                                    {&p.cut.curvature_rate, 0.005},
                                    {&p.cut.tilt, 45.}})
    for (const double value : {-most, most}) {
      *other = value;
      EXPECT_NO_THROW(make_patch_mesh(p));
      *other = 0;
    }
  p.skin.curvature_u = p.skin.curvature_v = 1 / 60.;
  EXPECT_NO_THROW(make_patch_mesh(p));
}

TEST(PatchShape, ItsBottomSlopesAndLevelsOff) {
  Parameters p = coarse();
  p.patch.slope = 0.3;
  const PatchShape shape(p);
  const double cut = meshed_cut(p).depth;
  EXPECT_EQ(shape.depth(5, -cut / 2), cut / 2);
  EXPECT_NEAR(shape.depth(0.1, -6), 6.03, 1e-5);
  EXPECT_NEAR(shape.depth(-0.1, -6), 5.97, 1e-5);
  EXPECT_NEAR(shape.depth(500, -6), 1.75 * 6, 1e-9);
  EXPECT_NEAR(shape.depth(-500, -6), cut + 0.25 * (6 - cut), 1e-9);
  const PatchMesh mesh = make_patch_mesh(p);
  for (std::size_t n = 0; n < mesh.points.size(); ++n) EXPECT_EQ(mesh.points[n], mesh.canonical[n]);
}

/// The mesh of a tilted cut is not moved along it, and its coordinates are those of the upright one.
TEST(PatchShape, ATiltedCutsCoordinatesAreUpright) {
  Parameters p = coarse();
  p.cut.tilt = 25;
  const PatchMesh tilted = make_patch_mesh(p);
  ASSERT_EQ(tilted.canonical.size(), tilted.points.size());
  for (const NodePair& pair : tilted.pairs) {
    EXPECT_EQ(tilted.canonical[pair.left], (Vec3{pair.along, 0, -pair.depth}));
    EXPECT_NEAR(tilted.points[pair.right].y, std::tan(25 * std::numbers::pi / 180) * pair.depth, 1e-12);
  }
  for (std::size_t n = 0; n < tilted.points.size(); ++n) EXPECT_EQ(tilted.canonical[n].x, tilted.points[n].x);
  EXPECT_TRUE(tilted.tension.empty());
  p.cut.radius = 40;
  EXPECT_TRUE(make_patch_mesh(p).canonical.empty());
}

/// Of a patch whose shape is the mirror image in v = 0 and in the plane of the diagonals: its nodes are.
TEST(PatchShape, MirroredShapesAreMirrorImages) {
  Parameters p = coarse();
  p.cut.curvature = 0.06, p.cut.curvature_rate = 0.004, p.cut.tilt = 20, p.patch.slope = 0.2;
  p.skin.curvature_u = 0.02, p.skin.curvature_v = 0.03, p.skin.curvature_uv = 0.01;
  Parameters q = p;
  q.cut.curvature = -0.06, q.cut.curvature_rate = -0.004, q.cut.tilt = -20, q.patch.slope = -0.2,
  q.skin.curvature_uv = -0.01;
  const PatchShape shape(p), mirrored(q);
  for (const double u : {-22., -5., 1., 12.})
    for (const double v : {-18., -2., 3., 20.}) {
      const Vec3 at = shape.place(u, v, 2), image = mirrored.place(u, -v, 2);
      EXPECT_NEAR(norm(at - Vec3{image.x, -image.y, image.z}), 0, 1e-11);
      EXPECT_NEAR(shape.depth(v, -5), mirrored.depth(-v, -5), 1e-12);
      EXPECT_NEAR(shape.coordinates(u, v)[0], mirrored.coordinates(u, -v)[0], 1e-11);
      EXPECT_NEAR(shape.coordinates(u, v)[1], -mirrored.coordinates(u, -v)[1], 1e-11);
    }
}

TEST(PatchShape, WhatCannotBeIsRefused) {
  const std::pair<const char*, const char*> cases[] = {
      {"cut.radius=40", "cut.curvature = 0.05 1/mm, cut.radius = 40 mm: a cut curves by one of them"},
      {"cut.length=52", "cut.length = 52 mm would turn by"},
      {"model=finite", "model = finite: not with cut.curvature so far; set it to small"},
      {"skin.bending_stiffness=1", "skin.bending_stiffness = 1: not with cut.curvature"},
      {"skin.edges=free", "skin.edges = free: not with cut.curvature so far; set it to held"},
      {"tissue.prestress_share=0.5", "tissue.prestress_share = 0.5: not with cut.curvature"},
      {"cut.count=2", "cut.count = 2: not with cut.curvature so far; set it to 1"},
      {"cut.branch=4", "cut.branch = 4: not with cut.curvature so far; set it to 0"},
      {"cut.curvature=0.19", "cut.curvature = 0.19 1/mm: the patch would fold beside the cut"},
      {"skin.curvature_u=0.1", "skin.curvature_u = 0.1 1/mm: the elements at u, v, w = "},
  };
  for (const auto& [assignment, message] : cases) {
    Parameters p = coarse();
    p.cut.curvature = 0.05, p.patch.height = 12;
    set_from_text(p, assignment, "test");
    EXPECT_NE(refusal_of(p).find(message), std::string::npos) << assignment << ": " << refusal_of(p);
  }
  Parameters p = coarse();
  p.foundation.stiffness = p.foundation.side_stiffness = 0;
  EXPECT_NE(refusal_of(p).find("the patch would float"), std::string::npos);
  p.patch.bottom = PatchBottom::bone;
  EXPECT_EQ(refusal_of(p), "");
  EXPECT_NE(row_of(p, p.skin.curvature_v).help, "");
}

}  // namespace cleft
