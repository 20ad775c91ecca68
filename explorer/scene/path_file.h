// The path of a cut as commands are given it.
#pragma once

#include <optional>
#include <string>

#include "encoder/field/field.h"
#include "explorer/incision/scalpel_path.h"

namespace cleft {

/// A path file in the mesh's units, with a depth: `depth` mm where that is above 0, else the file's own, else
/// the field's. `scale` is mm per mesh unit. Throws FileError where none of them knows one.
ScalpelPath read_path(const std::string& file, double depth, double scale, const std::optional<Field>& field);

}  // namespace cleft
