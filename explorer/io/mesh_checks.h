// What VTK's readers of meshes trust a file in, looked at before they read it. All throw FileError naming the
// place in the file.
#pragma once

#include <string>

namespace cleft {

/// VTK's reader of .ply crashes on headers that are not one, or where the body ends early.
void check_ply(const std::string& path);

/// A binary .stl says how many triangles it holds; VTK's reader takes fewer without a word.
void check_stl(const std::string& path);

/// VTK's reader of .obj crashes on faces that name texture coordinates or normals that are not there.
void check_obj(const std::string& path);

}  // namespace cleft
