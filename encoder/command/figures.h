// What cleft encode tells of the fields that it has made.
#pragma once

#include <string>
#include <vector>

#include "base/command/command.h"
#include "encoder/encode.h"

namespace cleft {

/// Of several pieces errors are the largest, and times those of all. `nodes`: of the whole body; `out`: the
/// file that was written.
Json figures_of(const std::vector<Field>& pieces, std::size_t nodes, const std::string& out);

/// A warning where the spline, which is what is drawn, is off by more than twice the tolerance; else empty.
std::string warning_of(const Field& field, const Series& series, const EncodeOptions& options);

}  // namespace cleft
