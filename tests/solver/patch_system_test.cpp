// The assembled patch against closed forms: energies of linear displacements are exact for these elements.
#include "solver/patch_system.h"

#include <gtest/gtest.h>

#include "tests/solver/small_patch.h"
#include "tests/solver/verification_support.h"

namespace cleft {

namespace {

/// A patch of which only one part is stiff.
Parameters bare_patch() {
  Parameters p = small_patch();
  p.tissue.young_modulus = p.skin.young_modulus = p.foundation.stiffness = none;
  p.foundation.side_stiffness = 0;
  p.skin.prestress = {};
  return p;
}

using Gradient = std::array<Vec3, 3>;  // row i: gradient of displacement component i

Eigen::VectorXd linear(const PatchMesh& mesh, const PatchSystem& system, const Gradient& g,
                       const Vec3& shift = {}) {
  Eigen::VectorXd u(system.size());
  for (std::size_t n = 0; n < mesh.points.size(); ++n)
    for (int i = 0; i < 3; ++i)
      u(system.unknown(static_cast<int>(n), i)) = dot(g[i], mesh.points[n]) + shift[i];
  return u;
}

const Gradient stretch = {{{0.3, -0.2, 0.5}, {0.1, 0.7, -0.4}, {0.6, 0.2, -0.9}}};

struct Assembled {
  explicit Assembled(const Parameters& p) : mesh(make_patch_mesh(p)), system(mesh, p, MPI_COMM_WORLD) {}
  Eigen::VectorXd force(const Eigen::VectorXd& u) const { return system.multiply(u); }
  double energy(const Eigen::VectorXd& u) const { return u.dot(force(u)) / 2; }
  PatchMesh mesh;
  PatchSystem system;
};

}  // namespace

TEST(PatchSystem, TissueHasTheEnergyOfHookesLawAndBalancesInside) {
  Parameters p = bare_patch();
  p.tissue.young_modulus = 0.02, p.tissue.poisson_ratio = 0.4;
  const Assembled patch(p);
  const double lambda = 0.02 * 0.4 / (1.4 * 0.2), mu = 0.02 / 2.8;
  double trace = 0, squared = 0;
  for (int i = 0; i < 3; ++i) {
    trace += stretch[i][i];
    for (int j = 0; j < 3; ++j) squared += std::pow((stretch[i][j] + stretch[j][i]) / 2, 2);
  }
  const double density = lambda / 2 * trace * trace + mu * squared;
  const Eigen::VectorXd u = linear(patch.mesh, patch.system, stretch);
  EXPECT_NEAR(patch.energy(u) / (density * 10 * 6 * 3), 1, 1e-11);

  // A constant stress needs no force inside; the two nodes of a pair share theirs.
  const Eigen::VectorXd force = patch.force(u);
  std::vector<bool> single(patch.mesh.points.size(), true);
  for (const NodePair& pair : patch.mesh.pairs) single[pair.left] = single[pair.right] = false;
  for (std::size_t n = 0; n < patch.mesh.points.size(); ++n) {
    const Vec3& at = patch.mesh.points[n];
    const bool inside = std::abs(at.x) < 5 && std::abs(at.y) < 3 && at.z < 0 && at.z > -3;
    for (int i = 0; i < 3 && inside && single[n]; ++i)
      EXPECT_NEAR(force(patch.system.unknown(static_cast<int>(n), i)), 0, 1e-14);
  }
}

TEST(PatchSystem, RigidMotionCostsNothingWithoutSprings) {
  Parameters p = bare_patch();
  p.tissue.young_modulus = 0.02;
  p.skin.young_modulus = 0.13;
  const Assembled patch(p);
  const Gradient rotation = {{{0, -1, 2}, {1, 0, -3}, {-2, 3, 0}}};
  const Eigen::VectorXd u = linear(patch.mesh, patch.system, rotation, {5, 6, 7});
  // The flat membrane is stiff in its plane only, where this motion is a rotation too.
  EXPECT_NEAR(patch.energy(u), 0, 1e-12 * u.squaredNorm());
}

TEST(PatchSystem, SkinHasTheEnergyOfPlaneStress) {
  Parameters p = bare_patch();
  p.skin.young_modulus = 0.13, p.skin.poisson_ratio = 0.4, p.skin.thickness = 1.5;
  const Assembled patch(p);
  const double e = stretch[0].x, f = stretch[1].y, shear = stretch[0].y + stretch[1].x, c = 0.13 / (1 - 0.16);
  const double density = c / 2 * (e * e + f * f + 2 * 0.4 * e * f + 0.3 * shear * shear);
  EXPECT_NEAR(patch.energy(linear(patch.mesh, patch.system, stretch)) / (density * 1.5 * 10 * 6), 1, 1e-10);
}

TEST(PatchSystem, PrestressDoesTheWorkOfItsStress) {
  Parameters p = bare_patch();
  p.skin.prestress = {0.011, 0.03, 0.007};
  const Assembled patch(p);
  const Eigen::VectorXd u = linear(patch.mesh, patch.system, stretch);
  const Eigen::RowVector3d strain(stretch[0].x, stretch[1].y, stretch[0].y + stretch[1].x);
  const Eigen::RowVector3d work = -1.5 * 10 * 6 * strain;
  // Sums of some hundred terms: rounding of about 1e-14 of them.
  EXPECT_NEAR((u.transpose() * patch.system.unit_loads() - work).norm(), 0, 1e-12 * work.norm());
  const Eigen::Vector3d prestress(0.011, 0.03, 0.007);
  EXPECT_NEAR(u.dot(patch.system.load(p.skin).col(0)), work.dot(prestress), 1e-13);
}

/// In equilibrium while closed: the loads of the prestress and the pull t sigma n of the surrounding skin at
/// the patch's sides, half of an edge's at each of its ends, leave forces on the lips alone.
TEST(PatchSystem, HeldEdgesBearThePullOfTheSurroundingSkin) {
  Parameters p = bare_patch();
  p.skin.prestress = {0.011, 0.03, 0.007};
  p.cut.branch = 2;
  const Assembled piece(p);
  Eigen::VectorXd expected = piece.system.load(p.skin).col(0);
  for (const auto& triangle : piece.mesh.skin)
    for (int c = 0; c < 3; ++c) {
      const std::array<int, 2> ends = {triangle[c], triangle[(c + 1) % 3]};
      const Vec3 &a = piece.mesh.points[ends[0]], &b = piece.mesh.points[ends[1]];
      if (!(std::abs(a.x) == 5 && a.x == b.x) && !(std::abs(a.y) == 3 && a.y == b.y)) continue;
      const double u = b.y - a.y, v = a.x - b.x;  // outward, as long as the edge
      for (const int n : ends) {
        expected(piece.system.unknown(n, 0)) += 1.5 / 2 * (0.011 * u + 0.007 * v);
        expected(piece.system.unknown(n, 1)) += 1.5 / 2 * (0.007 * u + 0.03 * v);
      }
    }
  p.skin.edges = SkinEdges::held;
  const Assembled held(p);
  const Eigen::VectorXd load = held.system.load(p.skin).col(0);
  EXPECT_NEAR((load - expected).cwiseAbs().maxCoeff(), 0, 1e-15);
  EXPECT_GT(load.cwiseAbs().maxCoeff(), 0.01) << "the lips are pulled";
}

TEST(PatchSystem, TissueUnderStressDoesTheWorkOfItsShare) {
  Parameters p = bare_patch();
  p.skin.prestress = {0.011, 0.03, 0.007}, p.tissue.prestress_share = 0.25;
  const Assembled patch(p);
  const Eigen::VectorXd u = linear(patch.mesh, patch.system, stretch);
  const Eigen::Vector3d strain(stretch[0].x, stretch[1].y, stretch[0].y + stretch[1].x);
  const double work = -(1.5 + 0.25 * 3) * 10 * 6 * strain.dot(Eigen::Vector3d(0.011, 0.03, 0.007));
  EXPECT_NEAR(u.dot(patch.system.load(p.skin).col(0)) / work, 1, 1e-12);
}

TEST(PatchSystem, SpringsAreIntegratedConsistently) {
  // 1/2 k of the integral of |u|^2 over the faces, for u = (x, 0, 0): the integral of x^2 over the bottom,
  // and the sides.
  Parameters p = bare_patch();
  p.foundation.stiffness = 0.005;
  const Gradient along = {{{1, 0, 0}, {0, 0, 0}, {0, 0, 0}}};
  const double bottom = 6 * 2 * std::pow(5, 3) / 3;
  {
    const Assembled patch(p);
    EXPECT_NEAR(patch.energy(linear(patch.mesh, patch.system, along)) / (0.005 / 2 * bottom), 1, 1e-9);
  }
  p.foundation.stiffness = none, p.foundation.side_stiffness = 0.002;
  const Assembled patch(p);
  const double sides = 2 * 6 * 3 * 25 + 2 * 3 * 2 * std::pow(5, 3) / 3;
  EXPECT_NEAR(patch.energy(linear(patch.mesh, patch.system, along)) / (0.002 / 2 * sides), 1, 1e-9);
}

}  // namespace cleft
