// The skin's bending: its energy against closed forms.
#include "solver/bending.h"

#include <gtest/gtest.h>

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

}  // namespace cleft
