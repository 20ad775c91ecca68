// The expected error of a replayed opening against a simulation of the very body that is cut.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "explorer/wound/wound.h"

namespace cleft {

/// Along a path, over the largest opening of the cut.
struct OpeningError {
  std::vector<double> stations;  ///< mm along the path
  std::vector<double> values;
  double largest = 0, at = 0;  ///< of these, and where, mm
  std::string cause;           ///< of the largest one: its greatest part, a clause with its figure

  /// At mm of the path: linear between stations.
  double value_at(double s) const;
};

/// What the surroundings of a cut, and what is known of it as a whole, add to its error.
struct Neighbourhood {
  double nearest_cut = std::numeric_limits<double>::infinity();  ///< mm: beside it; infinite: there is none
  /// Where it meets another cut, but crosses none in a tension that turns: the ratio of the tension along
  /// that cut to the tension across it, above 0; 0 if it meets none.
  double junction_tension = 0;
  /// Likewise of a cut that it opens into; not in junction_tension in a tension that turns.
  double mouth_tension = 0;
  double length_defect = 0;  ///< excess of an endless cut's opening over the field's, relative to it
  double field =
      0;  ///< error that the field states of its opening, over that opening: of a fit or between cases
  bool between = false;  ///< whether the field was interpolated
  double turned = 0;     ///< radians: its direction against that of the first cut, which the tension has
  double held_back = 0;  ///< of its lips, by bends or the guard, over its largest opening
};

/// Sums the squares of what is known to make replays differ from simulations, each by a law whose factor is
/// that of the bodies in tests/truth/bodies.md, of cuts as long and as deep as the canonical one: bends, in a
/// tension that does or does not turn with the path; the blade's tilt and depth; the skin's curvatures;
/// longer paths; other cuts; what is held back; bone, where its distance is given and the field does not know
/// it. A family knows bends, tilts, depths and curvatures: there it is how far they are beyond the family,
/// and how far the path's direction is from that which opens it. Changes of the tissue along the path are not
/// known. `known`: whether the fields follow the tension, or it pulls alike in all directions.
OpeningError opening_error_of(const Wound& cut, bool known, const Neighbourhood& neighbourhood);

}  // namespace cleft
