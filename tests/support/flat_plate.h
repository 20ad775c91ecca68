// A flat skin to cut.
#pragma once

#include "explorer/incision/surface_mesh.h"

namespace cleft {

/// In cells of 2 mm, so many points along x and y; about the origin.
inline SurfaceMesh flat_plate(int nx = 31, int ny = 21) {
  SurfaceMesh plate;
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) plate.points.push_back({2. * i - (nx - 1), 2. * j - (ny - 1), 0});
  for (int j = 0; j + 1 < ny; ++j)
    for (int i = 0; i + 1 < nx; ++i) {
      const int a = j * nx + i, b = a + 1, c = b + nx, d = a + nx;
      plate.triangles.push_back({a, b, c});
      plate.triangles.push_back({a, c, d});
    }
  return plate;
}

}  // namespace cleft
