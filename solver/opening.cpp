#include "solver/opening.h"

#include <stdexcept>

namespace cleft {

Opening::Opening(const Eigen::MatrixXd& stiffness, const Eigen::VectorXd& load) {
  const Eigen::Index n = load.size() / 2;
  const auto ll = stiffness.topLeftCorner(n, n), lr = stiffness.topRightCorner(n, n);
  const auto rl = stiffness.bottomLeftCorner(n, n), rr = stiffness.bottomRightCorner(n, n);
  // u_left = m - a / 2, u_right = m + a / 2
  mean_factor_.compute(ll + lr + rl + rr);
  mean_jump_ = (lr + rr - ll - rl) / 2;
  const Eigen::MatrixXd jump_stiffness = (ll - lr - rl + rr) / 4;
  mean_load_ = load.head(n) + load.tail(n);
  const Eigen::VectorXd jump_load = (load.tail(n) - load.head(n)) / 2;
  if (n == 0) return;

  if (mean_factor_.info() != Eigen::Success)
    throw std::runtime_error("the closed patch is not held: its stiffness is not positive definite");
  jump_factor_.compute(jump_stiffness - mean_jump_.transpose() * mean_factor_.solve(mean_jump_));
  if (jump_factor_.info() != Eigen::Success)
    throw std::runtime_error("the open patch is not held: its stiffness is not positive definite");
  forward_ =
      jump_factor_.matrixL().solve(jump_load - mean_jump_.transpose() * mean_factor_.solve(mean_load_));
}

Eigen::VectorXd Opening::displacement(int open) const {
  const Eigen::Index n = mean_load_.size();
  Eigen::VectorXd jump = Eigen::VectorXd::Zero(n);
  if (open > 0) {
    const auto leading = jump_factor_.matrixLLT().topLeftCorner(open, open).triangularView<Eigen::Lower>();
    jump.head(open) = leading.transpose().solve(forward_.head(open));
  }
  const Eigen::VectorXd mean = mean_factor_.solve(mean_load_ - mean_jump_ * jump);
  Eigen::VectorXd both(2 * n);
  both << mean - jump / 2, mean + jump / 2;
  return both;
}

}  // namespace cleft
