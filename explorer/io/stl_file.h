// Triangles of an .stl file (stereolithography: text, or binary). Our own reader, since VTK's trusts the
// count in its header, and keeps single precision of text too.
#pragma once

#include "explorer/io/mesh_polygons.h"

namespace cleft {

/// Corners at the same place are one point; normals are skipped. Throws FileError where the file is not
/// whole, or names the line of a text that is not as it should be.
MeshPolygons read_stl(const std::string& path);

/// The mesh as a binary .stl, with coordinates of single precision. Throws InputError, naming `path`, where
/// it is more than a thousand of its diameters from the origin.
std::string stl_of(const SurfaceMesh& mesh, const std::string& path);

}  // namespace cleft
