// How far cuts that do not meet relieve each other: in a membrane with all of them (cut_membrane.h) each
// opens by a part of what it opens alone. Cuts that meet, or nearly do, do not feel each other here: the
// membrane, which knows no depth, would open them too abruptly next to each other (mutual_relief.h).
#pragma once

#include <vector>

#include "explorer/wound/mutual_relief.h"

namespace cleft {

/// Whether two cuts meet, or nearly do: they are nearer to each other than about as they are deep.
bool meet(const Wound& a, const Wound& b);

/// By the numbers of two cuts: whether they meet.
using Meetings = std::vector<std::vector<bool>>;
Meetings meetings(const std::vector<const Wound*>& cuts);

/// result[i][k]: the opening of cut k over the opening across of the cut alone, along its path, with the
/// blade of the last cut at blades[i] mm of its path and the others complete: across, and as `shifts` what
/// the other cuts add along it. Without values of cuts that feel no other; empty of fields that do not open.
/// Throws InputError if a field lacks the skin's prestress across the cut.
std::vector<std::vector<Amplitude>> membrane_relief(const std::vector<const Wound*>& cuts,
                                                    const Meetings& meets, const std::vector<double>& blades);

}  // namespace cleft
