// Several breaks in one mesh: those that do not touch, and the arms of those that branch.
#pragma once

#include <vector>

#include "encoder/import/coincident.h"
#include "encoder/import/jumps.h"

namespace cleft {

/// One break, or an arm of one between places where three and more parts of the body meet.
struct BreakComponent {
  std::vector<std::size_t> groups;     ///< numbers of the groups of coincident nodes on it, ascending
  std::vector<std::size_t> junctions;  ///< of these, those that other arms share
};

/// By cells on both sides of a break alone: two groups are on one break if a cell on either side has nodes of
/// both. Groups that part in no frame connect breaks between which they are alone. Breaks of fewer than three
/// groups belong to the nearest other one. `partings` are of all pairs within the groups; those with a first
/// frame of `frames` never part.
std::vector<BreakComponent> break_components(const SourceMesh& mesh, const Groups& groups,
                                             const Partings& partings, std::int32_t frames);

}  // namespace cleft
