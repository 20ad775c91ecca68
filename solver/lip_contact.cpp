#include "solver/lip_contact.h"

#include "solver/block_rows.h"

namespace cleft {

namespace {

constexpr int most_patience = 3;  // revisions of all wrong pairs that leave as many wrong

}  // namespace

LipContact::LipContact(const PatchMesh& mesh, const PatchSystem& system, const Release& release, bool present)
    : mesh_(mesh),
      system_(system),
      release_(release),
      present_(present),
      cut_(mesh, system),
      touches_(release.order.size(), false) {}

void LipContact::begin(int open) {
  open_ = open;
  revisions_ = 0;
  fewest_wrong_ = open + 1, patience_ = most_patience;
}

Eigen::Vector3d LipContact::normal(int place) const {
  const Vec3& n = mesh_.pairs[release_.order[place]].normal;
  return {n.x, n.y, n.z};
}

void LipContact::set_touching() {
  touching_.places.clear();
  for (int i = 0; i < open_; ++i)
    if (touches_[i]) touching_.places.push_back(i);
  touching_.openings = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(touching_.places.size()));
}

/// Of the open pairs, by place; from the displacements of the cut's nodes.
Eigen::VectorXd LipContact::gaps(const Eigen::MatrixXd& at_cut) const {
  Eigen::VectorXd gaps(open_);
  for (int i = 0; i < open_; ++i) {
    const auto [left, right] = cut_.pairs[release_.order[i]];
    gaps[i] = normal(i).dot((at_cut.middleRows<3>(3 * right) - at_cut.middleRows<3>(3 * left)).col(0));
  }
  return gaps;
}

FrameSolver::Touching LipContact::closing(const Block& displacement) const {
  FrameSolver::Touching closing = touching_;
  if (!closing.places.empty())
    closing.openings = -gaps(all_gather_rows(system_, displacement, cut_.unknowns))(closing.places);
  return closing;
}

/// With which the lips of touching pairs press on each other (negative: pull), by place; N. A closed pair
/// transmits all that is left over on its right side, so that of several copies at a place each has its part.
Eigen::VectorXd LipContact::pressures(const Block& left_over) const {
  Eigen::VectorXd pressures = Eigen::VectorXd::Zero(open_);
  Eigen::MatrixXd forces = all_gather_rows(system_, left_over, cut_.unknowns);
  std::vector<int> place(cut_.pairs.size(), -1);  // of open pairs
  for (int i = 0; i < open_; ++i) place[release_.order[i]] = i;
  for (std::size_t p = cut_.pairs.size(); p-- > 0;) {  // a right node is the left one of later pairs only
    const auto [left, right] = cut_.pairs[p];
    Eigen::Vector3d shared = forces.middleRows<3>(3 * right).col(0);
    if (const int i = place[p]; i >= 0) {
      pressures[i] = touches_[i] ? -normal(i).dot(shared) : 0;
      shared = -pressures[i] * normal(i);
    }
    forces.middleRows<3>(3 * left) += shared;
  }
  return pressures;
}

Block LipContact::forces(const Block& left_over) const {
  Block forces = Block::Zero(left_over.rows(), 1);
  if (touching_.places.empty()) return forces;
  const Eigen::VectorXd pressures = this->pressures(left_over);
  Eigen::MatrixXd at_cut = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(cut_.unknowns.size()), 1);
  for (const int i : touching_.places) {
    const auto [left, right] = cut_.pairs[release_.order[i]];
    at_cut.middleRows<3>(3 * right) += pressures[i] * normal(i);
    at_cut.middleRows<3>(3 * left) -= pressures[i] * normal(i);
  }
  set_rows(system_, forces, cut_.unknowns, at_cut);
  return forces;
}

bool LipContact::revise(const Block& displacement, const Block& left_over, double least_force,
                        double least_overlap) {
  if (!present_ || open_ == 0) return false;
  const Eigen::MatrixXd at_cut = all_gather_rows(system_, displacement, cut_.unknowns);
  const Eigen::VectorXd gaps = this->gaps(at_cut), pressures = this->pressures(left_over);
  least_overlap *= at_cut.cwiseAbs().maxCoeff();
  std::vector<int> wrong;
  for (int i = 0; i < open_; ++i)
    if (touches_[i] ? pressures[i] < -least_force : gaps[i] < -least_overlap) wrong.push_back(i);
  if (wrong.empty()) return false;
  const int count = static_cast<int>(wrong.size());
  if (count < fewest_wrong_)
    fewest_wrong_ = count, patience_ = most_patience;
  else if (patience_ > 0)
    --patience_;
  else
    wrong = {wrong.back()};
  for (const int i : wrong) touches_[i] = !touches_[i];
  ++revisions_;
  set_touching();
  return true;
}

}  // namespace cleft
