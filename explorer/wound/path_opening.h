// How a path that winds opens, where a field knows a cut of one bend: the tension is changed at each place
// such that the field's own cut opens there as the path does in a membrane (cut_membrane.h). Nothing changes
// where the path is the field's own cut.
#pragma once

#include <functional>
#include <optional>

#include "explorer/wound/cut_membrane.h"
#include "explorer/wound/ipv.h"
#include "explorer/wound/prestress_fields.h"

namespace cleft {

/// The membrane in which a straight cut opens as the field's own does: in the middle, when half of it is cut
/// and when all is. Of the fields at s mm of a path. None of a field that does not open, or opens against the
/// tension.
std::optional<CutMembrane> membrane_of(const VaryingField& field, double s = 0);

/// The cut whose field opens a place of a path.
struct OwnCut {
  double curvature = 0;       ///< 1/mm, in the middle of it
  double curvature_rate = 0;  ///< 1/mm^2
  double ahead = 0;           ///< radians, from the path's direction to that of the field's u, toward its v

  /// Radians that it has turned at so many mm from its middle.
  double turned(double from_middle) const {
    return (curvature + curvature_rate * from_middle / 2) * from_middle;
  }
};

/// How far a field's cut opens in its middle when `t` mm of it are cut, mm. Of the fields at s mm of a path.
double middle_opening(const VaryingField& field, double t, double s = 0);

/// What is to be added to the prestress at places of a path, MPa, in the frame of the field's u there; none
/// along it, and none at all of a path that comes back to itself. `ease` tells how far a straight cut with
/// the depth, the tilt, the skin and the bone of a place opens, in any unit: where it changes, the path's
/// parts open each other.
PathPrestress tension_of_winding(const CutMembrane& membrane, const CanonicalCut& cut,
                                 const IncisionVolume& volume, double length, const PathPrestress& prestress,
                                 const std::function<OwnCut(double s)>& own,
                                 const std::function<double(double s)>& ease);

}  // namespace cleft
