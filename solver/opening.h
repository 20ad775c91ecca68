// The growing cut as one dense problem in the jumps across it. Paper, section 3.1.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <vector>

namespace cleft {

/// All frames of a cut whose pairs of unknowns (left, right) open in a fixed order.
///
/// The constraints u_right - u_left = 0 are eliminated instead of multiplied: with mean m and jump a of each
/// pair, a closed pair has a = 0, exactly. Condensed to the jumps, the stiffness J = A_aa - A_am A_mm^-1 A_ma
/// is the inverse of the multipliers' C K^-1 C^T, and a frame with n open unknowns uses its leading n x n
/// block: one Cholesky J = L L^T and one forward substitution serve every frame.
class Opening {
 public:
  /// `stiffness` (2 n x 2 n) and `load` (2 n) of the cut's unknowns, everything else condensed out: first the
  /// n left ones, then the n right ones, in release order. Throws std::runtime_error where J is not positive
  /// definite.
  Opening(const Eigen::MatrixXd& stiffness, const Eigen::VectorXd& load);

  /// The 2 n unknowns, ordered as the load, with the first `open` unknowns of each side released.
  Eigen::VectorXd displacement(int open) const;

 private:
  Eigen::LLT<Eigen::MatrixXd> mean_factor_, jump_factor_;
  Eigen::MatrixXd mean_jump_;            // A_ma
  Eigen::VectorXd mean_load_, forward_;  // g_m and L^-1 h
};

}  // namespace cleft
