// The tissue against displacements that its elements hold exactly, on meshes whose nodes were moved.
#include <gtest/gtest.h>

#include "tests/solver/small_patch.h"
#include "tests/solver/verification_support.h"

namespace cleft {

namespace {

class Tissue : public testing::TestWithParam<TissueFormulation> {};

Parameters with(TissueFormulation formulation) {
  Parameters p = small_patch();
  p.tissue.formulation = formulation;
  return p;
}

}  // namespace

TEST_P(Tissue, PassesThePatchTestWithItsCutClosed) {
  Parameters p = with(GetParam());
  p.patch.height = 5, p.cut.depth = 4;
  PatchMesh mesh = make_patch_mesh(p);
  jitter(mesh, 0.25, p.mesh.element_size);
  const PatchSystem system(mesh, p, MPI_COMM_WORLD);
  // The surface is prescribed as a whole, so that skin and springs, which lie on it, have no say.
  const Vec3 gradient[3] = {{0.3, -0.2, 0.5}, {0.1, 0.7, -0.4}, {0.6, 0.2, -0.9}};
  const auto linear = [&](std::size_t node, int axis) { return dot(gradient[axis], mesh.points[node]) + 1; };
  Conditions conditions(system);
  const std::vector<bool> surface = on_surface(mesh);
  for (const NodePair& pair : mesh.pairs)
    for (int axis = 0; axis < 3; ++axis) conditions.tie(pair.right, pair.left, axis);
  int inside = 0;
  for (std::size_t n = 0; n < mesh.points.size(); ++n) {
    inside += !surface[n];
    for (int axis = 0; axis < 3 && surface[n]; ++axis)
      conditions.fix(static_cast<int>(n), axis, linear(n, axis));
  }
  ASSERT_GT(inside, 150);
  const Eigen::VectorXd u = conditions.solve(Eigen::VectorXd::Zero(system.size()));
  double error = 0, largest = 0;
  for (std::size_t n = 0; n < mesh.points.size(); ++n)
    for (int axis = 0; axis < 3; ++axis) {
      error = std::max(error, std::abs(u[system.unknown(static_cast<int>(n), axis)] - linear(n, axis)));
      largest = std::max(largest, std::abs(linear(n, axis)));
    }
  // Exact but for rounding: the condition number, about 1e3, times 1e-16.
  EXPECT_LT(error, 1e-12 * largest);
}

TEST_P(Tissue, SlabOnSpringsGivesWayByItsHeightAndTheSprings) {
  Parameters p = with(GetParam());
  p.patch.length = 4, p.patch.width = 4, p.patch.height = 3;
  p.foundation.stiffness = 0.005, p.foundation.side_stiffness = 0;
  PatchMesh mesh = box_mesh(GetParam(), even_lines(-2, 2, 4), even_lines(-2, 2, 4), even_lines(-3, 0, 4));
  jitter(mesh, 0.25, 0.75);
  const PatchSystem system(mesh, p, MPI_COMM_WORLD);
  const Eigen::VectorXd areas = areas_of_nodes(mesh, mesh.skin);
  const double e = p.tissue.young_modulus, nu = p.tissue.poisson_ratio, k = p.foundation.stiffness;
  const double traction = 0.003;
  // Axis pressed or sheared, and its modulus. The sides are held along the other axes that the stress there
  // would move them.
  const auto expect_exact = [&](int pulled, double modulus) {
    Conditions conditions(system);
    Eigen::VectorXd load = Eigen::VectorXd::Zero(system.size());
    for (int n = 0; n < static_cast<int>(mesh.points.size()); ++n) {
      load[system.unknown(n, pulled)] = traction * areas[n];
      const bool end = std::abs(mesh.points[n].x) == 2, side = std::abs(mesh.points[n].y) == 2;
      if (end) conditions.fix(n, pulled == 2 ? 0 : 2);
      if (side) conditions.fix(n, 1);
    }
    const Eigen::VectorXd u = conditions.solve(load);
    double error = 0;
    const double top = traction * (1 / k + 3 / modulus);
    for (int n = 0; n < static_cast<int>(mesh.points.size()); ++n)
      for (int axis = 0; axis < 3; ++axis) {
        const double exact = axis == pulled ? traction * (1 / k + (mesh.points[n].z + 3) / modulus) : 0;
        error = std::max(error, std::abs(u[system.unknown(n, axis)] - exact));
      }
    EXPECT_LT(error, 1e-12 * top);  // rounding times a condition number of about 1e3
  };
  expect_exact(2, e * (1 - nu) / ((1 + nu) * (1 - 2 * nu)));  // the skin keeps its shape: no part in it
  expect_exact(0, e / (2 * (1 + nu)));
}

INSTANTIATE_TEST_SUITE_P(Formulations, Tissue,
                         testing::Values(TissueFormulation::displacement, TissueFormulation::mean_dilatation),
                         [](const auto& test) {
                           return test.param == TissueFormulation::displacement ? "disp" : "mean";
                         });

}  // namespace cleft
