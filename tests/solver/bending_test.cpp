// The skin's bending: its energy against closed forms.
#include "solver/bending.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "tests/solver/small_patch.h"

namespace cleft {

namespace {

/// Sum of weight (sum of bend f)^2 / 2 over the hinges.
template <class Function>
double energy(const PatchMesh& mesh, const Function& f) {
  double sum = 0;
  for (const Hinge& hinge : skin_hinges(mesh)) {
    double jump = 0;
    for (int n = 0; n < 4; ++n) jump += hinge.bend[n] * f(mesh.points[hinge.nodes[n]]);
    sum += hinge.weight * jump * jump / 2;
  }
  return sum;
}

/// Half the sum of (length of the edge times the jump of the gradient across it)^2 / areas, of all edges that
/// two triangles share where the first `open` pairs of a release are open. `f` by node; tied nodes have equal
/// values. Gradients are those of the planes through the corners.
double energy_by_brute_force(const PatchMesh& mesh, const Release& release, int open,
                             const std::vector<double>& f) {
  std::vector<int> tied(mesh.points.size());
  std::iota(tied.begin(), tied.end(), 0);
  for (std::size_t i = open; i < release.order.size(); ++i) {
    const NodePair& pair = mesh.pairs[release.order[i]];
    const int keep = tied[pair.left], drop = tied[pair.right];
    for (int& node : tied)
      if (node == drop) node = keep;
  }
  struct Plane {
    Eigen::Vector2d slope;
    double area;
  };
  std::vector<Plane> planes;
  for (const auto& corners : mesh.skin) {
    Eigen::Matrix3d m;
    Eigen::Vector3d values;
    for (int c = 0; c < 3; ++c) {
      const Vec3& at = mesh.points[corners[c]];
      m.row(c) << at.x, at.y, 1;
      values[c] = f[corners[c]];
    }
    planes.push_back({m.partialPivLu().solve(values).head<2>(), std::abs(m.determinant()) / 2});
  }
  double sum = 0;
  for (std::size_t s = 0; s < mesh.skin.size(); ++s)
    for (std::size_t t = s + 1; t < mesh.skin.size(); ++t) {
      std::vector<Vec3> shared;
      for (const int a : mesh.skin[s])
        for (const int b : mesh.skin[t])
          if (tied[a] == tied[b]) shared.push_back(mesh.points[a]);
      if (shared.size() != 2) continue;
      const Eigen::Vector2d along(shared[1].x - shared[0].x, shared[1].y - shared[0].y);
      const Eigen::Vector2d normal = Eigen::Vector2d(along[1], -along[0]).normalized();
      const double jump = along.norm() * normal.dot(planes[s].slope - planes[t].slope);
      sum += jump * jump / (planes[s].area + planes[t].area) / 2;
    }
  return sum;
}

double energy_of(const Hinge& hinge, const std::vector<double>& f) {
  double jump = 0;
  for (int n = 0; n < 4; ++n) jump += hinge.bend[n] * f[hinge.nodes[n]];
  return hinge.weight * jump * jump / 2;
}

}  // namespace

TEST(Bending, PlanesCostNothing) {
  const PatchMesh mesh = make_patch_mesh(small_patch());
  EXPECT_LT(energy(mesh, [](const Vec3& p) { return 3 + 0.5 * p.x - 0.2 * p.y; }), 1e-25);
}

/// k^2 / 2 for each mm^2, less what is missing at the patch's edges and at the cut: half an element on each
/// side.
TEST(Bending, ACylinderHasTheEnergyOfItsCurvature) {
  Parameters p = small_patch();
  p.patch.length = 24, p.patch.width = 20, p.cut.length = 2, p.mesh.element_size = 0.5;
  p.mesh.grading = 1;
  const PatchMesh mesh = make_patch_mesh(p);
  constexpr double k = 0.01;
  EXPECT_NEAR(energy(mesh, [](const Vec3& x) { return k / 2 * x.x * x.x; }) / (k * k / 2 * 24 * 20), 1, 0.06);
  EXPECT_NEAR(energy(mesh, [](const Vec3& x) { return k / 2 * x.y * x.y; }) / (k * k / 2 * 24 * 20), 1, 0.06);
}

TEST(Bending, TheLipsAreJoints) {
  const PatchMesh mesh = make_patch_mesh(small_patch());
  for (const Hinge& hinge : skin_hinges(mesh)) {
    const Vec3 &a = mesh.points[hinge.nodes[2]], &b = mesh.points[hinge.nodes[3]];
    const Vec3 &c = mesh.points[hinge.nodes[0]], &d = mesh.points[hinge.nodes[1]];
    const bool on_the_cut = c.y == 0 && d.y == 0 && std::abs(c.x) <= 3 && std::abs(d.x) <= 3;
    EXPECT_FALSE(on_the_cut && a.y * b.y < 0) << c.x << ", " << d.x;
  }
}

/// Across the cut the skin bends as if it were whole where both ends of an edge are closed, and freely
/// elsewhere: for one cut, several, and a branch, where a place has three nodes.
TEST(Bending, JointsHoldWhereTheCutIsClosed) {
  Parameters one = small_patch(), several = small_patch(), branched = small_patch();
  several.cut.count = 2, several.cut.spacing = 2, several.patch.width = 8;
  branched.cut.branch = 2, branched.patch.width = 8;
  for (Parameters p : {one, several, branched}) {
    p.cut.frames = FrameEvery::pair;
    const PatchMesh mesh = make_patch_mesh(p);
    const Release release = make_release(mesh, p);
    const std::vector<Joint> joints = skin_joints(mesh);
    for (const int open : release.released) {
      std::vector<double> f(mesh.points.size());
      for (std::size_t n = 0; n < f.size(); ++n) f[n] = std::sin(7. * static_cast<double>(n * n));
      const std::set<int> closed(release.order.begin() + open, release.order.end());
      for (const int pair : closed) f[mesh.pairs[pair].right] = f[mesh.pairs[pair].left];
      double found = 0;
      for (const Hinge& hinge : skin_hinges(mesh)) found += energy_of(hinge, f);
      for (const Joint& joint : joints)
        if (std::includes(closed.begin(), closed.end(), joint.pairs.begin(), joint.pairs.end()))
          found += energy_of(joint.hinge, f);
      const double expected = energy_by_brute_force(mesh, release, open, f);
      EXPECT_NEAR(found, expected, 1e-12 * expected) << open << " open";
    }
  }
}

}  // namespace cleft
