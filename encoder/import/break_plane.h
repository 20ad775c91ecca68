// The discontinuity: which plane it lies in, and which nodes it parts.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "encoder/import/jumps.h"
#include "encoder/import/plane.h"

namespace cleft {

struct Break {
  std::optional<Plane> plane;             ///< none: without a break
  std::vector<NodePair> pairs;            ///< the node before the plane (left), the one behind it
  std::vector<std::int32_t> first_frame;  ///< in which a pair is open; the number of frames where it never is
  std::vector<std::string> notes;         ///< what a user should know
};

/// `given`: a plane as text, "none", or nothing: then the plane of the coincident nodes that part in some
/// frame. Nodes of an unwelded series are made one first. `flat`: the normal of a mesh in a plane. Throws
/// InputError where coincident nodes lie in no common plane, or the plane given does not divide the mesh.
Break find_break(Series& series, const std::optional<std::string>& given, const std::optional<Vec3>& flat,
                 const std::function<void(std::size_t)>& progress);

}  // namespace cleft
