// A field and what its file keeps of the data beside the spline.
#pragma once

#include <optional>
#include <vector>

#include "encoder/field/field.h"
#include "encoder/field/node_residual.h"

namespace cleft {

struct Encoded {
  Field field;                                 ///< with its report
  std::optional<CodedResidual> residual = {};  ///< if the spline alone does not satisfy the tolerance
  std::vector<std::optional<CodedResidual>> of_quantities = {};  ///< the same of field.quantities
};

}  // namespace cleft
