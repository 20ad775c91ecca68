// The discontinuity: its plane, and the pairs of nodes that it separates.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "encoder/import/jumps.h"
#include "encoder/import/plane.h"

namespace cleft {

struct Break {
  std::optional<Plane> plane;             ///< none if there is no break; of a curved one the best
  bool curved = false;                    ///< whether the pairs lie in no common plane
  std::vector<NodePair> pairs;            ///< the node before the plane (left), the one behind it
  std::vector<std::int32_t> first_frame;  ///< in which a pair is open; the number of frames if it never is
  std::vector<std::string> notes;         ///< messages for the user
};

/// `given`: a plane as text, "none", or no value: then the plane of the coincident nodes whose values differ
/// in some frame, or the surface through them. Nodes of an unwelded series are merged first. `flat`: the
/// normal of a plane mesh. Throws InputError if the coincident nodes are in no surface over their best plane,
/// or the given plane does not divide the mesh.
Break find_break(Series& series, const std::optional<std::string>& given,
                 const std::optional<OpenAt>& open_at, const std::optional<Vec3>& flat,
                 const std::function<void(std::size_t)>& progress);

}  // namespace cleft
