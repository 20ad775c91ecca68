// Symmetric tensors in the plane of the skin, (uu, vv, uv): prestresses and curvatures.
#pragma once

#include <array>
#include <cmath>

namespace cleft {

/// The tensor whose axes are turned back by an angle, radians: a direction at phi is then at phi + angle.
inline std::array<double, 3> turned(const std::array<double, 3>& tensor, double angle) {
  const double mean = (tensor[0] + tensor[1]) / 2, half = (tensor[0] - tensor[1]) / 2;
  const double c = std::cos(2 * angle), s = std::sin(2 * angle);
  return {mean + half * c - tensor[2] * s, mean - half * c + tensor[2] * s, half * s + tensor[2] * c};
}

}  // namespace cleft
