// A field with random control points, the same at every call.
#pragma once

#include <random>

#include "encoder/field/field.h"

namespace cleft {

inline Field random_field() {
  const BSplineBasis u = BSplineBasis::uniform(3, 7, -30, 30), v = BSplineBasis::broken(3, 10, -20, 0, 20),
                     w = BSplineBasis::uniform(3, 5, -8, 0), t = BSplineBasis::uniform(3, 6, 0, 24);
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(-1, 1);  // floats: what a file stores
  std::vector<Vec3> coefficients(7 * 10 * 5 * 6);
  for (Vec3& c : coefficients) c = {uniform(random), uniform(random), uniform(random)};
  Field field(u, v, w, t, coefficients, {-12, 24, 3});
  field.parameters = {{"tissue.young_modulus", 0.02}, {"skin.thickness", 1.5}};
  field.case_hash = "0123456789abcdef";
  field.report.node_error = 0.0625;
  return field;
}

}  // namespace cleft
