// What cleft encode warns of.
#pragma once

#include <string>
#include <vector>

#include "encoder/encode.h"

namespace cleft {

/// Where the spline of the displacement or of a further quantity, which is what is drawn, is off by more than
/// twice the tolerance: by how much, where, why, and what helps.
std::vector<std::string> warnings_of(const Field& field, const Series& series, const EncodeOptions& options);

}  // namespace cleft
