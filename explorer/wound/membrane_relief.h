// How far cuts relieve each other: in a membrane with all of them (cut_membrane.h) each opens by a part of
// what it opens alone. Of what the membrane would hand on from cut to cut the tissue hands on a little less,
// the less the further they are from each other. Pieces of cuts end where cuts touch each other, so that each
// part of a cut that is crossed opens for itself.
#pragma once

#include <vector>

#include "explorer/wound/mutual_relief.h"

namespace cleft {

/// result[i][k]: the opening of cut k over the opening across of the cut alone, along its path, with the
/// blade of the last cut at blades[i] mm of its path and the others complete: across, and as `shifts` what
/// the other cuts add along it. 1 for a single cut, and of fields that do not open. Throws InputError if a
/// field lacks the skin's prestress across the cut.
std::vector<std::vector<Amplitude>> membrane_relief(const std::vector<const Wound*>& cuts,
                                                    const std::vector<double>& blades);

}  // namespace cleft
