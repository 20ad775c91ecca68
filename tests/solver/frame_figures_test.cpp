// What is told about a frame: residuals and gaps. CMakeLists.txt runs these tests on several ranks too.
#include "solver/frame_figures.h"

#include <gtest/gtest.h>

#include "solver/direct_solver.h"
#include "tests/solver/dense_patch.h"

namespace cleft {

namespace {

/// A patch with its solved frames, whose displacements may be spoiled.
struct Frames {
  explicit Frames(const Parameters& p, bool contact) : patch(p), residual(patch.mesh, patch.system) {
    DirectSolver solver(patch.mesh, patch.system);
    solver.factorize();
    solver.set_release(patch.release);
    solver.set_loads(patch.own(patch.load));
    for (const int open : patch.release.released) columns.push_back({0, open, contact});
    displacements = patch.whole(solver.solve(columns));
    largest_load = patch.load.cwiseAbs().maxCoeff();
  }

  std::vector<FrameFigures> figures() const {
    const Block u = patch.own(displacements);
    const Block loads = patch.own(patch.load.replicate(1, u.cols()));
    return residual.figures(patch.release, columns, u, residual.left_over(loads, u), largest_load);
  }
  FrameFigures figures_of(std::size_t j) const { return figures()[j]; }

  /// The unknown of a pair's right or left node; by place in the release.
  double& at(std::size_t j, int place, bool right, int axis) {
    const NodePair& pair = patch.mesh.pairs[patch.release.order[place]];
    return displacements(patch.system.unknown(right ? pair.right : pair.left, axis),
                         static_cast<Eigen::Index>(j));
  }

  DensePatch patch;
  FrameResidual residual;
  std::vector<FrameSolver::Column> columns;
  Eigen::MatrixXd displacements;
  double largest_load;
};

/// The smallest and the largest gap of a frame.
std::pair<double, double> gaps_of(const Frames& f, std::size_t j) {
  const int open = f.columns[j].open;
  if (open == 0) return {0, 0};
  const Eigen::VectorXd gaps =
      f.patch.gaps(f.patch.release, open) * f.displacements.col(static_cast<Eigen::Index>(j));
  return {gaps.minCoeff(), gaps.maxCoeff()};
}

Parameters sheared_by_pairs() {
  Parameters p = dense_patch_case();
  p.cut.frames = FrameEvery::pair;
  return p;
}

Parameters branched() {
  Parameters p = sheared_by_pairs();
  p.cut.branch = 1, p.cut.length = 4;
  return p;
}

}  // namespace

/// Solved frames balance to rounding, the condition of K below 1e5 does not enter a residual. Their gaps are
/// the jumps along the normals, with contact and without.
TEST(FrameFigures, TellThatSolvedFramesHoldAndHowFarTheyOpen) {
  Parameters arc = sheared_by_pairs();
  arc.cut.radius = 12, arc.cut.tilt = 15;
  for (const Parameters& p : {sheared_by_pairs(), arc, branched()})
    for (const bool contact : {false, true}) {
      const Frames frames(p, contact);
      const std::vector<FrameFigures> figures = frames.figures();
      for (std::size_t j = 0; j < figures.size(); ++j) {
        EXPECT_LT(figures[j].residual_equilibrium, 1e-11) << "frame " << j << ", contact " << contact;
        EXPECT_LT(figures[j].residual_closure, 1e-13) << "frame " << j << ", contact " << contact;
        const auto [smallest, largest] = gaps_of(frames, j);
        EXPECT_NEAR(figures[j].smallest_gap, smallest, 1e-14);
        EXPECT_NEAR(figures[j].gape, std::max(0., largest), 1e-14);
      }
      EXPECT_GT(figures.back().gape, 0.05);
    }
}

TEST(FrameFigures, TellAGapOfAClosedPair) {
  for (const Parameters& p : {sheared_by_pairs(), branched()}) {
    Frames frames(p, false);
    const double nudge = 0.5;
    const std::size_t j = 3;
    const int closed = static_cast<int>(frames.patch.release.order.size()) - 1;
    frames.at(j, closed, true, 0) += nudge;
    const FrameFigures nudged = frames.figures_of(j);
    const double largest = frames.displacements.col(j).cwiseAbs().maxCoeff();
    EXPECT_NEAR(nudged.residual_closure, nudge / largest, 1e-12);
    EXPECT_GT(nudged.residual_equilibrium, 1e-3);
  }
}

/// With every pair open nothing is shared: the residual is f - K u itself.
TEST(FrameFigures, TellForcesLeftOverAndTheNarrowestGapOfTheOpenPatch) {
  Frames frames(sheared_by_pairs(), false);
  const std::size_t last = frames.columns.size() - 1;
  const double nudge = 0.5;
  frames.at(last, 2, true, 1) = frames.at(last, 2, false, 1) - nudge;
  const Eigen::VectorXd left_over =
      frames.patch.load - frames.patch.stiffness * frames.displacements.rightCols(1);
  const FrameFigures pinched = frames.figures_of(last);
  EXPECT_NEAR(pinched.residual_equilibrium, left_over.cwiseAbs().maxCoeff() / frames.largest_load, 1e-12);
  EXPECT_NEAR(pinched.smallest_gap, -nudge, 1e-12);
}

/// A force far from the cut, where another rank may own the unknown.
TEST(FrameFigures, TellAForceAwayFromTheCut) {
  Frames frames(sheared_by_pairs(), true);
  const int corner = frames.patch.system.unknown(0, 2);
  frames.displacements(corner, 4) += 0.01;
  const double force =
      (0.01 * frames.patch.stiffness.col(corner)).cwiseAbs().maxCoeff() / frames.largest_load;
  EXPECT_NEAR(frames.figures_of(4).residual_equilibrium, force, 1e-9 * force);
  EXPECT_LT(frames.figures_of(5).residual_equilibrium, 1e-11);
}

/// Lips carry no friction and closed pairs carry all: frames solved with contact do not balance without it,
/// nor with fewer pairs open than there are forces for.
TEST(FrameFigures, LetOnlyPairsThatMayShareForcesDoSo) {
  Frames touching(sheared_by_pairs(), true);
  const std::size_t last = touching.columns.size() - 1;
  for (auto& column : touching.columns) column.contact = false;
  EXPECT_GT(touching.figures_of(last).residual_equilibrium, 1e-3);

  for (const Parameters& p : {sheared_by_pairs(), branched()}) {
    Frames closed(p, false);
    ++closed.columns[3].open;
    EXPECT_GT(closed.figures_of(3).residual_equilibrium, 1e-3);
    closed.columns[3].contact = true;  // the normal part of what holds it closed
    EXPECT_GT(closed.figures_of(3).residual_equilibrium, 1e-4);
  }
}

}  // namespace cleft
