// Lips that press on each other under finite strains: which pairs touch, found together with the equilibrium.
#pragma once

#include <vector>

#include "solver/cut_nodes.h"
#include "solver/frame_solver.h"

namespace cleft {

/// Contact is that of the small model: without friction, between the two nodes of a pair, along the normal of
/// the closed cut. The pairs that touch are a guess that is revised until none of them pulls and no other
/// overlaps: the wrong ones change sides, all at once, or one alone where that does not lead on (block
/// principal pivoting, Judice and Pires 1994). Equal on all ranks; calls are collective.
class LipContact {
 public:
  /// Keeps references to all. Not `present`: no pair ever touches.
  LipContact(const PatchMesh& mesh, const PatchSystem& system, const Release& release, bool present);

  /// For a frame with so many open pairs, or a part of its load; starts with the pairs that touched before.
  void begin(int open);

  /// What closes the gaps that the touching pairs have, as a change of the displacement.
  FrameSolver::Touching closing(const Block& displacement) const;
  /// What keeps them closed.
  const FrameSolver::Touching& sliding() const { return touching_; }

  /// The forces, N, with which touching pairs press on each other, or pull: the normal part of what is
  /// `left_over` of the forces there.
  Block forces(const Block& left_over) const;

  /// Corrects the guess; whether it has changed. Pulls below `least_force`, N, are not seen, nor are overlaps
  /// below this part of the largest displacement at the cut.
  bool revise(const Block& displacement, const Block& left_over, double least_force, double least_overlap);

  /// Since begin().
  int revisions() const { return revisions_; }

 private:
  Eigen::VectorXd gaps(const Eigen::MatrixXd& at_cut) const;
  Eigen::VectorXd pressures(const Block& left_over) const;
  Eigen::Vector3d normal(int place) const;
  void set_touching();

  const PatchMesh& mesh_;
  const PatchSystem& system_;
  const Release& release_;
  bool present_;
  CutNodes cut_;
  int open_ = 0;
  std::vector<bool> touches_;  // by place in the release
  FrameSolver::Touching touching_;
  int revisions_ = 0, fewest_wrong_ = 0, patience_ = 0;
};

}  // namespace cleft
