// The parameters of a study that explain measurements: their probable values, what the measurements leave
// open, and what would tell more.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "explorer/analysis/distribution.h"
#include "explorer/analysis/figure_model.h"
#include "explorer/analysis/measurements.h"
#include "explorer/analysis/posterior.h"

namespace cleft {

/// What a parameter may be: mean, standard deviation, the middle 90 %, and the most likely value.
struct FittedParameter {
  std::string name;
  double mean = 0, deviation = 0, low = 0, high = 0, most_likely = 0;
  double told = 0;  ///< 1 less the deviation over that before the measurements; 0: they tell nothing of it
};

struct ParameterFit {
  std::vector<FittedParameter> parameters;
  Eigen::MatrixXd correlation;
  std::vector<std::string> open;  ///< what the measurements do not tell, as sentences
  double misfit = 0;  ///< of the most likely values: root mean square of the residuals, over their deviations
  double misfit_probability = 0;  ///< that measurements of a case are off by as much
  Eigen::VectorXd residuals;      ///< measured less fitted, in the units of the measurements
  Posterior posterior;            ///< in the cube of the distributions
  Eigen::VectorXd next_case;      ///< values of the parameters at which a simulation would tell most
};

/// Of residuals that are independent and normal, with the deviations of the measurements, of the
/// interpolation, and of the fields of the cases.
class MeasurementFit {
 public:
  /// All must outlive it. The model's figures are those of the measurements (any, where these are forces
  /// alone).
  MeasurementFit(const FigureModel& model, const Measurements& measurements,
                 const std::vector<InputDistribution>& distributions);

  /// The values of the parameters at points of the unit cube.
  Eigen::MatrixXd values_at(const Eigen::MatrixXd& points) const;
  Eigen::VectorXd log_density(const Eigen::MatrixXd& points) const;
  ParameterFit find(const PosteriorSettings& settings = {}) const;

 private:
  /// Of the measurements, in their order.
  FigureModel::Answers answers_at(const Eigen::MatrixXd& values) const;
  Eigen::MatrixXd variances(const FigureModel::Answers& answers) const;

  const FigureModel& model_;
  const Measurements& measurements_;
  const std::vector<InputDistribution>& distributions_;
};

/// Of the figures of a model the one whose further measurement would tell most: with the largest spread among
/// the values that are still possible.
struct NextMeasurement {
  int figure = 0;
  double spread = 0;  ///< mm: standard deviation
};
NextMeasurement next_measurement(const FigureModel& candidates, const Eigen::MatrixXd& possible_values);

}  // namespace cleft
