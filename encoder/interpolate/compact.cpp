#include "encoder/interpolate/compact.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "encoder/field/unknowns.h"

namespace cleft {

Field compact(const Field& field, double bound) {
  if (!(bound > 0)) return field;
  // Control points half a step off each way are off by sqrt(3) / 2 steps, and so is nothing between them.
  const Field stepped = quantised(field, bound / std::sqrt(3.), 0.5);
  for (std::size_t n = 0; n < field.coefficients().size(); ++n)
    if (norm(stepped.coefficients()[n] - field.coefficients()[n]) > bound) return field;
  return stepped;
}

Field compact_interpolated(const Field& field) {
  constexpr double share = 0.1, least_fit = 2e-3;
  CLEFT_CHECK(field.interpolation.has_value(), ==, true);
  const double whole = field.report.node_error,  // of all that the file will hold
      between = field.interpolation->interpolation_error;
  const double fit = std::sqrt(std::max(0., whole * whole - between * between));
  return compact(field,
                 share * std::min(whole, std::max(fit, least_fit)) * field.report.largest_displacement);
}

}  // namespace cleft
