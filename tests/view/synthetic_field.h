// A field whose opening is known, for tests of what is drawn from it.
#pragma once

#include <algorithm>
#include <cmath>

#include "encoder/field/field.h"

namespace cleft {

/// A cut from u = -15 to 15, 6 mm deep, in a patch of 60 x 40 x 12 mm. At the length cut t the lips between
/// start and tip have drawn apart by about `gape` at most; the bottom stays closed.
inline Field synthetic_field(double gape = 5) {
  const CanonicalCut cut{-15, 30, 6};
  const auto u = BSplineBasis::uniform(3, 40, -30, 30), w = BSplineBasis::uniform(3, 12, -12, 0),
             t = BSplineBasis::uniform(3, 16, 0, cut.length);
  const auto v = BSplineBasis::broken(3, 24, -20, 0, 20);
  // Schoenberg's approximation: the function's values at the Greville abscissae as control points.
  const auto greville = [](const BSplineBasis& b, int i) {
    return (b.knots()[i + 1] + b.knots()[i + 2] + b.knots()[i + 3]) / 3;
  };
  std::vector<Vec3> coefficients;
  for (int i = 0; i < u.size(); ++i)
    for (int j = 0; j < v.size(); ++j)
      for (int k = 0; k < w.size(); ++k)
        for (int l = 0; l < t.size(); ++l) {
          const double x = greville(u, i), y = greville(v, j), z = greville(w, k), tip = greville(t, l);
          const double s = tip > 0 ? (x - cut.start) / tip : -1;  // 0 at the start, 1 at the tip
          const double along = s > 0 && s < 1 ? 2 * std::sqrt(s * (1 - s)) * std::min(tip / 10, 1.) : 0;
          const double down = std::max(1 + z / cut.depth, 0.);
          const double side = 2 * j < v.size() ? -1 : 1;
          coefficients.push_back({0, side * gape / 2 * along * down * std::exp(-std::abs(y) / 7), 0});
        }
  return {u, v, w, t, coefficients, cut};
}

}  // namespace cleft
