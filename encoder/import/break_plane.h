// The discontinuity: its plane, and the pairs of nodes that it separates.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "encoder/import/jumps.h"
#include "encoder/import/plane.h"

namespace cleft {

/// Where a node is on an arm of a break.
enum class InArm : char { no, between_junctions, at_junction };

struct Break {
  std::optional<Plane> plane;             ///< none if there is no break; of a curved one the best
  bool curved = false;                    ///< whether the pairs lie in no common plane
  std::vector<NodePair> pairs;            ///< the node before the plane (left), the one behind it
  std::vector<std::int32_t> first_frame;  ///< in which a pair is open; the number of frames if it never is
  std::function<double(const Vec3&)> distance = {};  ///< of a point from the break; right is positive
  std::map<NodePair, std::int32_t> parting = {};  ///< first_frame of all coincident nodes, lower node first
  std::vector<Vec3> junctions = {};               ///< of an arm of a break: where further arms begin
  std::vector<InArm> in_arm = {};                 ///< of each node of the mesh, where there are junctions
};

/// The breaks of a series, and messages for the user. Without any there is one without a plane.
struct Breaks {
  std::vector<Break> list;
  std::vector<std::string> notes;
};

/// `given`: a plane as text, "none", or no value: then the plane of the coincident nodes whose values differ
/// in some frame, or the surface through them. Nodes of an unwelded series are merged first. `flat`: the
/// normal of a plane mesh. Breaks that do not touch, and arms of those that branch, are found one by one.
/// Throws InputError if the coincident nodes of one are in no surface over their best plane, or the given
/// plane does not divide the mesh.
Breaks find_breaks(ImportedSeries& series, const std::optional<std::string>& given,
                   const std::optional<OpenAt>& open_at, const std::optional<Vec3>& flat,
                   const std::function<void(std::size_t)>& progress);

/// Finds the pairs of a break again, of those nodes alone for which `kept` is set, by the cells that have no
/// others.
void pair_among(Break& found, const SourceMesh& mesh, const std::vector<char>& kept);

}  // namespace cleft
