// Fields made up for tests: a wound that opens where it is cut and pulls its surroundings along.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "encoder/field/field.h"
#include "tests/support/recorded.h"

namespace cleft::testing {

/// What is known of skin on tissue on springs.
inline std::map<std::string, double> skin_on_springs() {
  return {{"tissue.young_modulus", 0.02},  {"tissue.poisson_ratio", 0.4}, {"patch.height", 8},
          {"foundation.stiffness", 0.005}, {"skin.young_modulus", 0.13},  {"skin.poisson_ratio", 0.4},
          {"skin.thickness", 1.5}};
}

/// Control points stand at Greville abscissae with the values of
///   d = (0.1 g, side g, 0.2 g),   g = gape * half ellipse over [start, start + t] * decay(v) * (1 + w /
///   depth)
/// so that the spline follows them roughly; tests only need a field that is smooth, opens, and is known
/// exactly. `held`, 0 to 1: the opening grows with the length of the cut to the power of 1 - held, as springs
/// below hold back long cuts.
inline Field opening_field(const CanonicalCut& cut, const BSplineBasis& u, double width, double height,
                           double gape, double held = 0) {
  const BSplineBasis v = BSplineBasis::broken(3, 16, -width / 2, 0, width / 2);
  const BSplineBasis w = BSplineBasis::uniform(3, 8, -height, 0),
                     t = BSplineBasis::uniform(3, 12, 0, cut.length);
  const auto greville = [](const BSplineBasis& b, int i) {
    double sum = 0;
    for (int k = 1; k <= b.degree(); ++k) sum += b.knots()[i + k];
    return sum / b.degree();
  };
  std::vector<Vec3> c;
  for (int i = 0; i < u.size(); ++i)
    for (int j = 0; j < v.size(); ++j)
      for (int k = 0; k < w.size(); ++k)
        for (int l = 0; l < t.size(); ++l) {
          const double time = greville(t, l), x = greville(u, i) - cut.start, y = greville(v, j);
          const double inside = std::max(0.0, x * (time - x));
          const double side = j < v.size() / 2 ? -1 : 1;
          const double depth = std::max(0.0, 1 + greville(w, k) / cut.depth);
          const double held_back = time > 0 ? std::pow(time / cut.length, held) : 1;
          const double g =
              gape * std::sqrt(inside) / cut.length / held_back * std::exp(-3 * std::abs(y) / width) * depth;
          c.push_back({0.1 * g, side * g, 0.2 * g});
        }
  return {u, v, w, t, std::move(c), cut};
}

inline Field opening_field(const CanonicalCut& cut, double length, double width, double height, double gape,
                           double held = 0) {
  return opening_field(cut,
                       BSplineBasis::uniform(3, 32, cut.start - (length - cut.length) / 2,
                                             cut.start + (length + cut.length) / 2),
                       width, height, gape, held);
}

/// The field of a skin with such prestresses, MPa.
inline Field in_tension(Field field, std::map<std::string, double> prestress) {
  prestress.insert({{"skin.thickness", 1.5},
                    {"skin.young_modulus", 0.2},
                    {"skin.poisson_ratio", 0.4},
                    {"tissue.young_modulus", 0.02},
                    {"tissue.poisson_ratio", 0.4}});
  field.parameters = recorded(prestress);
  return field;
}

}  // namespace cleft::testing
