// Breaks that grow at both of their ends, as two arms.
#pragma once

#include <vector>

#include "encoder/import/break_components.h"

namespace cleft {

/// The breaks, of which those that open in their middle first, and from there toward two opposite ends, are
/// two arms that share the groups in the middle: the field of a break has one front. Not those with
/// junctions, nor such whose front is round.
std::vector<BreakComponent> split_at_middle(const SourceMesh& mesh, const Groups& groups,
                                            const Partings& partings, std::vector<BreakComponent> breaks);

}  // namespace cleft
