// Shaped patches: the same physics as bodies of these shapes, and mirror images of mirrored ones.
#include <gtest/gtest.h>

#include <cmath>

#include "solver/body_mesh.h"
#include "solver/snapshot/snapshot.h"
#include "solver/solve.h"
#include "tests/support/patch_body.h"
#include "tests/support/temporary_folder.h"

namespace cleft {

namespace {

Parameters of_shape() {
  Parameters p;
  p.patch.length = p.patch.width = 50, p.patch.height = 6;
  p.mesh.element_size = 2;
  p.cut.length = 12, p.cut.depth = 3;
  return p;
}

struct SolvedShape {
  SolveReport report;
  Snapshot snapshot;
  std::vector<std::vector<Vec3>> frames;
};

SolvedShape solved_shape(const Parameters& p, const SolveOptions& options = {}) {
  const TemporaryFolder folder;
  SolveOptions o = options;
  o.estimate = false;
  const std::string out = folder / "case.h5";
  SolvedShape s{
      solve_cases({{o.body ? parameters_of(*o.body, p) : p, out}}, o, MPI_COMM_WORLD, [](auto&) {})[0],
      {},
      {}};
  EXPECT_EQ(s.report.failure, "");
  const SnapshotReader reader(out);
  s.snapshot = reader.snapshot();
  for (std::size_t f = 0; f < s.snapshot.frames(); ++f) s.frames.push_back(reader.displacement(f));
  return s;
}

double gape_of_body(const Parameters& p, const std::function<BentPlace(const Vec3&)>& bend) {
  SolveOptions options;
  options.body = std::make_shared<const Body>(body_of_patch(p, bend));
  return solved_shape(p, options).report.gape;
}

}  // namespace

/// Nothing moves before the cut, to the last bit, whatever the shape.
TEST(ShapedPatch, IsAtRestWhileItIsClosed) {
  Parameters p = of_shape();
  p.cut.curvature = 0.06, p.cut.tilt = 20, p.patch.slope = 0.2;
  p.skin.curvature_u = 0.02, p.skin.curvature_v = 0.03, p.skin.curvature_uv = 0.01;
  const SolvedShape s = solved_shape(p);
  for (const Vec3& d : s.frames.front()) ASSERT_EQ(d, Vec3{});
  EXPECT_GT(s.report.gape, 0.5);
  EXPECT_TRUE(s.snapshot.coordinates);
  EXPECT_EQ(s.snapshot.parameters->cut.curvature, 0.06);
  EXPECT_EQ(s.snapshot.tension.size(), s.snapshot.skin().size());
}

/// A patch bent around a cylinder, its curvature constant to its sides.
TEST(ShapedPatch, OpensAsABodyOfItsShape) {
  Parameters p = of_shape();
  const double around = gape_of_body(p, around_cylinder(40)), flat_gape = gape_of_body(p, flat);
  p.skin.curvature_v = 1. / 40;
  const double shaped = solved_shape(p).report.gape;
  EXPECT_NEAR(shaped, around, 0.005 * around);
  EXPECT_GT(around, 1.03 * flat_gape);
}

/// cut.radius moves the nodes of a box, and has no coordinates; the physics are the same.
TEST(ShapedPatch, ACurvedCutOpensAsOneOfItsRadius) {
  Parameters p = of_shape();
  p.mesh.element_size = 1;
  p.cut.radius = 20;
  const double radius = solved_shape(p).report.gape;
  p.cut.radius = 0, p.cut.curvature = 1. / 20;
  EXPECT_NEAR(solved_shape(p).report.gape, radius, 0.01 * radius);
}

TEST(ShapedPatch, BoneHoldsAsItHoldsABody) {
  Parameters p = of_shape();
  Body body = body_of_patch(p, flat);
  body.support.assign(body.support.size(), Support::bone);
  SolveOptions options;
  options.body = std::make_shared<const Body>(body);
  const double held = solved_shape(p, options).report.gape;
  p.patch.bottom = PatchBottom::bone;
  const SolvedShape s = solved_shape(p);
  EXPECT_NEAR(s.report.gape, held, 1e-9 * held);
  EXPECT_EQ(s.snapshot.support, std::vector<std::uint8_t>(body.support.size(), 1));
}

/// Left and right exchange their displacements.
TEST(ShapedPatch, MirroredShapesOpenAsMirrorImages) {
  Parameters p = of_shape();
  p.cut.curvature = 0.05, p.patch.slope = 0.2, p.skin.curvature_v = 0.02, p.skin.curvature_uv = 0.01;
  p.skin.prestress = {0.01, 0.03, 0.004};
  Parameters q = p;
  q.cut.curvature = -0.05, q.patch.slope = -0.2, q.skin.curvature_uv = -0.01, q.skin.prestress.uv = -0.004;
  const SolvedShape a = solved_shape(p), b = solved_shape(q);
  EXPECT_NEAR(a.report.gape, b.report.gape, 1e-9 * a.report.gape);
  for (std::size_t n = 0; n < a.snapshot.pairs.size(); ++n) {
    const auto [left, right] = a.snapshot.pairs[n];
    const auto [other_left, other_right] = b.snapshot.pairs[n];
    const Vec3 d = a.frames.back()[left], image = b.frames.back()[other_right];
    EXPECT_NEAR(norm(d - Vec3{image.x, -image.y, image.z}), 0, 1e-9 * a.report.gape);
  }
}

/// Cases that differ in their tension alone share a factor, and superpose.
TEST(ShapedPatch, TensionsShareAFactorAndSuperpose) {
  Parameters p = of_shape();
  p.cut.curvature = 0.05, p.skin.curvature_u = 0.02;
  const TemporaryFolder folder;
  const Prestress tensions[] = {{0.01, 0, 0}, {0, 0.02, 0}, {0.01, 0.02, 0}};
  std::vector<CaseToSolve> cases;
  for (const Prestress& tension : tensions) {
    p.skin.prestress = tension;
    cases.push_back({p, folder / (std::to_string(cases.size()) + ".h5")});
  }
  SolveOptions options;
  options.estimate = false;
  const auto reports = solve_cases(cases, options, MPI_COMM_WORLD, [](auto&) {});
  std::vector<std::vector<Vec3>> last;
  for (const CaseToSolve& one : cases) {
    const SnapshotReader reader(one.out);
    last.push_back(reader.displacement(reader.snapshot().frames() - 1));
  }
  EXPECT_EQ(reports[0].cases_sharing, 3);
  for (std::size_t n = 0; n < last[0].size(); ++n)
    ASSERT_LT(norm(last[0][n] + last[1][n] - last[2][n]), 1e-9 * reports[2].gape);
}

/// A straight cut along the tension opens nothing. The loads on its lips are rounding, and so would be what
/// they move.
TEST(ShapedPatch, TensionAlongAStraightCutMovesNothing) {
  Parameters p = of_shape();
  p.skin.curvature_u = -0.0333, p.skin.curvature_v = 0.0333;
  p.skin.prestress = {0.01, 0, 0};
  for (const auto& frame : solved_shape(p).frames)
    for (const Vec3& d : frame) ASSERT_EQ(d, Vec3{});
}

/// A companion has the same shape: elements twice as long change little, and the estimate says how much.
TEST(ShapedPatch, ItsErrorIsEstimated) {
  Parameters p = of_shape();
  p.cut.curvature = 0.03, p.skin.curvature_v = 0.02, p.mesh.element_size = 1.5;
  const ErrorEstimate estimate = expected_error(p, gape_of(p, MPI_COMM_WORLD), MPI_COMM_WORLD);
  ASSERT_TRUE(estimate.expected) << estimate.obstacle;
  EXPECT_LT(estimate.expected->total(), 0.1);
}

}  // namespace cleft
