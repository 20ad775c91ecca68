// The growing cut as one dense problem in the jumps across it. Paper, section 3.1.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <array>
#include <vector>

#include "base/vec3.h"

namespace cleft {

/// Everything but the jumps across the cut condensed out of the stiffness of the cut's nodes.
///
/// The constraints u_right - u_left = 0 are eliminated instead of multiplied: with m, the displacement of the
/// first copy of every node, and a, the jump of every pair, a closed pair has a = 0, exactly. The stiffness
/// of the jumps, J = A_aa - A_am A_mm^-1 A_ma, is the inverse of the multipliers' C K^-1 C^T.
class CutCondensation {
 public:
  /// `stiffness` of the cut's nodes, three unknowns each, everything else condensed out. `pairs`: left and
  /// right among these nodes; a right node is the left one of later pairs only. Throws std::runtime_error
  /// where the closed cut is not held.
  CutCondensation(Eigen::MatrixXd stiffness, std::vector<std::array<int, 2>> pairs);

  Eigen::Index nodes() const { return nodes_; }
  /// Three rows a pair, in the order of the pairs.
  const Eigen::MatrixXd& jump_stiffness() const { return jump_stiffness_; }

  /// A load of the cut's nodes, condensed likewise.
  struct Load {
    Eigen::VectorXd closed;  ///< displacement of the first copies with the cut closed
    Eigen::VectorXd jump;    ///< what pulls at the jumps
  };
  Load condense(Eigen::VectorXd load) const;
  /// Of all nodes, from the jumps of all pairs.
  Eigen::VectorXd displacement(const Load& load, const Eigen::VectorXd& jump) const;

 private:
  std::vector<std::array<int, 2>> pairs_;
  std::vector<int> first_copies_;
  Eigen::Index nodes_;
  Eigen::LLT<Eigen::MatrixXd> closed_factor_;  // of A_mm
  Eigen::MatrixXd coupling_, carried_;         // A_ma, and A_mm^-1 A_ma
  Eigen::MatrixXd jump_stiffness_;
};

/// All frames of a cut whose pairs open in a fixed order. A frame with n open pairs uses the leading 3 n x 3
/// n block of J: one Cholesky J = L L^T and one forward substitution a load serve every frame.
class Opening {
 public:
  /// `order`: the pairs that open, in release order; `normal` of every pair, for contact. Throws
  /// std::runtime_error where the open cut is not held.
  Opening(const CutCondensation& condensation, std::vector<int> order, const std::vector<Vec3>& normal);

  /// A load with its forward substitution.
  struct Load {
    CutCondensation::Load condensed;
    Eigen::VectorXd forward;
  };
  Load prepare(Eigen::VectorXd load) const;

  /// Displacement of the cut's nodes with the first `open` pairs released. With contact their lips press on
  /// each other where they would overlap, without friction: normal jumps >= 0.
  Eigen::VectorXd displacement(const Load& load, int open, bool contact) const;

 private:
  /// Pressures >= 0 that keep the normal jumps >= 0, by pair.
  Eigen::VectorXd contact_forces(const Eigen::VectorXd& forward, int open) const;

  const CutCondensation& condensation_;
  std::vector<int> order_;
  Eigen::LLT<Eigen::MatrixXd> factor_;
  Eigen::MatrixXd normal_forward_;  // L^-1 N, a column a pair: its leading block serves every frame too
};

}  // namespace cleft
