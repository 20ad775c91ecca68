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

/// The spline over (along, across, height) of a parametrisation, at scattered samples, with the control
/// points tied where the tissue is uncut. The samples' parameters across and in height are constant, and
/// samples of equal u move together along the cut. Their contributions to the normal matrix are therefore
/// summed once (for all planes u = const with nodes at the same places), and a frame only weights the sums
/// along u. Matrices have one row for each sample or for each unknown (ties().size()). Copies share what they
/// hold. All functions may be called from several threads at once.
class SpaceFit {
 public:
  SpaceFit(const Parametrization& parametrization, const std::array<BSplineBasis, 3>& bases,
           const std::vector<Sample>& samples);

  const ControlTies& ties() const;

  /// B^T B + strength R over all control points. R, relative to the mean diagonal of B^T B, penalises second
  /// divided differences of the control points over their places at time t; linear functions cost nothing,
  /// and differences never extend across v = 0. Two control points share basis functions only if their
  /// indices differ by at most 3.
  class Normal {
   public:
    /// Adds `factor` times another matrix.
    void add(double factor, const Normal& other);
    double bytes() const;

   private:
    friend class SpaceFit;
    std::vector<std::array<std::vector<double>, 4>>
        stencils_;  // of rows i and i + d: by control, by difference
  };
  Normal normal(double t, double strength) const;
  /// Adds strength R, so that the matrix is that of a strength larger by this.
  void roughen(Normal& normal, double strength) const;
  /// ties^T normal ties x.
  Eigen::MatrixXd multiply(const Normal& normal, const Eigen::MatrixXd& x) const;

  /// Cholesky factor of ties^T normal ties.
  class Factor {
   public:
    ~Factor();
    Factor(Factor&&) noexcept;
    Eigen::MatrixXd solve(Eigen::MatrixXd x) const;
    double condition() const;  ///< of the matrix, estimated from below by its factor's diagonal
    double bytes() const;

   private:
    friend class SpaceFit;
    struct Parts;
    explicit Factor(std::unique_ptr<Parts> parts);
    std::unique_ptr<Parts> parts_;
  };
  Factor factorize(const Normal& normal) const;

  /// ties^T B^T values: the right-hand side for values at the samples at time t.
  Eigen::MatrixX3d project(const Eigen::Ref<const Eigen::MatrixX3d>& values, double t) const;
  /// B ties x: the spline's values at the samples.
  Eigen::MatrixX3d values(const Eigen::MatrixX3d& x, double t) const;

  double bytes() const;

  struct Parts;

 private:
  /// A row a control point: three components and a 0, so that all four are one operation.
  using Grid = Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor>;
  static std::vector<Grid> multiplied(const Parts& parts, const Normal& normal, const std::vector<Grid>& x);
  std::shared_ptr<const Parts> parts_;
};

}  // namespace cleft
