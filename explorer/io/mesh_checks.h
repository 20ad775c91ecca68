// Checks of mesh files before VTK's readers, which trust their content. All throw FileError with the place in
// the file.
#pragma once

#include <string>

namespace cleft {

/// A binary .stl states its number of triangles; VTK's reader accepts fewer silently.
void check_stl(const std::string& path);

/// VTK's reader of .obj crashes on faces that name texture coordinates or normals that do not exist.
void check_obj(const std::string& path);

}  // namespace cleft
