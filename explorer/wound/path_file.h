// The path file of a cut.
#pragma once

#include <optional>
#include <string>

#include "base/text.h"
#include "explorer/incision/scalpel_path.h"
#include "explorer/wound/prestress_fields.h"

namespace cleft {

/// A path file in the mesh's units, with a depth: `depth`, mm, if that is above 0, else that of the file,
/// else `otherwise`, mm, if given. `scale` is mm per mesh unit. Throws FileError if there is none.
ScalpelPath read_path(const std::string& file, double depth, double scale, std::optional<double> otherwise);
/// The same of a table with the file's columns; `name` stands for it in messages.
ScalpelPath path_of(const NumberTable& table, const std::string& name, double depth, double scale,
                    std::optional<double> otherwise);

/// The file's columns skin.prestress_u, _v and _uv, MPa in the path's own frame, if it has any of them; a
/// missing one is 0. `path` is the result of read_path().
std::optional<PathPrestress> read_prestress(const std::string& file, const ScalpelPath& path, double scale);
std::optional<PathPrestress> prestress_of(const NumberTable& table, const ScalpelPath& path, double scale);

}  // namespace cleft
