// The texture of an .obj file, as colours of its points: vertices at the seams of a texture have several
// places in it, and cuts would tear triangles apart there, while colours of points survive every cut. Private
// to this folder.
#pragma once

#include <string>

class vtkPolyData;

namespace cleft {

/// Gives `data`, as VTK reads it from the .obj at `path`, the colours of the image that its material maps
/// (map_Kd in the file of `mtllib`), each the mean of the image over half the way to the nearest neighbours,
/// as an array RGB of the points. They are left out where they are further than `most_lost`
/// (texture_colors.h) from the image, on the mean over the triangles, and where no single image can be read.
/// Returns what is to be said of that; empty: no texture.
std::string add_texture_colors(const std::string& path, vtkPolyData* data);

}  // namespace cleft
