// What cleft encode tells of the fields that it has made.
#pragma once

#include <string>
#include <vector>

#include "base/command/command.h"
#include "encoder/field/field.h"

namespace cleft {

/// Of several pieces errors are the largest, and times those of all. `nodes`: of the whole body; `out`: the
/// file that was written.
Json figures_of(const std::vector<Field>& pieces, std::size_t nodes, const std::string& out);

}  // namespace cleft
