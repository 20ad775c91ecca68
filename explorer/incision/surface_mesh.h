// A triangle mesh as read from a file, for cuts and pictures.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "base/vec3.h"

namespace cleft {

/// Red, green and blue, 0 to 1.
using PointColor = std::array<float, 3>;

/// As most files hold it: 0 to 255.
inline std::array<std::uint8_t, 3> byte_color(const PointColor& color) {
  const auto byte = [](float part) {
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(part, 0.F, 1.F)));
  };
  return {byte(color[0]), byte(color[1]), byte(color[2])};
}

/// Triangles are counter-clockwise seen from outside. Units are the mesh's own.
struct SurfaceMesh {
  std::vector<Vec3> points;
  std::vector<std::array<int, 3>> triangles;
  std::vector<PointColor> colors = {};  ///< of each point; empty: the mesh has none
  std::string note = {};                ///< what its reader has to say of the colours; empty: nothing
};

}  // namespace cleft
