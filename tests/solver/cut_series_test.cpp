#include "solver/cut_series.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "tests/solver/small_patch.h"

namespace cleft {

namespace {

Eigen::MatrixXd dense_stiffness(const PatchSystem& system) {
  const PatchSystem::Entries entries = system.lower_triangle();
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(system.size(), system.size());
  for (std::size_t i = 0; i < entries.value.size(); ++i)
    k(entries.row[i], entries.column[i]) = k(entries.column[i], entries.row[i]) = entries.value[i];
  return k;
}

/// The paper's own system, written out: K with a multiplier for every unknown of every closed pair.
Eigen::VectorXd with_multipliers(const PatchMesh& mesh, const PatchSystem& system, int released) {
  const int n = system.size(), pairs = static_cast<int>(mesh.pairs.size()), rows = 3 * (pairs - released);
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n + rows, n + rows);
  matrix.topLeftCorner(n, n) = dense_stiffness(system);
  for (int p = released, row = n; p < pairs; ++p)
    for (int axis = 0; axis < 3; ++axis, ++row) {
      matrix(row, system.unknown(mesh.pairs[p][0], axis)) =
          matrix(system.unknown(mesh.pairs[p][0], axis), row) = -1;
      matrix(row, system.unknown(mesh.pairs[p][1], axis)) =
          matrix(system.unknown(mesh.pairs[p][1], axis), row) = 1;
    }
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n + rows);
  right.head(n) = system.load();
  return matrix.partialPivLu().solve(right).head(n);
}

Parameters sheared_patch() {  // no symmetry that could hide a mistake
  Parameters p = small_patch();
  p.skin.prestress_u = 0.02, p.skin.prestress_v = 0.03, p.skin.prestress_uv = 0.012;
  p.cut.frames = "pair";
  return p;
}

}  // namespace

TEST(CutSeries, EveryFrameSolvesTheSystemWithMultipliers) {
  const PatchMesh mesh = make_patch_mesh(sheared_patch());
  const PatchSystem system(mesh, sheared_patch(), MPI_COMM_WORLD);
  CutSeries series(mesh, system);
  const int count = static_cast<int>(mesh.released.size());
  const Eigen::MatrixXd frames = series.frames(0, count);
  for (int j = 0; j < count; ++j) {
    const Eigen::VectorXd expected = with_multipliers(mesh, system, mesh.released[j]);
    EXPECT_LT((frames.col(j) - expected).norm(), 1e-10 * expected.norm()) << "frame " << j;
  }
  // Blocks of frames are the same frames.
  EXPECT_LT((series.frames(3, 2) - frames.middleCols(3, 2)).norm(), 1e-13 * frames.norm());
}

TEST(CutSeries, Frame0IsClosedAndTheLastFrameIsTheOpenMesh) {
  Parameters p = small_patch();
  p.cut.depth = 2;  // two layers of 1 mm
  const PatchMesh mesh = make_patch_mesh(p);
  const PatchSystem system(mesh, p, MPI_COMM_WORLD);
  CutSeries series(mesh, system);
  const int last = static_cast<int>(mesh.released.size()) - 1;
  const Eigen::MatrixXd frames = series.frames(0, last + 1);
  double gap = 0;
  for (const auto& pair : mesh.pairs)
    for (int axis = 0; axis < 3; ++axis)
      gap = std::max(
          gap, std::abs(frames(system.unknown(pair[1], axis), 0) - frames(system.unknown(pair[0], axis), 0)));
  EXPECT_LT(gap, 1e-12 * frames.cwiseAbs().maxCoeff());
  const Eigen::VectorXd open = dense_stiffness(system).llt().solve(system.load());
  EXPECT_LT((frames.col(last) - open).norm(), 1e-9 * open.norm());
  EXPECT_GT((frames.col(last) - frames.col(0)).norm(), 0.1 * open.norm())
      << "the cut must open for this to mean anything";
}

TEST(CutSeries, FiguresTellResidualsAndGaps) {
  const PatchMesh mesh = make_patch_mesh(sheared_patch());
  const PatchSystem system(mesh, sheared_patch(), MPI_COMM_WORLD);
  CutSeries series(mesh, system);
  Eigen::MatrixXd frames = series.frames(0, 3);
  for (const FrameFigures& f : series.figures(0, frames)) {
    EXPECT_LT(f.residual_equilibrium, 1e-11);
    EXPECT_LT(f.residual_closure, 1e-12);
  }
  const double nudge = 0.5;
  frames(system.unknown(mesh.pairs.back()[1], 1), 0) += nudge;
  const FrameFigures nudged = series.figures(0, frames.leftCols(1))[0];
  EXPECT_NEAR(nudged.residual_closure, nudge / frames.col(0).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_GT(nudged.residual_equilibrium, 1e-3);

  // The open mesh: the residual is f - K u over all unknowns, and the smallest gap that of the narrowest
  // pair.
  const int last = static_cast<int>(mesh.released.size()) - 1;
  Eigen::MatrixXd open = series.frames(last, 1);
  open(system.unknown(mesh.pairs[2][1], 1), 0) = open(system.unknown(mesh.pairs[2][0], 1), 0) - nudge;
  const FrameFigures pinched = series.figures(last, open)[0];
  const Eigen::VectorXd residual = system.load() - dense_stiffness(system) * open.col(0);
  EXPECT_NEAR(pinched.residual_equilibrium,
              residual.cwiseAbs().maxCoeff() / system.load().cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_NEAR(pinched.smallest_gap, -nudge, 1e-12);
}

}  // namespace cleft
