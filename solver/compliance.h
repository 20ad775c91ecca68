// The compliance of the skin: how far the closed patch sinks under unit pressure.
#pragma once

#include <span>
#include <vector>

#include "solver/frame_solver.h"

namespace cleft {

inline constexpr double pressed_radius = 2;  ///< mm, of the disc that is pressed

/// Loads of unit pressure (1 MPa, into the skin) on a disc around each centre (u, v), one in each column, N.
/// Only the part of a disc on the patch is loaded. Quadrature points are a third of an element apart.
Block disc_loads(const PatchMesh& mesh, const PatchSystem& system, std::span<const Vec3> centers);

/// Whether the mesh has one: a box, whose quarters are alike, but for a tilted cut. Bodies and shaped patches
/// would have to be pressed at every node.
inline bool has_compliance(const PatchMesh& mesh) { return !mesh.is_body() && !mesh.is_shaped(); }

struct Compliance {
  std::vector<double> at_node;  ///< mm/MPa: of the skin above each node, positive into the skin
  Block dent;  ///< mm/MPa: displacement under unit pressure on the disc around the cut's start
};

/// The compliance of the closed frame. The closed patch is a homogeneous box, so at most 48 nodes of one
/// quarter are loaded, denser toward the edges, and the results are interpolated monotonically. The
/// difference between nodes of four and of eight triangles is averaged. With elements of 1 mm the error is
/// within 2 % except at the edges. Sets the solver's loads. Collective.
Compliance compliance_of(const PatchMesh& mesh, const PatchSystem& system, FrameSolver& solver);

}  // namespace cleft
