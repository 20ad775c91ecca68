// How far the skin gives way under a pressing finger or blade: the closed patch under unit pressure.
#pragma once

#include <span>
#include <vector>

#include "solver/frame_solver.h"

namespace cleft {

inline constexpr double pressed_radius = 2;  ///< mm, of the disc that is pressed

/// Loads of unit pressure (1 MPa, into the skin) on a disc about each centre (u, v), a column each, N. Only
/// the part of a disc that lies on the patch is pressed. By quadrature, points a third of an element apart.
Block disc_loads(const PatchMesh& mesh, const PatchSystem& system, std::span<const Vec3> centers);

struct Compliance {
  std::vector<double> at_node;  ///< mm/MPa: of the skin above every node, into the skin
  Block dent;  ///< mm/MPa: displacement under unit pressure on the disc about the cut's start
};

/// Of the closed frame. The closed patch is a homogeneous box, so nodes of one quarter of it are pressed,
/// closer toward its edges (at most 48), and what they give way is interpolated monotonically. It is smooth:
/// that nodes of four triangles give way less than those of eight is averaged out. Where h = 1 mm, within 2 %
/// of the solves but on the edges. Sets the solver's loads. Collective.
Compliance compliance_of(const PatchMesh& mesh, const PatchSystem& system, FrameSolver& solver);

}  // namespace cleft
