// The texture of an .obj file, as colours of its points: vertices at the seams of a texture have several
// places in it, and cuts would tear triangles apart there, while colours of points survive every cut. Private
// to this folder.
#pragma once

#include <cmath>

#include "explorer/io/mesh_polygons.h"
#include "explorer/io/texture_colors.h"

namespace cleft {

/// Gives `mesh`, which the .obj at `path` holds, the colours of the image that its material maps (map_Kd in
/// the file of `mtllib`), each the mean of the image over half the way to the nearest neighbours. `places`:
/// of its points in the image. They are left out where they are further than `most_lost` (texture_colors.h)
/// from the image, on the mean over the triangles, where a corner has no place in it, and where no single
/// image can be read. Returns what is to be said of that; empty: no texture.
std::string add_texture_colors(const std::string& path, const std::vector<Uv>& places, MeshPolygons& mesh);

inline constexpr Uv no_place{NAN, NAN};  ///< of a corner whose face does not give it one

}  // namespace cleft
