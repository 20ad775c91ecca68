// The linear system of a fit of all frames at once.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "encoder/space_fit.h"

namespace cleft {

/// What holds second differences of the control points in t, relative to what the frames say of them: frames
/// that are as few as the control points would leave the spline free between them.
inline constexpr double time_roughness = 1e-4;

/// sum over the frames of (b b^T) x N, and time_roughness (D^T D x mean of N): b the values in t, D second
/// differences, N the frames' normal matrices in space. Where all N are the same that is a Kronecker product,
/// and solved as one. Else conjugate gradients are preconditioned by the diagonal blocks of the system
/// between R^T and R, where R R^T is the inverse of the matrix in t: sums of N by what each transformed
/// control point sees of the frames, mostly of one. (The means of N that control points see as they are took
/// three to seven times the iterations.)
class SeriesSystem {
 public:
  using Blocks = std::vector<Eigen::MatrixXd>;  ///< n x 3 for every control point in t

  /// `in_time`: frames by control points in t, from the first on that are not 0; `from_zero`: there is one
  /// before them, which is. Normal matrices of `space`, one for each frame, or one for all.
  SeriesSystem(const SpaceFit& space, const Eigen::MatrixXd& in_time, bool from_zero,
               std::vector<SpaceFit::Normal> normals);

  /// To a residual of `bound` times the right-hand side, each component for itself.
  Blocks solve(const Blocks& right, double bound) const;
  /// sum over the frames of b x block.
  Blocks over_frames(const Blocks& of_frames) const;

  double condition() const;                       ///< of the preconditioner's matrices, the largest estimate
  int iterations() const { return iterations_; }  ///< that the last solution took

 private:
  bool same() const { return normals_.size() == 1; }
  Blocks multiply(const Blocks& x) const;
  Blocks precondition(const Blocks& x) const;
  Blocks mixed(const Eigen::MatrixXd& factors, const Blocks& x) const;

  const SpaceFit& space_;
  Eigen::MatrixXd in_time_;
  std::vector<SpaceFit::Normal> normals_;
  SpaceFit::Normal mean_;         // of several
  Eigen::MatrixXd hold_;          // what time_roughness adds in t
  Eigen::MatrixXd inverse_root_;  // R of the matrix in t: R R^T is its inverse
  std::vector<std::optional<SpaceFit::Factor>> factors_;
  mutable int iterations_ = 0;
};

}  // namespace cleft
