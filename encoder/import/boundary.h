// The boundary faces of the body at given nodes.
#pragma once

#include "encoder/import/source_mesh.h"

namespace cleft {

/// Outward unit normals of all faces of solid cells that belong to one cell and have one of `nodes`.
std::vector<Vec3> outward_at(const SourceMesh& mesh, const std::vector<std::int32_t>& nodes);

}  // namespace cleft
