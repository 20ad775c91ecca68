// What to tell of a body that was made.
#pragma once

#include <string>
#include <vector>

#include "explorer/body/body_maker.h"
#include "explorer/guard/guard.h"
#include "explorer/incision/cut_mesh.h"
#include "solver/body/skin_turn.h"

namespace cleft {

/// A sentence for each place where the body is not as the skin and the paths are, or is badly meshed.
std::vector<std::string> warnings_of(const BodyReport& report);

/// That in small strains skin would turn so far, and is simulated with this skin.turning_stiffness.
std::string warning_of_turn(const Turn& most, double share);

/// That the guard of a simulation holds vertices back by more than a fiftieth of its opening, mm; else empty.
std::string warning_of_guard(const CutMesh& mesh, const Guard& guard, double gape, double scale);

/// Of turned_triangles(); empty if there are none. `scale`: mm per mesh unit.
std::string warning_of_turned(const CutMesh& mesh, const std::vector<int>& turned, double scale);

}  // namespace cleft
