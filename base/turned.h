// Values in other axes.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "base/vec3.h"

namespace cleft {

/// Right-handed unit vectors.
using AxesInSpace = std::array<Vec3, 3>;

inline constexpr AxesInSpace same_axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

/// Components along the axes.
inline Vec3 turned(const Vec3& vector, const AxesInSpace& axes) {
  return {dot(axes[0], vector), dot(axes[1], vector), dot(axes[2], vector)};
}

/// The axes of `to` as they are along those of `from`.
inline AxesInSpace axes_between(const AxesInSpace& from, const AxesInSpace& to) {
  return {turned(to[0], from), turned(to[1], from), turned(to[2], from)};
}

/// Values of a field along the axes, point by point: those of scalars are unchanged, vectors (3 components)
/// and symmetric tensors (6: XX YY ZZ XY YZ XZ) are turned.
inline void turn(std::span<double> values, int components, const AxesInSpace& axes) {
  if (components == 3) {
    for (std::size_t i = 0; i + 2 < values.size(); i += 3) {
      const Vec3 one = turned({values[i], values[i + 1], values[i + 2]}, axes);
      for (int c = 0; c < 3; ++c) values[i + static_cast<std::size_t>(c)] = one[c];
    }
  } else if (components == 6) {
    static constexpr int row[6] = {0, 1, 2, 0, 1, 0}, column[6] = {0, 1, 2, 1, 2, 2};
    for (std::size_t i = 0; i + 5 < values.size(); i += 6) {
      const double xx = values[i], yy = values[i + 1], zz = values[i + 2], xy = values[i + 3],
                   yz = values[i + 4], xz = values[i + 5];
      const Vec3 tensor[3] = {{xx, xy, xz}, {xy, yy, yz}, {xz, yz, zz}};
      for (int c = 0; c < 6; ++c) {
        const Vec3 &a = axes[row[c]], &b = axes[column[c]];
        values[i + static_cast<std::size_t>(c)] =
            dot(a, {dot(tensor[0], b), dot(tensor[1], b), dot(tensor[2], b)});
      }
    }
  }
}

}  // namespace cleft
