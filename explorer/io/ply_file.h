// Polygons of a .ply file (Stanford's triangle format: text, or binary of either byte order). Our own reader,
// since VTK's trusts the counts and indices of a file, and crashes where they are wrong.
#pragma once

#include "explorer/io/mesh_polygons.h"

namespace cleft {

/// Reads the elements 'vertex' (x, y, z and, where there are all three, red, green and blue, or
/// diffuse_red ...) and 'face' (a list vertex_indices or vertex_index); all else is skipped, an alpha too.
/// Colours are naturals of a byte or two, up to the largest of their type, or reals from 0 to 1. Throws
/// FileError, naming the line of the header or the number of the element, where the file is not whole and
/// consistent.
MeshPolygons read_ply(const std::string& path);

/// The mesh as a binary .ply with coordinates of double precision, and the colours that it has in a byte
/// each.
std::string ply_of(const SurfaceMesh& mesh);

}  // namespace cleft
