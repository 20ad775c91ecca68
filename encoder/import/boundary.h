// Where given nodes touch the surface of the body.
#pragma once

#include "encoder/import/source_mesh.h"

namespace cleft {

/// Unit vectors out of the body, of every face of solid cells that belongs to one cell and has one of
/// `nodes`.
std::vector<Vec3> outward_at(const SourceMesh& mesh, const std::vector<std::int32_t>& nodes);

}  // namespace cleft
