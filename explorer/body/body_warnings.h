// What to tell of a body that was made.
#pragma once

#include <string>
#include <vector>

#include "explorer/body/body_maker.h"
#include "explorer/incision/cut_mesh.h"

namespace cleft {

/// A sentence for each place where the body is not as the skin and the paths are, or is badly meshed.
std::vector<std::string> warnings_of(const BodyReport& report);

/// Of turned_triangles(); empty if there are none. `scale`: mm per mesh unit.
std::string warning_of_turned(const CutMesh& mesh, const std::vector<int>& turned, double scale);

}  // namespace cleft
