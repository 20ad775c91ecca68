#include <cstdint>

#include "base/error.h"
#include "explorer/io/binary_text.h"
#include "explorer/io/ply_file.h"

namespace cleft {

std::string ply_of(const SurfaceMesh& mesh) {
  const bool colored = !mesh.colors.empty();
  if (colored) CLEFT_CHECK(mesh.colors.size(), ==, mesh.points.size());
  std::string bytes =
      "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(mesh.points.size()) +
      "\nproperty double x\nproperty double y\nproperty double z\n" +
      (colored ? "property uchar red\nproperty uchar green\nproperty uchar blue\n" : "") + "element face " +
      std::to_string(mesh.triangles.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
  for (std::size_t p = 0; p < mesh.points.size(); ++p) {
    for (int k = 0; k < 3; ++k) append_little(bytes, mesh.points[p][k]);
    if (!colored) continue;
    for (const std::uint8_t part : byte_color(mesh.colors[p])) append_little(bytes, part);
  }
  for (const auto& corners : mesh.triangles) {
    append_little(bytes, std::uint8_t{3});
    for (const int corner : corners) append_little(bytes, std::int32_t{corner});
  }
  return bytes;
}

}  // namespace cleft
