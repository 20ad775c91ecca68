// Cuts side by side relieve each other: each opens in the tension that the others leave. So the field of each
// is scaled along its path by A(s), the tension across it there over what it would be without the others:
//   A_i(s) = 1 + sum over j of A_j r_ij(s),   r_ij = (change of tension across path i that cut j alone makes)
//   / (tension)
// a fixed point in the amplitudes of all, which are at the same time both cause and effect (Kachanov 1987,
// elastic solids with many cracks; his are constants, these follow the path). The change of tension in the
// skin is its plane stress in the strain of the other cut's field.
#pragma once

#include <vector>

#include "explorer/wound/ipv.h"
#include "explorer/wound/varying_field.h"

namespace cleft {

/// What a cut needs to be told of the others. All must outlive its use.
struct CutInTension {
  const Incision* incision;
  const VaryingField* field;
  const IncisionVolume* volume;  ///< of both
};

/// Amplitude along a path, linear between stations, in mm of it; constant beyond them.
struct Amplitude {
  std::vector<double> stations, values;
  double at(double s) const;
};

/// Of every cut, with the blade of the last one at `blade` mm of its path and the others complete. All 1 for
/// a single cut. Throws InputError where a field does not tell the skin's prestress and stiffness.
std::vector<Amplitude> mutual_relief(const std::vector<CutInTension>& cuts, double blade);

}  // namespace cleft
