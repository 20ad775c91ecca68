// How far cuts that do not meet relieve each other: in a membrane with all of them (cut_membrane.h) each
// opens by a part of what it opens alone. Cuts that meet, or nearly do, feel each other here only where they
// cross at a slant in flat skin: the membrane, which knows no depth, would open others too abruptly next to
// each other (mutual_relief.h), but only it knows that pieces of skin between slanting cuts draw back.
#pragma once

#include <vector>

#include "explorer/wound/mutual_relief.h"

namespace cleft {

/// How two cuts feel each other.
enum class Meeting {
  apart,       ///< in the membrane
  at_a_slant,  ///< they cross in flat skin, neither at a right angle nor nearly along each other, and their
               ///< fields turn with the tension: likewise
  close,       ///< they meet otherwise, or are nearer to each other than about as they are deep: by strains
};
Meeting meeting(const Wound& a, const Wound& b);

/// By the numbers of two cuts.
using Meetings = std::vector<std::vector<Meeting>>;
Meetings meetings(const std::vector<const Wound*>& cuts);

/// result[i][k]: the opening of cut k over the opening across of the cut alone, along its path, with the
/// blade of the last cut at blades[i] mm of its path and the others complete: across, and as `shifts` what
/// the other cuts add along it. Without values of cuts that feel no other; empty of fields that do not open.
/// Throws InputError if a field lacks the skin's prestress across the cut.
std::vector<std::vector<Amplitude>> membrane_relief(const std::vector<const Wound*>& cuts,
                                                    const Meetings& meets, const std::vector<double>& blades);

}  // namespace cleft
