// Voxels about a point, nearest first: for contact_query.cpp and surface_proxy.cpp alone.
#pragma once

#include <limits>

#include "haptic/contact_query.h"

namespace cleft {

/// Voxels about x in shells of growing distance. `visit` takes a list and returns the distance beyond which
/// nothing more is wanted.
template <class Visit>
void ContactReader::visit_voxels(const Vec3& x, double radius, const Visit& visit) const {
  const double cell = cells_.cell();
  int middle[3], low[3], high[3], farthest = 0;
  double inside = std::numeric_limits<double>::infinity();  // from x to the nearest wall of its voxel
  for (int k = 0; k < 3; ++k) {
    middle[k] = cells_.index(x[k], k);
    low[k] = cells_.index(x[k] - radius, k), high[k] = cells_.index(x[k] + radius, k);
    farthest = std::max({farthest, middle[k] - low[k], high[k] - middle[k]});
    const double from_low = x[k] - cells_.low()[k] - cell * middle[k];
    inside = std::min(inside, std::max(0.0, std::min(from_low, cell - from_low)));
  }
  double wanted = radius;
  for (int shell = 0; shell <= farthest && (shell == 0 || inside + cell * (shell - 1) <= wanted); ++shell) {
    const auto clip = [&](int k, int sign) {
      return sign < 0 ? std::max(low[k], middle[k] - shell) : std::min(high[k], middle[k] + shell);
    };
    for (int i = clip(0, -1); i <= clip(0, 1); ++i)
      for (int j = clip(1, -1); j <= clip(1, 1); ++j) {
        const bool rim = std::abs(i - middle[0]) == shell || std::abs(j - middle[1]) == shell;
        for (int k = clip(2, -1); k <= clip(2, 1); ++k) {
          if (!rim && std::abs(k - middle[2]) != shell) {
            k = std::max(k, middle[2] + shell - 1);  // through to the shell's other side
            continue;
          }
          if (const CellList* list = cells_.at(i, j, k)) wanted = std::min(wanted, visit(*list));
        }
      }
  }
}

}  // namespace cleft
