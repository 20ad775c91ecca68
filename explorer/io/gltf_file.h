// Meshes in glTF 2.0: .glb, and .gltf with what it names. Our own reader, since VTK's trusts the counts and
// indices of a file. Private to this folder.
#pragma once

#include "explorer/io/mesh_polygons.h"

namespace cleft {

/// In metres, by the specification: the triangles of all meshes of the file's scene, placed by its nodes, at
/// rest: animations, skeletons and morph targets move nothing. Points have the base colours of their
/// materials, times colours of vertices (COLOR_0) and textures (texture_colors.h), as they are shown (sRGB);
/// without any of them there are none. Throws FileError where the file is not whole and consistent.
MeshPolygons read_gltf(const std::string& path);

inline constexpr std::size_t most_gltf_corners = 30'000'000;  ///< of all triangles that nodes place

}  // namespace cleft
