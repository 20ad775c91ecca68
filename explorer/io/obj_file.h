// Polygons of an .obj file (Wavefront's text format). Our own reader, since VTK's keeps single precision
// only, and crashes where a face names what is not there.
#pragma once

#include "explorer/io/mesh_polygons.h"

namespace cleft {

/// The faces ('f') of the file, and the image of its texture as colours of their points (obj_texture.h); a
/// point at the seam of a texture comes once for each place that it has in it. Lines, curves, groups and
/// normals are skipped. Throws FileError with the line that is not as it should be.
MeshPolygons read_obj(const std::string& path);

/// The mesh as text, with coordinates that are read back as they were.
std::string obj_of(const SurfaceMesh& mesh);

}  // namespace cleft
