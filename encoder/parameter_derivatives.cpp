#include "encoder/parameter_derivatives.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "encoder/field/unknowns.h"

namespace cleft {

namespace {

constexpr double share_of_derivative_steps = 0.25;  // of the fit's own error, at most
constexpr double finest = 1e-6;                     // bound that steps are made for, over the largest value
constexpr double farthest = 0.625;                  // steps a control point may be moved to be cheaper

/// Largest distance from the data at any node and frame.
double error_of(const Field& field, const Series& series, const SeriesDerivative& data) {
  std::vector<double> errors(series.times.size());
  parallel_for(static_cast<int>(errors.size()), [&](int frame) {
    const std::size_t j = frame;
    std::vector<Place> places;
    for (const Sample& sample : series.samples) places.push_back({sample.uvw, sample.side, series.times[j]});
    std::vector<Vec3> values(places.size());
    field.displacements(places, values);
    for (std::size_t n = 0; n < values.size(); ++n) {
      const auto row = data.frames[j].row(static_cast<Eigen::Index>(n));
      errors[j] = std::max(errors[j], norm(values[n] - Vec3{row(0), row(1), row(2)}));
    }
  });
  return *std::max_element(errors.begin(), errors.end());
}

ParameterDerivative fitted(const SeriesDerivative& data, const Series& series, const SeriesFit& fit) {
  const Field exact = fit.field(fit.control_points_of(data.frames));
  const double bound =
      std::max(share_of_derivative_steps * error_of(exact, series, data), finest * data.largest);
  // Steps as in a displacement's fit: half a step each way is sqrt(3) / 2 steps together.
  const Field stepped = quantised(exact, 2 / std::sqrt(3.) * bound, farthest);
  return {data.parameter, stepped.coefficients(), stepped.quantum, data.largest,
          error_of(stepped, series, data) / data.largest};
}

}  // namespace

std::vector<ParameterDerivative> fit_derivatives(const Series& series, const SeriesFit& fit) {
  std::vector<ParameterDerivative> list;
  for (const SeriesDerivative& data : series.derivatives)
    if (data.largest > 0) list.push_back(fitted(data, series, fit));
  return list;
}

}  // namespace cleft
