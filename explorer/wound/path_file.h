// The path of a cut as commands are given it.
#pragma once

#include <optional>
#include <string>

#include "encoder/field/field.h"
#include "explorer/incision/scalpel_path.h"
#include "explorer/wound/prestress_fields.h"

namespace cleft {

/// A path file in the mesh's units, with a depth: `depth` mm where that is above 0, else the file's own, else
/// that of `field`, if given. `scale` is mm per mesh unit. Throws FileError where none of them knows one.
ScalpelPath read_path(const std::string& file, double depth, double scale, const Field* field);

/// The file's columns skin.prestress_u, _v and _uv, MPa in the path's own frame, where it has any of them; a
/// missing one is 0. `path` is what read_path made of the file.
std::optional<PathPrestress> read_prestress(const std::string& file, const ScalpelPath& path, double scale);

}  // namespace cleft
