// Whether a cut is like those that replays were compared with (tests/truth): inside, openings were within a
// tenth of the solver's; outside, nobody knows.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "explorer/wound/wound.h"

namespace cleft {

/// Lengths in mm.
struct Validity {
  double smallest_radius =
      0;  ///< of the path's bends, or half the way to another part of it; infinite: straight
  double largest_tilt = 0;   ///< degrees: of the blade against the skin's normal
  double length_defect = 0;  ///< how much wider than the field's an endless cut would be, over its opening
  double nearest_cut = 0;    ///< least distance from another cut's path; infinite: there is none
  /// Where it meets another cut: the tension along that one over the tension across it, at most; none: it
  /// meets none.
  std::optional<double> junction_tension;
  std::vector<std::string> warnings;
};

/// Of every cut. `turned`: whether their fields follow the tension.
std::vector<Validity> validity_of(const std::vector<const Wound*>& cuts, bool turned);

}  // namespace cleft
