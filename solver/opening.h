// The growing cut as one dense problem in the jumps across it. Paper, section 3.1.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <vector>

#include "base/vec3.h"

namespace cleft {

/// All frames of a cut whose pairs open in a fixed order. J is the Schur complement of the jumps u_right -
/// u_left, and the inverse of the multipliers' matrix C K^-1 C^T. The jump of a closed pair is 0, so a frame
/// with n open pairs uses the leading 3 n x 3 n block of J: one Cholesky factorisation J = L L^T, and one
/// forward substitution for each load, serve all frames.
class Opening {
 public:
  /// `stiffness`: three rows for every pair of the mesh. `order`: the pairs that open, in release order.
  /// `normal` of every pair, for contact. Throws std::runtime_error if J is not positive definite.
  Opening(const Eigen::MatrixXd& stiffness, std::vector<int> order, const std::vector<Vec3>& normal);

  /// Whether J is positive definite among the jumps of `open` pairs, of which those at the places `touching`
  /// have none along their normals.
  static bool is_definite(const Eigen::MatrixXd& stiffness, const std::vector<int>& open,
                          const std::vector<int>& touching, const std::vector<Vec3>& normal);

  /// A load with its forward substitution.
  using Load = Eigen::VectorXd;
  /// `pull`: the right-hand side g of J a = g, three rows for every pair of the mesh, N.
  Load prepare(const Eigen::VectorXd& pull) const;

  /// Jumps of all pairs of the mesh, mm, with the first `open` pairs of the order released. With contact the
  /// lips press on each other, without friction, where they would overlap: normal jumps >= 0.
  Eigen::VectorXd jumps(const Load& load, int open, bool contact) const;

  /// The same where the lips of some open pairs touch, by their places in the order: their normal jumps are
  /// given, mm, whether they press or pull. All others are free.
  Eigen::VectorXd jumps(const Load& load, int open, const std::vector<int>& touching,
                        const Eigen::VectorXd& normal_jumps) const;

 private:
  /// From L^T times the jumps of the open pairs.
  Eigen::VectorXd substituted_back(Eigen::VectorXd leading, int open) const;
  /// Forces >= 0 that keep the normal jumps >= 0, by pair.
  Eigen::VectorXd contact_forces(const Load& load, int open) const;

  Eigen::Index size_;
  std::vector<int> order_;
  Eigen::LLT<Eigen::MatrixXd> factor_;
  Eigen::MatrixXd normal_forward_;  // L^-1 N, a column a pair: its leading block serves every frame too
};

}  // namespace cleft
