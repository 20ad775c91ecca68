// Where cuts touch each other.
#pragma once

#include <vector>

#include "explorer/wound/wound.h"

namespace cleft {

/// mm: in stretches so long, as 30 of them are as long as the canonical cut, amplitudes of cuts that relieve
/// each other are told. With shorter ones corners of a crossing part so steeply that the guard holds cuts
/// back.
double canonical_stretch(const Wound& wound);
/// mm: cuts that are nearer to each other touch.
double touching_within(const Wound& wound);

/// Places of a cut where it touches another one, mm along its path.
std::vector<double> touched_at(const Wound& cut, const Wound& other);

}  // namespace cleft
