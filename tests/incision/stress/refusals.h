// Whether a path that was refused asked for what no blade can do: found by brute force over the uncut mesh.
#pragma once

#include <string>

#include "explorer/incision/incision.h"
#include "tests/incision/stress/surface_walker.h"

namespace cleft::stress {

constexpr const char* lies_along = "the blade lies along the surface";

/// Why a path cannot be cut beyond `place`, which it reached at arc length s: the mesh is no manifold there,
/// the blade does not point out of a triangle there, it is nowhere near the mesh, or it runs along a wound of
/// `cut`. Nothing where it can.
std::string reason_to_refuse(const Ground& ground, const ScalpelPath& path, const Vec3& place, double s,
                             const CutMesh& cut);

/// The same of a path that never began: whether the blade's line at its start meets the surface from outside
/// within half its length.
std::string reason_never_to_begin(const Ground& ground, const ScalpelPath& path, const CutMesh& cut);

}  // namespace cleft::stress
