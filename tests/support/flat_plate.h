// A flat skin to cut.
#pragma once

#include "explorer/incision/surface_mesh.h"

namespace cleft {

/// 60 x 40 mm, in cells of 2 mm.
inline SurfaceMesh flat_plate() {
  SurfaceMesh plate;
  const int nx = 31, ny = 21;
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) plate.points.push_back({2. * i - 30, 2. * j - 20, 0});
  for (int j = 0; j + 1 < ny; ++j)
    for (int i = 0; i + 1 < nx; ++i) {
      const int a = j * nx + i, b = a + 1, c = b + nx, d = a + nx;
      plate.triangles.push_back({a, b, c});
      plate.triangles.push_back({a, c, d});
    }
  return plate;
}

}  // namespace cleft
