// Coordinates of a cut on the skin before it is cut, and directions within it.
#pragma once

#include <array>
#include <set>
#include <vector>

#include "explorer/incision/scalpel_path.h"
#include "explorer/incision/surface_mesh.h"
#include "explorer/incision/tension_lines.h"

namespace cleft {

/// By point of the skin.
struct SkinCoordinates {
  std::vector<Vec3> canonical;  ///< u along the path from its middle, v across it over the skin, mm; 0
  std::vector<std::array<Vec3, 3>> frames;  ///< unit vectors of u, v, w in space
};

/// As replays have them: of the surroundings of the path, u by its steady place, which does not jump inside
/// bends. `on_cut`: the points along it, where v = 0.
SkinCoordinates coordinates_on(const SurfaceMesh& skin, const ScalpelPath& path, const std::set<int>& on_cut);

/// The mean of the lines in each triangle of the skin, unit; none: from the path's start to its end. Throws
/// InputError where they stand upright on a triangle that has one of the points of cuts, or cancel there.
std::vector<Vec3> directions_within(const SurfaceMesh& skin, const ScalpelPath& path,
                                    std::vector<TensionLine> lines, const std::vector<bool>& on_a_cut);

/// The path between two of its arc lengths, or beyond its ends, where it goes on straight; its points are at
/// most an eighth of `size` apart. Depths beyond the ends are those of the ends.
ScalpelPath stretched(const ScalpelPath& path, double from, double to, double size);

/// "(1, 2.5, 3)"
std::string place_text(const Vec3& position);

}  // namespace cleft
