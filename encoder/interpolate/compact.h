// A field as few bytes.
#pragma once

#include "encoder/field/field.h"

namespace cleft {

/// The field with control points that are multiples of a step, so that its file is as small as an encoded
/// case's, where no point of it moves by more than `bound` mm. Else as it is, for a file of floats: knots
/// inserted beside the rim of the cut hold a cusp that the unknowns of finer knots have no place for.
Field compact(const Field& field, double bound);

}  // namespace cleft
