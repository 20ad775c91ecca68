// The linear system of a fit of all frames at once.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "encoder/space_fit.h"

namespace cleft {

/// Strength of the regularisation in t (second differences of the control points) relative to the data: with
/// as few frames as control points the spline would be free between the frames.
inline constexpr double time_roughness = 1e-4;

/// sum over the frames of (b b^T) x N, and time_roughness (D^T D x mean of N): b the values in t, D second
/// differences, N the frames' normal matrices in space. If all N are equal the matrix is a Kronecker product,
/// and solved as such. Else the preconditioner of the conjugate gradients consists of the diagonal blocks of
/// R^T (system) R, where R R^T is the inverse of the matrix in t: sums of N, weighted by the dependence of
/// each transformed control point on the frames, which is mostly on one frame. (Diagonal blocks without the
/// transformation need three to seven times the iterations.)
class SeriesSystem {
 public:
  using Blocks = std::vector<Eigen::MatrixXd>;  ///< n x 3 for every control point in t

  /// `in_time`: values of the basis in t, frames by control points, without a first control point that is 0;
  /// `from_zero`: whether there is such a point. `normals`: normal matrices of `space`, one for each frame,
  /// or one for all.
  SeriesSystem(const SpaceFit& space, const Eigen::MatrixXd& in_time, bool from_zero,
               std::vector<SpaceFit::Normal> normals);

  /// Solves to a residual of `bound` times the right-hand side, for each component separately.
  Blocks solve(const Blocks& right, double bound) const {
    int iterations = 0;
    return solve(right, bound, iterations);
  }
  /// `iterations`: how many it took.
  Blocks solve(const Blocks& right, double bound, int& iterations) const;
  /// Sum over the frames of b x block.
  Blocks over_frames(const Blocks& of_frames) const;

  double condition() const;  ///< of the preconditioner's matrices, the largest estimate
  double bytes() const;

 private:
  bool same() const { return normals_.size() == 1; }
  Blocks multiply(const Blocks& x) const;
  Blocks precondition(const Blocks& x) const;
  Blocks mixed(const Eigen::MatrixXd& factors, const Blocks& x) const;

  SpaceFit space_;
  Eigen::MatrixXd in_time_;
  std::vector<SpaceFit::Normal> normals_;
  SpaceFit::Normal mean_;         // of several
  Eigen::MatrixXd hold_;          // what time_roughness adds in t
  Eigen::MatrixXd inverse_root_;  // R of the matrix in t: R R^T is its inverse
  std::vector<std::optional<SpaceFit::Factor>> factors_;
};

}  // namespace cleft
