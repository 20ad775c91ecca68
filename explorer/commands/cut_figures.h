// The figures that `cleft cut` reports, and in part `cleft haptic`.
#pragma once

#include <vector>

#include "base/command/command.h"
#include "encoder/field/field.h"
#include "explorer/incision/incision.h"
#include "explorer/incision/mesh_repair.h"
#include "explorer/incision/near_ends.h"
#include "explorer/wound/validity.h"

namespace cleft {

Json figures_of(const MeshReport& report);

/// Of all cuts together, at rest, before fields open them. `scale` is mm per mesh unit.
Json figures_of(const std::vector<const Incision*>& cuts, const SurfaceMesh& before, double scale);

/// Of one cut.
Json figures_of(const Incision& cut, double scale);
Json figures_of(const Validity& validity);

/// Of ends of paths that were led on to another cut, with lengths of `scale` mm; also told on stderr as notes
/// of `command`.
Json told_of(const std::vector<JoinedEnd>& ends, double scale, const char* command);

/// On stderr, as those of `command`.
void print_warnings(const Json& warnings, const char* command);
/// All warnings, also printed on stderr as those of `command`.
Json warnings_of(const std::vector<Validity>& validity, const char* command);

/// Warns on stderr where the mesh, at `scale` mm a unit, is not of the size of what the field was simulated
/// for (null: the default case). Throws InputError where its size is absurd.
void warn_of_size(const SurfaceMesh& mesh, double scale, const Field* field, const char* command);
/// What its reader has to say of the mesh, to standard error.
void tell_note(const SurfaceMesh& mesh, const std::string& file, const char* command);

}  // namespace cleft
