// Where the surface of the body is.
#pragma once

#include <array>
#include <cstdint>

#include "encoder/import/source_mesh.h"

namespace cleft {

/// The mean normal of a shell at some of its nodes, up to its sign; none where the mesh has solid cells.
std::optional<Vec3> normal_of_shell(const SourceMesh& mesh, const std::vector<char>& at);

/// Unit normals, outward, of the faces of solid cells that no other cell has and that have one of the nodes.
std::vector<Vec3> outward_at(const SourceMesh& mesh, const std::vector<std::int32_t>& nodes);

/// The nodes of faces of the body that continue the lips of a break, as in a corner where it begins. Lips are
/// faces of which all nodes are divided or at the front. From face to face the surface turns by less than 30
/// degrees, and nowhere by more than 60 from `normal`. `pairs`: divided nodes; `at_front`: of each node.
/// (Of a plane mesh, edges are faces.)
std::vector<std::int32_t> nodes_continuing_lips(const SourceMesh& mesh,
                                                const std::vector<std::array<std::int32_t, 2>>& pairs,
                                                const std::vector<bool>& at_front, const Vec3& normal);

}  // namespace cleft
