// Regularised least squares in space, frame by frame: the spatial half of the fit. Paper, section 3.3.
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <vector>

#include "encoder/field/control_ties.h"
#include "encoder/field/field.h"
#include "encoder/samples.h"

namespace cleft {

/// Fits values at scattered samples by the tensor-product spline over (along, across, height) of a
/// parametrisation, with the control points tied where the tissue is uncut. The samples' places across and in
/// height never move, and samples of equal u move together along the cut: what they add to the normal matrix
/// is summed once, and a frame only weighs it along u.
class SpaceFit {
 public:
  SpaceFit(const Parametrization& parametrization, const std::array<BSplineBasis, 3>& bases,
           const std::vector<Sample>& samples);
  ~SpaceFit();

  const ControlTies& ties() const;

  /// The factor of the normal matrix B^T B + lambda R at time t. R penalises second divided differences of
  /// the control points over their places, straight lines cost nothing; never across v = 0.
  class Factor {
   public:
    ~Factor();
    Factor(Factor&&) noexcept;
    /// Unknowns (ties().size() rows) for samples' values, columns alike, one row a sample.
    Eigen::MatrixXd solve(const Eigen::Ref<const Eigen::MatrixXd>& values) const;

   private:
    friend class SpaceFit;
    struct Parts;
    explicit Factor(std::unique_ptr<Parts> parts);
    std::unique_ptr<Parts> parts_;
  };
  /// Safe to call from several threads at once.
  Factor factorize(double t) const;

 private:
  struct Parts;
  std::unique_ptr<const Parts> parts_;
};

}  // namespace cleft
