// The table of mesh formats. Help texts, error messages, file dialogs and dropped files take their endings
// from here. This header does not include VTK: explorer/io/mesh_file.cpp adds a reader and a writer to each
// row of a surface, and does not compile if one is missing.
#pragma once

#include <string>
#include <string_view>

namespace cleft {

enum class MeshKind { surface, volume };
enum class MeshUse { read, write };

/// Cleft reads all formats of the table and writes some of them.
struct MeshFormat {
  std::string_view ending;  ///< in lower case, with its dot
  MeshKind kind;
  bool written;       ///< whether Cleft writes it, too
  bool keeps_arrays;  ///< whether a written file holds arrays of the points
};

inline constexpr MeshFormat mesh_formats[] = {
    {".stl", MeshKind::surface, true, false},  {".obj", MeshKind::surface, true, false},
    {".ply", MeshKind::surface, true, false},  {".vtp", MeshKind::surface, true, true},
    {".glb", MeshKind::surface, false, false}, {".gltf", MeshKind::surface, false, false},
    {".vtu", MeshKind::volume, true, true},
};

/// The ending of a path with its dot, in lower case: ".stl" of HEAD.STL.
std::string ending_of(const std::string& path);

/// Whether a path has the ending of a mesh of this kind.
bool is_mesh(const std::string& path, MeshKind kind);

/// The row of a surface's path. Throws InputError with the known endings if its ending has none, or if it is
/// to be written and Cleft only reads it.
const MeshFormat& surface_format(const std::string& path, MeshUse use);

/// Endings as texts list them: ".stl .obj .ply .vtp .glb .gltf".
std::string mesh_endings(MeshKind kind, MeshUse use);
/// Those of all formats whose written files hold arrays of the points.
std::string mesh_endings_with_arrays();

/// The surfaces as a file dialog takes them: "Surface meshes (*.stl *.obj ...)".
std::string surface_filter(MeshUse use);

}  // namespace cleft
