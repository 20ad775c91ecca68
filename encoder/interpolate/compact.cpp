#include "encoder/interpolate/compact.h"

#include <cmath>

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

}  // namespace cleft
