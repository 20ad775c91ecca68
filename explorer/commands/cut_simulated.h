// The cuts of cleft cut as a simulation of this very body opens them, next to the replay if there is one.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "explorer/commands/body_options.h"
#include "explorer/wound/cut_fields.h"
#include "explorer/wound/mesh_cuts.h"

namespace cleft {

/// Without skin, paths and bone. The parameters are those of the options, else of the fields, else the
/// defaults. Throws InputError if the options give two tensions.
BodyRequest body_to_simulate(const BodyOptions& options, const std::optional<SkinTension>& tension,
                             const std::optional<CutFields>& fields, double scale);

/// The fields in the tension of the simulation, if they turn with it. Throws InputError if the paths have
/// tensions of their own, or the tension is none that fields take.
CutFields in_tension_of(const BodyRequest& request, const CutFields& fields,
                        const std::vector<std::string>& paths, const MeshCuts& cuts);

/// Moves the mesh as a simulation says, and returns its figures; with fields, `positions` are those of the
/// replay, and the figures tell how far it is off. Prints warnings.
Json move_as_simulated(BodyRequest request, const MeshCuts& cuts, const std::optional<CutFields>& fields,
                       std::vector<Vec3>& positions);

}  // namespace cleft
