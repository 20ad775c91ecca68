#include "solver/opening.h"

#include <Eigen/LU>
#include <algorithm>
#include <stdexcept>
#include <string>

#include "solver/frame_solver.h"

namespace cleft {

namespace {

constexpr Eigen::Index columns_together = 64;  // substituted forward

}  // namespace

Opening::Opening(const Eigen::MatrixXd& stiffness, std::vector<int> order, const std::vector<Vec3>& normal)
    : size_(stiffness.rows()), order_(std::move(order)) {
  if (order_.empty()) return;
  std::vector<int> rows;
  for (const int pair : order_)
    for (int axis = 0; axis < 3; ++axis) rows.push_back(3 * pair + axis);
  factor_.compute(stiffness(rows, rows));
  if (factor_.info() != Eigen::Success)
    throw std::runtime_error(
        std::string("the open patch is not held: its stiffness is not positive definite; ") +
        cause_of_indefinite);
  normal_forward_ = Eigen::MatrixXd::Zero(factor_.rows(), static_cast<Eigen::Index>(order_.size()));
  for (std::size_t p = 0; p < order_.size(); ++p)
    for (int axis = 0; axis < 3; ++axis)
      normal_forward_(3 * static_cast<Eigen::Index>(p) + axis, static_cast<Eigen::Index>(p)) =
          normal[order_[p]][axis];
  // Above its own rows a column of L^-1 N is 0.
  const Eigen::Index pairs = normal_forward_.cols();
  for (Eigen::Index first = 0; first < pairs; first += columns_together) {
    const Eigen::Index rows_left = 3 * (pairs - first), count = std::min(columns_together, pairs - first);
    auto columns = normal_forward_.block(3 * first, first, rows_left, count);
    factor_.matrixLLT()
        .bottomRightCorner(rows_left, rows_left)
        .triangularView<Eigen::Lower>()
        .solveInPlace(columns);
  }
}

bool Opening::is_definite(const Eigen::MatrixXd& stiffness, const std::vector<int>& open,
                          const std::vector<int>& touching, const std::vector<Vec3>& normal) {
  if (open.empty()) return true;
  std::vector<int> rows;
  for (const int pair : open)
    for (int axis = 0; axis < 3; ++axis) rows.push_back(3 * pair + axis);
  Eigen::MatrixXd j = stiffness(rows, rows);
  // Along the normals of touching pairs a stiffness that outweighs all others holds.
  const double holding = 1e6 * j.diagonal().cwiseAbs().maxCoeff();
  for (const int place : touching) {
    const Vec3& n = normal[open[place]];
    const Eigen::Vector3d along(n.x, n.y, n.z);
    j.block<3, 3>(3 * place, 3 * place) += holding * along * along.transpose();
  }
  return Eigen::LLT<Eigen::MatrixXd>(j).info() == Eigen::Success;
}

Opening::Load Opening::prepare(const Eigen::VectorXd& pull) const {
  Load load(factor_.rows());
  for (std::size_t p = 0; p < order_.size(); ++p) load.segment<3>(3 * p) = pull.segment<3>(3 * order_[p]);
  if (!order_.empty()) factor_.matrixL().solveInPlace(load);
  return load;
}

Eigen::VectorXd Opening::jumps(const Load& load, int open, bool contact) const {
  Eigen::VectorXd leading = load.head(3 * open);
  if (contact && open > 0)
    leading += normal_forward_.topLeftCorner(3 * open, open) * contact_forces(load, open);
  return substituted_back(std::move(leading), open);
}

Eigen::VectorXd Opening::jumps(const Load& load, int open, const std::vector<int>& touching,
                               const Eigen::VectorXd& normal_jumps) const {
  Eigen::VectorXd leading = load.head(3 * open);
  if (!touching.empty()) {
    const Eigen::MatrixXd normals = normal_forward_(Eigen::seqN(0, 3 * open), touching);
    const Eigen::MatrixXd compliance = normals.transpose() * normals;
    leading += normals * compliance.llt().solve(normal_jumps - normals.transpose() * leading);
  }
  return substituted_back(std::move(leading), open);
}

Eigen::VectorXd Opening::substituted_back(Eigen::VectorXd leading, int open) const {
  Eigen::VectorXd jumps = Eigen::VectorXd::Zero(size_);
  if (open == 0) return jumps;
  factor_.matrixLLT()
      .topLeftCorner(3 * open, 3 * open)
      .triangularView<Eigen::Lower>()
      .transpose()
      .solveInPlace(leading);
  for (int p = 0; p < open; ++p) jumps.segment<3>(3 * order_[p]) = leading.segment<3>(3 * p);
  return jumps;
}

/// The linear complementarity problem gap = gap_0 + G x >= 0, x >= 0, gap . x = 0 by block principal pivoting
/// (Judice and Pires, 1994): all wrong signs change sides at once, one alone where that does not converge.
Eigen::VectorXd Opening::contact_forces(const Load& load, int open) const {
  const auto normals = normal_forward_.topLeftCorner(3 * open, open);
  const Eigen::VectorXd free_gap = normals.transpose() * load.head(3 * open);
  const double tolerance = 1e-13 * std::max(free_gap.cwiseAbs().maxCoeff(), 1e-300);
  std::vector<bool> touching(static_cast<std::size_t>(open), false);
  int fewest_wrong = open + 1, patience = 3;
  for (int iteration = 0; iteration < 100 + 10 * open; ++iteration) {
    std::vector<int> active;
    for (int p = 0; p < open; ++p)
      if (touching[p]) active.push_back(p);
    Eigen::VectorXd force = Eigen::VectorXd::Zero(open), gap = free_gap;
    if (!active.empty()) {  // G is N^T J^-1 N: few of many pairs touch, so only their part of it is made
      const Eigen::MatrixXd of_active = normals(Eigen::all, active);
      Eigen::MatrixXd compliance = Eigen::MatrixXd::Zero(of_active.cols(), of_active.cols());
      compliance.selfadjointView<Eigen::Lower>().rankUpdate(of_active.transpose());
      const Eigen::VectorXd forces =
          -compliance.selfadjointView<Eigen::Lower>().llt().solve(Eigen::VectorXd(free_gap(active)));
      gap += normals.transpose() * (of_active * forces);
      force(active) = forces;
    }
    std::vector<int> wrong;
    for (int p = 0; p < open; ++p)
      if (touching[p] ? force(p) < 0 : gap(p) < -tolerance) wrong.push_back(p);
    if (wrong.empty()) return force;
    const int count = static_cast<int>(wrong.size());
    if (count < fewest_wrong)
      fewest_wrong = count, patience = 3;
    else if (patience > 0)
      --patience;
    else
      wrong = {wrong.back()};
    for (const int p : wrong) touching[p] = !touching[p];
  }
  throw std::runtime_error("the contact of the lips was not found: the active set does not settle");
}

}  // namespace cleft
