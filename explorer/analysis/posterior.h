// Which values of parameters explain measurements, and how surely (Bayes).
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>

namespace cleft {

/// Logarithms of densities, up to a constant, at points of the unit cube, a column for each.
using LogDensity = std::function<Eigen::VectorXd(const Eigen::MatrixXd& points)>;

struct Posterior {
  Eigen::MatrixXd points;      ///< drawn from the density, a column for each, 0 to 1
  Eigen::VectorXd logarithms;  ///< of the density there
  double effective = 0;        ///< independent draws that tell as much
  int evaluations = 0;

  Eigen::VectorXd most_likely() const;
  Eigen::MatrixXd covariance() const;
  /// The part of the draws that are less likely than a density: it is above 0.1 in the 90 % region.
  double part_below(double logarithm) const;
};

struct PosteriorSettings {
  int walkers = 64;
  int most_steps = 3000;
  double effective = 1000;  ///< draws that are enough
  std::uint64_t seed = 1;
};

/// Draws by an ensemble of walkers that needs no scales (Goodman and Weare, Ensemble samplers with affine
/// invariance, 2010), from points of the whole cube on; its first half is thrown away. The same for the same
/// seed. `dimension` is at least 1. Throws InputError if the density is 0 everywhere.
Posterior draw_posterior(int dimension, const LogDensity& density, const PosteriorSettings& settings = {});

}  // namespace cleft
