// Lips that press on each other under finite strains: against the small model's contact, whose sets of
// touching pairs are compared with brute force (contact_test.cpp), and against what defines contact.
#include <gtest/gtest.h>

#include "tests/solver/newton_frames.h"

namespace cleft {

namespace {

Parameters pulled(Parameters p, const Prestress& tension) {
  p.model = Model::finite, p.cut.contact = true;
  p.skin.initial_stress_stiffness = true;  // of the system
  p.skin.prestress = tension;
  return p;
}

/// In which lips touch: a branch, which leaves one side of a cut that is pulled along; and a leaning arc.
std::vector<DenseCase> pressed_cases() {
  std::vector<DenseCase> cases;
  for (const DenseCase& c : dense_cases()) {
    const std::string name = c.name;
    if (name == "Branch" || name == "TiltedArc" || name == "BranchInAMeshOfALargerCut") cases.push_back(c);
  }
  return cases;
}

/// Normal openings of the open pairs, and the pressures that keep a frame in balance but for what closed
/// pairs transmit; by place in the release.
struct Lips {
  Eigen::VectorXd gaps, pressures;
  double unbalanced;  ///< N
};

Lips lips_of(const DensePatch& patch, const FinitePatch& finite, const Block& u, int open) {
  const Eigen::MatrixXd closure = patch.closure(patch.release, open), gaps = patch.gaps(patch.release, open);
  Eigen::MatrixXd forces(gaps.cols(), closure.rows() + gaps.rows());
  forces << closure.transpose(), -gaps.transpose();
  const Eigen::VectorXd left_over = patch.whole(finite.balance(u).left_over);
  const Eigen::VectorXd found = forces.colPivHouseholderQr().solve(left_over);
  return {gaps * patch.whole(u), found.tail(gaps.rows()), (left_over - forces * found).cwiseAbs().maxCoeff()};
}

}  // namespace

/// The difference is of the order of the strain, a ten-thousandth; which pairs touch is the same.
TEST(NewtonContact, UnderSmallTensionItIsThatOfTheSmallModel) {
  int touching = 0;
  for (const DenseCase& c : pressed_cases()) {
    SCOPED_TRACE(c.name);
    const Parameters p = pulled(c.parameters, {2e-5, 1e-6, 2e-6});
    const DensePatch patch(p);
    DirectSolver solver(patch.mesh, patch.system);
    solver.factorize();
    solver.set_release(patch.release);
    solver.set_loads(patch.own(patch.load));
    std::vector<FrameSolver::Column> columns;
    for (const int open : patch.release.released) columns.push_back({0, open, true});
    const Eigen::MatrixXd expected = patch.whole(solver.solve(columns));
    const std::vector<Block> frames = newton_frames(patch, p);
    for (std::size_t j = 0; j < frames.size(); ++j) {
      SCOPED_TRACE("frame " + std::to_string(j));
      const Eigen::VectorXd one = expected.col(static_cast<Eigen::Index>(j)), found = patch.whole(frames[j]);
      EXPECT_LT((found - one).norm(), 2e-3 * one.norm() + 1e-15);
      const Eigen::MatrixXd gaps = patch.gaps(patch.release, patch.release.released[j]);
      const double closed = 1e-9 * one.cwiseAbs().maxCoeff();
      for (Eigen::Index i = 0; i < gaps.rows(); ++i) {
        touching += std::abs(gaps.row(i) * one) < closed;
        EXPECT_EQ(std::abs(gaps.row(i) * found) < closed, std::abs(gaps.row(i) * one) < closed) << i;
      }
    }
  }
  EXPECT_GT(touching, 10);
}

/// Closed pairs are closed, no pair overlaps or pulls, none presses across a gap, and there is no friction:
/// all to the residual at which Newton's method ends. Without contact lips do overlap, and differ.
TEST(NewtonContact, LipsNeitherOverlapNorPullNorRub) {
  int touching = 0;
  for (const DenseCase& c : pressed_cases()) {
    SCOPED_TRACE(c.name);
    Parameters p = pulled(c.parameters, {0.05, 0.004, 0.004});
    const DensePatch patch(p);
    std::vector<NewtonFrame> reports;
    const std::vector<Block> frames = newton_frames(patch, p, &reports);
    p.cut.contact = false;
    const std::vector<Block> without = newton_frames(patch, p);
    const FinitePatch finite(patch.system, p);
    const double largest = patch.load.cwiseAbs().maxCoeff();
    for (std::size_t j = 1; j < frames.size(); ++j) {
      SCOPED_TRACE("frame " + std::to_string(j));
      const int open = patch.release.released[j];
      const Lips lips = lips_of(patch, finite, frames[j], open);
      const double size = frames[j].size() > 0 ? patch.whole(frames[j]).cwiseAbs().maxCoeff() : 0;
      EXPECT_LT(lips.unbalanced, 2e-7 * largest);
      EXPECT_GT(lips.gaps.minCoeff(), -1e-6 * size);
      EXPECT_GT(lips.pressures.minCoeff(), -1e-6 * largest);
      for (int i = 0; i < open; ++i)
        EXPECT_LT(std::min(lips.gaps[i] / size, lips.pressures[i] / largest), 1e-6) << i;
      touching += static_cast<int>((lips.pressures.array() > 1e-3 * largest).count());
      if (lips_of(patch, finite, without[j], open).gaps.minCoeff() < -1e-3 * size) {
        EXPECT_GT((patch.whole(frames[j]) - patch.whole(without[j])).norm(),
                  1e-3 * patch.whole(frames[j]).norm());
      }
      EXPECT_LT((patch.closure(patch.release, open) * patch.whole(frames[j])).cwiseAbs().sum(), 1e-12);
      EXPECT_LT(reports[j].residual, 1e-7);
      EXPECT_EQ(reports[j].load_steps, 1);
    }
  }
  EXPECT_GT(touching, 10);
}

/// The same series on this rank alone (on one rank nothing is compared). Both end at a residual of 1e-7 of
/// the largest load, so that displacements agree to about as many digits; the pairs that touch are the same.
TEST(NewtonContact, IsTheSameOnSeveralRanks) {
  int touching = 0;
  for (const DenseCase& c : pressed_cases()) {
    if (c.name != std::string("Branch")) continue;
    Parameters p = pulled(c.parameters, {0.05, 0.004, 0.004});
    p.cut.frames = FrameEvery::column;  // few, as messages take long
    const DensePatch shared(p), alone(p, {}, MPI_COMM_SELF);
    const std::vector<Block> on_all = newton_frames(shared, p), on_one = newton_frames(alone, p);
    ASSERT_EQ(on_all.size(), on_one.size());
    for (std::size_t j = 0; j < on_one.size(); ++j) {
      SCOPED_TRACE("frame " + std::to_string(j));
      const Eigen::VectorXd u = shared.whole(on_all[j]), expected = alone.whole(on_one[j]);
      const double size = expected.cwiseAbs().maxCoeff();
      double difference = 0;
      for (int node = 0; node < static_cast<int>(alone.mesh.points.size()); ++node)
        for (int axis = 0; axis < 3; ++axis)
          difference = std::max(difference, std::abs(u[shared.system.unknown(node, axis)] -
                                                     expected[alone.system.unknown(node, axis)]));
      EXPECT_LE(difference, 1e-6 * size);
      const int open = alone.release.released[j];
      const Eigen::VectorXd gaps = shared.gaps(shared.release, open) * u;
      const Eigen::VectorXd gaps_alone = alone.gaps(alone.release, open) * expected;
      for (int i = 0; i < open; ++i) {
        EXPECT_EQ(std::abs(gaps[i]) < 1e-9 * size, std::abs(gaps_alone[i]) < 1e-9 * size) << i;
        touching += std::abs(gaps[i]) < 1e-9 * size;
      }
    }
  }
  EXPECT_GT(touching, 3);
}

}  // namespace cleft
