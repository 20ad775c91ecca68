// Triangles of a wanted size on a surface, whose cuts remain edges.
#pragma once

#include <functional>
#include <vector>

#include "explorer/body/lined_surface.h"
#include "explorer/body/surface_index.h"

namespace cleft {

/// Splits long edges, collapses short ones, flips edges toward Delaunay's criterion and moves points toward
/// the middle of their triangles (Botsch and Kobbelt 2004), with lengths that vary (Dunyach et al. 2013).
/// Stations stay where they are; other points of cuts disappear into them; all others remain on `shape`.
/// `size`: the wanted length of edges at a place, mm.
LinedSurface remeshed(LinedSurface surface, const std::vector<bool>& stations, const SurfaceIndex& shape,
                      const std::function<double(const Vec3&)>& size);

}  // namespace cleft
