// What of a figure's spread is due to each parameter (Sobol's indices), and how the figure is distributed.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "explorer/analysis/distribution.h"

namespace cleft {

/// Values of a figure at points, a column for each.
using FigureFunction = std::function<Eigen::VectorXd(const Eigen::MatrixXd& points)>;
/// The same as several sets of data tell it: a row for each.
using AlternativeFigures = std::function<Eigen::MatrixXd(const Eigen::MatrixXd& points)>;

/// A number, and half the width of its 95 % interval.
struct Estimate {
  double value = 0, error = 0;
};

struct ParameterEffect {
  Estimate first;            ///< share of the variance that the parameter has alone
  Estimate total;            ///< share that would be left if all others were known
  std::vector<double> at;    ///< values of the parameter, from its 2.5 % to its 97.5 % quantile
  std::vector<double> mean;  ///< of the figure there, over all others
};

struct Sensitivities {
  std::vector<ParameterEffect> parameters;
  double mean = 0, deviation = 0;
  std::vector<double> parts;      ///< of the quantiles
  std::vector<double> quantiles;  ///< of the figure
  Eigen::MatrixXd points;         ///< drawn, a column for each
  Eigen::VectorXd values;         ///< of the figure there
  int evaluations = 0;
};

/// Half the width of the 95 % interval of a number, from its values without each part of the data in turn; 0
/// of fewer than two.
double jackknife_error(const Eigen::VectorXd& values);

/// By Jansen's estimators (1999) on a sequence of low discrepancy, first indices also by Mauntz's and
/// Kucherenko's (2005), which are surer of small ones; `size` times two more than there are parameters.
/// `alternatives`, if given: the figure as other data tell it, by leaving parts of the cases out (jackknife);
/// what the indices differ by is in their intervals, with what the finite sample leaves open. Throws
/// InputError if the figure does not change.
Sensitivities sensitivities_of(const std::vector<InputDistribution>& distributions,
                               const FigureFunction& figure, const AlternativeFigures& alternatives,
                               int size);

}  // namespace cleft
