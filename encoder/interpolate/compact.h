// A field in few bytes.
#pragma once

#include "encoder/field/field.h"

namespace cleft {

/// The field with control points that are multiples of a step, so that its file is as small as that of an
/// encoded case, if no point of it moves by more than `bound`, mm. Else the field is unchanged, for a file of
/// floats: inserted knots at the rim of the cut can contain a cusp that the unknowns of finer knots cannot
/// represent.
Field compact(const Field& field, double bound);

}  // namespace cleft
