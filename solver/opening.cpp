#include "solver/opening.h"

#include <Eigen/LU>
#include <algorithm>
#include <stdexcept>
#include <string>

#include "solver/frame_solver.h"

namespace cleft {

CutCondensation::CutCondensation(Eigen::MatrixXd stiffness, std::vector<std::array<int, 2>> pairs)
    : pairs_(std::move(pairs)), nodes_(stiffness.rows() / 3) {
  // u_right = u_left + a: what acts on a right node acts on its left one as well.
  std::vector<bool> is_right(static_cast<std::size_t>(nodes_), false);
  for (auto pair = pairs_.rbegin(); pair != pairs_.rend(); ++pair) {
    const auto [left, right] = *pair;
    stiffness.middleCols<3>(3 * left) += stiffness.middleCols<3>(3 * right);
    stiffness.middleRows<3>(3 * left) += stiffness.middleRows<3>(3 * right);
    is_right[right] = true;
  }
  std::vector<int> first, jump;
  for (int node = 0; node < nodes_; ++node)
    if (!is_right[node]) first_copies_.push_back(node);
  for (const int node : first_copies_)
    for (int axis = 0; axis < 3; ++axis) first.push_back(3 * node + axis);
  for (const auto& pair : pairs_)
    for (int axis = 0; axis < 3; ++axis) jump.push_back(3 * pair[1] + axis);
  jump_stiffness_ = stiffness(jump, jump);
  if (first.empty()) return;
  closed_factor_.compute(stiffness(first, first));
  if (closed_factor_.info() != Eigen::Success)
    throw std::runtime_error(
        std::string("the closed patch is not held: its stiffness is not positive definite; ") +
        cause_of_indefinite);
  coupling_ = stiffness(first, jump);
  carried_ = closed_factor_.solve(coupling_);
  jump_stiffness_.noalias() -= coupling_.transpose() * carried_;
}

CutCondensation::Load CutCondensation::condense(Eigen::VectorXd load) const {
  for (auto pair = pairs_.rbegin(); pair != pairs_.rend(); ++pair)
    load.segment<3>(3 * (*pair)[0]) += load.segment<3>(3 * (*pair)[1]);
  Load condensed{Eigen::VectorXd(3 * first_copies_.size()), Eigen::VectorXd(3 * pairs_.size())};
  for (std::size_t i = 0; i < first_copies_.size(); ++i)
    condensed.closed.segment<3>(3 * i) = load.segment<3>(3 * first_copies_[i]);
  for (std::size_t p = 0; p < pairs_.size(); ++p)
    condensed.jump.segment<3>(3 * p) = load.segment<3>(3 * pairs_[p][1]);
  if (first_copies_.empty()) return condensed;
  condensed.jump -= carried_.transpose() * condensed.closed;
  closed_factor_.solveInPlace(condensed.closed);
  return condensed;
}

Eigen::VectorXd CutCondensation::displacement(const Load& load, const Eigen::VectorXd& jump) const {
  const Eigen::VectorXd first = load.closed - carried_ * jump;
  Eigen::VectorXd all(3 * nodes_);
  for (std::size_t i = 0; i < first_copies_.size(); ++i)
    all.segment<3>(3 * first_copies_[i]) = first.segment<3>(3 * i);
  for (std::size_t p = 0; p < pairs_.size(); ++p)
    all.segment<3>(3 * pairs_[p][1]) = all.segment<3>(3 * pairs_[p][0]) + jump.segment<3>(3 * p);
  return all;
}

Opening::Opening(const CutCondensation& condensation, std::vector<int> order, const std::vector<Vec3>& normal)
    : condensation_(condensation), order_(std::move(order)) {
  if (order_.empty()) return;
  std::vector<int> unknowns;
  for (const int pair : order_)
    for (int axis = 0; axis < 3; ++axis) unknowns.push_back(3 * pair + axis);
  factor_.compute(condensation_.jump_stiffness()(unknowns, unknowns));
  if (factor_.info() != Eigen::Success)
    throw std::runtime_error(
        std::string("the open patch is not held: its stiffness is not positive definite; ") +
        cause_of_indefinite);
  normal_forward_ = Eigen::MatrixXd::Zero(factor_.rows(), static_cast<Eigen::Index>(order_.size()));
  for (std::size_t p = 0; p < order_.size(); ++p)
    for (int axis = 0; axis < 3; ++axis)
      normal_forward_(3 * static_cast<Eigen::Index>(p) + axis, static_cast<Eigen::Index>(p)) =
          normal[static_cast<std::size_t>(order_[p])][axis];
  factor_.matrixL().solveInPlace(normal_forward_);
}

Opening::Load Opening::prepare(Eigen::VectorXd load) const {
  Load prepared{condensation_.condense(std::move(load)), Eigen::VectorXd(factor_.rows())};
  for (std::size_t p = 0; p < order_.size(); ++p)
    prepared.forward.segment<3>(3 * p) = prepared.condensed.jump.segment<3>(3 * order_[p]);
  if (!order_.empty()) factor_.matrixL().solveInPlace(prepared.forward);
  return prepared;
}

Eigen::VectorXd Opening::displacement(const Load& load, int open, bool contact) const {
  Eigen::VectorXd jump = Eigen::VectorXd::Zero(condensation_.jump_stiffness().rows());
  if (open > 0) {
    Eigen::VectorXd leading = load.forward.head(3 * open);
    if (contact)
      leading += normal_forward_.topLeftCorner(3 * open, open) * contact_forces(load.forward, open);
    factor_.matrixLLT()
        .topLeftCorner(3 * open, 3 * open)
        .triangularView<Eigen::Lower>()
        .transpose()
        .solveInPlace(leading);
    for (int p = 0; p < open; ++p) jump.segment<3>(3 * order_[p]) = leading.segment<3>(3 * p);
  }
  return condensation_.displacement(load.condensed, jump);
}

/// The linear complementarity problem gap = gap_0 + G x >= 0, x >= 0, gap . x = 0 by block principal pivoting
/// (Judice and Pires, 1994): all wrong signs change sides at once, one alone where that does not converge.
Eigen::VectorXd Opening::contact_forces(const Eigen::VectorXd& forward, int open) const {
  const auto normals = normal_forward_.topLeftCorner(3 * open, open);
  const Eigen::VectorXd free_gap = normals.transpose() * forward.head(3 * open);
  const Eigen::MatrixXd compliance = normals.transpose() * normals;
  const double tolerance = 1e-13 * std::max(free_gap.cwiseAbs().maxCoeff(), 1e-300);
  std::vector<bool> touching(static_cast<std::size_t>(open), false);
  int fewest_wrong = open + 1, patience = 3;
  for (int iteration = 0; iteration < 100 + 10 * open; ++iteration) {
    std::vector<int> active;
    for (int p = 0; p < open; ++p)
      if (touching[p]) active.push_back(p);
    Eigen::VectorXd force = Eigen::VectorXd::Zero(open);
    if (!active.empty())
      force(active) =
          -Eigen::MatrixXd(compliance(active, active)).llt().solve(Eigen::VectorXd(free_gap(active)));
    const Eigen::VectorXd gap = free_gap + compliance * force;
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
