// The shape of a wedge: a lower triangle of nodes, and an upper one in the same order.
#pragma once

#include <array>

#include "base/vec3.h"

namespace cleft {

/// The determinant of a wedge's map from the unit wedge at each corner; all are positive where it is neither
/// flat nor turned over. point(i) is the place of corner i.
template <class Point>
std::array<double, 6> corner_determinants(const Point& point) {
  std::array<double, 6> determinants{};
  for (int i = 0; i < 6; ++i) {
    const int layer = 3 * (i / 3);
    const Vec3 here = point(i);
    determinants[i] = dot(cross(point(layer + (i + 1) % 3) - here, point(layer + (i + 2) % 3) - here),
                          point(3 + i % 3) - point(i % 3));
  }
  return determinants;
}

}  // namespace cleft
