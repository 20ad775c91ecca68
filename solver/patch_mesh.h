// The box of tissue with its pre-meshed cut: wedges, skin triangles, boundary faces and duplicated nodes.
// Paper, section 3.1.
#pragma once

#include <array>
#include <vector>

#include "base/vec3.h"
#include "params/parameters.h"

namespace cleft {

/// Node numbers index `points`. The mesh depends on the parameters alone, not on the number of ranks.
struct PatchMesh {
  std::vector<Vec3> points;                ///< (u, v, w), stress-free, mm
  std::vector<std::array<int, 6>> wedges;  ///< lower triangle, then upper, both counter-clockwise from above
  std::vector<std::array<int, 3>> skin;    ///< top faces, counter-clockwise from above
  std::vector<std::array<int, 3>> bottom;  ///< bottom faces
  std::vector<std::array<int, 4>> sides;   ///< side faces, cyclic
  std::vector<std::array<int, 2>> pairs;   ///< left and right node of each duplicated node, in release order
  std::vector<int> released;               ///< pairs open in each frame; released[0] = 0
  std::vector<double> position;            ///< u of the tip in each frame
  double cut_start = 0;                    ///< u where the cut begins
};

/// Elements are no longer than mesh.element_size along any axis, and the cut's ends, its bottom and the plane
/// v = 0 coincide with element faces. The triangles' diagonals are mirrored in v = 0.
PatchMesh make_patch_mesh(const Parameters& parameters);

}  // namespace cleft
