// The rigid map from the source's space into (u, v, w).
#pragma once

#include <string>
#include <vector>

#include "base/turned.h"
#include "encoder/import/break_plane.h"

namespace cleft {

struct Placement {
  Vec3 origin;                   ///< of (u, v, w), in the source's space
  AxesInSpace axes = same_axes;  ///< unit vectors of u, v, w in that space, right-handed

  Vec3 placed(const Vec3& point) const { return turned(point - origin, axes); }
};

/// The normal of the plane of a plane mesh.
std::optional<Vec3> flatness(const SourceMesh& mesh);

/// v = 0 is the break's plane, u is along one side of the smallest rectangle around its doubled nodes, from
/// their middle: along that in which the front moves, by the frames in which pairs open (`frames`: never),
/// else along the longer one; in the direction in which they open. w is toward the surface of the body that
/// they reach, with w = 0 at the highest of them, or at the top of the body. Exchanges left and right of the
/// pairs if this reverses the plane.
Placement placement_on(Break& found, const SourceMesh& mesh, std::int32_t frames,
                       const std::optional<Vec3>& flat);

/// The box of the mesh of a series without a break.
enum class Box { smaller, aligned, principal };

/// Along the axes of the space, or along the principal axes of the nodes if that box is at least a fifth
/// smaller. u = 0 and v = 0 in its middle, w = 0 at its top.
Placement placement_in_box(const SourceMesh& mesh, Box box, const std::optional<Vec3>& flat);

}  // namespace cleft
