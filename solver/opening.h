// The growing cut as one dense problem in the jumps across it. Paper, section 3.1.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <vector>

#include "base/vec3.h"

namespace cleft {

/// All frames of a cut whose pairs open in a fixed order.
///
/// The stiffness J of the jumps u_right - u_left, everything else condensed out, is the inverse of the
/// multipliers' C K^-1 C^T. A closed pair has no jump, so a frame with n open pairs uses the leading 3 n x 3
/// n block of J: one Cholesky J = L L^T and one forward substitution a load serve every frame.
class Opening {
 public:
  /// `stiffness`: three rows for every pair of the mesh. `order`: the pairs that open, in release order.
  /// `normal` of every pair, for contact. Throws std::runtime_error where the open cut is not held.
  Opening(const Eigen::MatrixXd& stiffness, std::vector<int> order, const std::vector<Vec3>& normal);

  /// A load with its forward substitution.
  using Load = Eigen::VectorXd;
  /// From what pulls at the jumps, three rows for every pair of the mesh.
  Load prepare(const Eigen::VectorXd& pull) const;

  /// Jumps of all pairs of the mesh with the first `open` of the order released. With contact the lips press
  /// on each other where they would overlap, without friction: normal jumps >= 0.
  Eigen::VectorXd jumps(const Load& load, int open, bool contact) const;

 private:
  /// Forces >= 0 that keep the normal jumps >= 0, by pair.
  Eigen::VectorXd contact_forces(const Load& load, int open) const;

  Eigen::Index size_;
  std::vector<int> order_;
  Eigen::LLT<Eigen::MatrixXd> factor_;
  Eigen::MatrixXd normal_forward_;  // L^-1 N, a column a pair: its leading block serves every frame too
};

}  // namespace cleft
