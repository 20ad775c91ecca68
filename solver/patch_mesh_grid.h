// The grid of a patch's mesh: its lines along u, v and w, the lines of the cuts, and the shift of its nodes
// onto a curved or tilted cut.
#pragma once

#include <vector>

#include "base/vec3.h"
#include "params/meshed_cut.h"
#include "params/parameters/parameters.h"

namespace cleft {

/// Indices count the lines. Nodes move in v only, by (shift_u[i] + shift_w[k]) * blend[j], so that the u and
/// w lines do not move.
struct PatchGrid {
  std::vector<double> u, v, w;      ///< the lines, mm; u and v increase, w decreases from the skin at 0
  std::vector<double> along;        ///< of the u lines of a cut, ends included: mm along it from its middle
  std::vector<double> angle;        ///< of the same lines: direction of the cut, radians from u toward v
  int cut_from = 0;                 ///< u line of the cuts' start
  std::vector<int> planes;          ///< v lines of the parallel cuts, from -v to +v
  int branch_u = -1, branch_v = 0;  ///< u line that a branch follows, and v line of its end
  int bottom = 0;                   ///< w line of the cuts' bottom
  Fronts fronts;
  Vec3 start;       ///< of the first cut, on the skin
  double tilt = 0;  ///< radians
  std::vector<double> shift_u, shift_w, blend;

  Vec3 point(int i, int j, int k) const { return {u[i], v[j] + (shift_u[i] + shift_w[k]) * blend[j], w[k]}; }

  /// Normal of the cut at its n-th u line (start: 0), unit, toward +v.
  Vec3 cut_normal(int n) const;
};

PatchGrid make_patch_grid(const Parameters& parameters);

/// The same with a line in the middle between each line and the next: those that were there have even
/// numbers.
PatchGrid halved(PatchGrid grid);

}  // namespace cleft
