// A field in few bytes.
#pragma once

#include "encoder/field/field.h"

namespace cleft {

/// The field with control points that are multiples of a step, so that its file is as small as that of an
/// encoded case, if no point of it moves by more than `bound`, mm. Else the field is unchanged, for a file of
/// floats: inserted knots at the rim of the cut can contain a cusp that the unknowns of finer knots cannot
/// represent.
Field compact(const Field& field, double bound);

/// The same of a field that was interpolated, for its file: no point moves by more than a tenth of its
/// estimated error at the nodes (its report's node_error), nor by more than a tenth of what the fits of the
/// cases contribute to it (at least 2e-4 of the largest displacement). Between few cases the estimate of what
/// they do not tell can exceed the displacement itself; a share of that would be an error that was not there.
Field compact_interpolated(const Field& field);

}  // namespace cleft
