// Interpolation of the measures of the body and its cut, from which a field's parametrisation is made.
#pragma once

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "encoder/field/parametrization.h"
#include "encoder/interpolate/features.h"

namespace cleft {

/// Domain, start, length and depth of the cut, and the path of the tip as parts of duration and length: of
/// any prestress. The measures of a body are linear in its parameters; the model is a linear fit, and its
/// residual at the cases (rounding to the mesh) is interpolated by inverse distances (Shepard 1968).
class GeometryModel {
 public:
  GeometryModel(const std::vector<RecordedParameters>& parameters,
                const std::vector<FieldGeometry>& geometries);
  FieldGeometry at(const RecordedParameters& parameters) const;
  nlohmann::ordered_json data() const;  ///< see Features

 private:
  Eigen::VectorXd place_of(const RecordedParameters& parameters) const;

  std::vector<std::string> varying_;
  std::vector<Eigen::Index> measured_by_;  // of these: all but prestresses
  Eigen::VectorXd middle_, half_;
  Eigen::MatrixXd places_;     // n x d, from -1 to 1
  std::vector<double> times_;  // of the tip's path, 0 to 1
  Eigen::MatrixXd linear_;     // (1 + d) x measures
  Eigen::MatrixXd left_;       // n x measures
  Eigen::VectorXd constant_;   // measures that are the same in all cases; else NaN
};

}  // namespace cleft
