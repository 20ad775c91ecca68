// The least-squares fit of a whole series on given knots: all frames at once.
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "encoder/field/field.h"
#include "encoder/fit_store.h"
#include "encoder/series.h"
#include "encoder/series_system.h"

namespace cleft {

/// The residual of a spline at nodes and frames.
struct Misfit {
  double largest = 0;  ///< mm
  double beyond = 0;   ///< share of the nodes and frames whose residual exceeds a limit
};

/// A bound on the quality of knots in space: the residual of a frame that is fitted alone; `limit` in mm.
struct SpaceMisfit : Misfit {
  double gape = 0;  ///< largest difference of the residual's vectors at the two nodes of a pair, mm
};
SpaceMisfit space_misfit(const Series& series, FitStore& store, const std::array<BSplineBasis, 3>& bases,
                         std::size_t frame, double limit);

/// The least-squares spline in all four variables (see SeriesSystem). Data that are a spline of the space are
/// reproduced to rounding, by repeating the fit on its residual.
class SeriesFit {
 public:
  /// Data in frame 0: zero (the spline is then exactly 0 at t = 0) or any values.
  enum class Start { zero, any };

  /// Keeps references to `series`. `bases` over along, across, height and time. `strength`: of the
  /// regularisation; by default the strongest that costs the fit next to nothing. With a given one the
  /// control points are the same linear function of the data in all cases of a study.
  SeriesFit(const Series& series, std::shared_ptr<const Parametrization> parametrization,
            const std::array<BSplineBasis, 4>& bases, Start start = Start::zero,
            std::optional<double> strength = {});
  /// With matrices of a store that serves the series.
  SeriesFit(const Series& series, std::shared_ptr<FitStore> store, const std::array<BSplineBasis, 4>& bases,
            Start start = Start::zero, std::optional<double> strength = {});

  /// Control points in t of every unknown, column axis n + unknown: T x 3 n, or (T - 1) x 3 n where the first
  /// are 0 and left out.
  const Eigen::MatrixXd& control_points() const { return control_points_; }
  Misfit misfit(double limit) const;
  /// Of the splines that are off by `bound` at most, mm, at any node, takes the one of least squares, or what
  /// a few steps toward it find.
  void keep(double bound);
  /// The control points for other data that are 0 in frame 0, by the same factorised normal matrices: F
  /// frames, N x 3.
  Eigen::MatrixXd control_points_of(const std::vector<Eigen::MatrixX3d>& frames) const;

  /// All control points, in the order of Field; and the field of them.
  std::vector<Vec3> coefficients(const Eigen::MatrixXd& control_points) const;
  Field field(const Eigen::MatrixXd& control_points) const {
    return {parametrization_, bases_, coefficients(control_points)};
  }
  const ControlTies& ties() const { return fit_->ties(); }
  double condition() const { return condition_; }  ///< of the preconditioner's matrices, the largest estimate
  int iterations() const { return iterations_; }
  double strength() const {
    return strength_;
  }  ///< of the regularisation, relative to the mean of B^T B's diagonal

 private:
  struct Chosen {
    int strength = 0;    // of the candidates
    double reached = 0;  // misfit of the frame that is hardly regularised, over its data
  };
  enum class Stronger { never, too };
  void choose_strength();
  Chosen strength_of(std::size_t frame, int first, Stronger stronger) const;
  void solve();
  std::shared_ptr<const SeriesSystem> system_of(double strength) const;
  void refine();
  void add(const std::vector<Eigen::MatrixXd>& blocks);  ///< n x 3 for every control point in t
  Eigen::MatrixX3d errors(Eigen::Index j) const;         ///< at the nodes, of the frame of in_time_'s row
  bool same_in_all_frames() const;
  /// Of a row of in_time_.
  std::size_t frame_of(Eigen::Index j) const {
    return static_cast<std::size_t>(j) + static_cast<std::size_t>(first_);
  }

  const Series& series_;
  std::shared_ptr<FitStore> store_;
  std::shared_ptr<const Parametrization> parametrization_;
  std::array<BSplineBasis, 4> bases_;
  std::shared_ptr<const FrameFit> fit_;
  int first_;                // frame and control point in t; before it all is 0
  Eigen::MatrixXd in_time_;  // frames by control points in t, both from the first on
  Eigen::MatrixXd control_points_;
  std::shared_ptr<const SeriesSystem> system_;
  double strength_ = 0, condition_ = 1;
  double reached_ = 0;  // misfit of fits of single frames that are hardly regularised, over the data
  int iterations_ = 0;
};

}  // namespace cleft
