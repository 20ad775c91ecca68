// Cases of random tissue, skin and cut.
#pragma once

#include <cmath>
#include <random>

#include "params/parameters/parameters.h"

namespace cleft {

/// With all settings of mesh and patch at their defaults.
inline Parameters drawn_case(std::mt19937& random) {
  const auto between = [&](double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(random);
  };
  Parameters p;
  p.tissue.young_modulus = 0.005 * std::pow(16, between(0, 1));
  p.skin.young_modulus = 0.06 * std::pow(6, between(0, 1));
  p.skin.prestress.vv = between(0.02, 0.05), p.skin.prestress.uu = between(0.005, 0.02);
  p.skin.thickness = between(1, 2.5);
  p.cut.length = std::round(between(15, 50)), p.cut.depth = between(2, 5);
  p.foundation.stiffness = p.foundation.side_stiffness = 0.002 * std::pow(10, between(0, 1));
  return p;
}

}  // namespace cleft
