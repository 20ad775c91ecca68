#include "explorer/study/mesh_skin.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <unordered_map>

namespace cleft {

namespace {

using Face = std::array<std::int32_t, 4>;  // the last -1 of a triangle

/// The corners of a solid cell's faces, by VTK's order of its nodes.
std::span<const Face> faces_of(std::uint8_t type) {
  static const std::vector<Face> tetrahedron{{0, 2, 1, -1}, {0, 1, 3, -1}, {1, 2, 3, -1}, {0, 3, 2, -1}};
  static const std::vector<Face> hexahedron{{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                            {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  static const std::vector<Face> voxel{{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                       {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}};
  static const std::vector<Face> wedge{
      {0, 1, 2, -1}, {3, 5, 4, -1}, {0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}};
  static const std::vector<Face> pyramid{
      {0, 3, 2, 1}, {0, 1, 4, -1}, {1, 2, 4, -1}, {2, 3, 4, -1}, {3, 0, 4, -1}};
  switch (type) {  // VTK's types, linear and quadratic
    case 10:
    case 24:
      return tetrahedron;
    case 11:
      return voxel;
    case 12:
    case 25:
    case 29:
    case 33:
      return hexahedron;
    case 13:
    case 26:
    case 31:
    case 32:
      return wedge;
    case 14:
    case 27:
      return pyramid;
    default:
      return {};
  }
}

/// Corners of a cell in a plane; 0 of others.
std::size_t corners_of_plane(std::uint8_t type, std::size_t nodes) {
  switch (type) {
    case 5:
    case 22:
    case 34:
      return 3;
    case 9:
    case 23:
    case 28:
    case 30:
      return 4;
    case 7:
      return nodes;
    default:
      return 0;
  }
}

struct KeyHash {
  std::size_t operator()(const Face& face) const {
    std::uint64_t hash = 0;
    for (const std::int32_t node : face) {
      hash = (hash ^ static_cast<std::uint32_t>(node)) * 0x9E3779B97F4A7C15u;
      hash ^= hash >> 29;
    }
    return hash;
  }
};

/// The corners in the order in which they are counter-clockwise seen from outside of the cell: programs
/// differ in their order of wedges' nodes.
Face facing_away(const Snapshot& mesh, Face face, std::size_t first, std::size_t nodes) {
  Vec3 inside;
  for (std::size_t i = first; i < first + nodes; ++i)
    inside += (1 / static_cast<double>(nodes)) * mesh.points[static_cast<std::size_t>(mesh.connectivity[i])];
  const Vec3 &a = mesh.points[static_cast<std::size_t>(face[0])],
             &b = mesh.points[static_cast<std::size_t>(face[1])],
             &c = mesh.points[static_cast<std::size_t>(face[2])];
  if (dot(cross(b - a, c - a), a - inside) < 0) std::swap(face[1], face[face[3] >= 0 ? 3 : 2]);
  return face;
}

}  // namespace

std::vector<std::array<int, 3>> skin_of(const Snapshot& mesh) {
  std::unordered_map<Face, std::pair<Face, int>, KeyHash>
      faces;                // by sorted corners: as listed, and how often
  std::vector<Face> order;  // the skin does not depend on a hash
  const auto see = [&](const Face& face, int cells) {
    Face key = face;
    std::sort(key.begin(), key.end());
    const auto [found, is_new] = faces.try_emplace(key, face, 0);
    found->second.second += cells;
    if (is_new) order.push_back(key);
  };
  for (const bool solid : {true, false})  // a plane cell on a solid one's face is that face
    for (std::size_t c = 0; c < mesh.cell_types.size(); ++c) {
      const auto first = static_cast<std::size_t>(mesh.cell_offsets[c]);
      const std::size_t nodes = static_cast<std::size_t>(mesh.cell_offsets[c + 1]) - first;
      const auto node = [&](std::size_t i) {
        return static_cast<std::int32_t>(mesh.connectivity[first + i]);
      };
      if (solid)
        for (const Face& corners : faces_of(mesh.cell_types[c])) {
          Face face{-1, -1, -1, -1};
          for (std::size_t i = 0; i < 4 && corners[i] >= 0; ++i)
            face[i] = node(static_cast<std::size_t>(corners[i]));
          see(facing_away(mesh, face, first, nodes), 1);
        }
      const std::size_t plane = solid ? 0 : std::min(corners_of_plane(mesh.cell_types[c], nodes), nodes);
      if (plane == 4) see({node(0), node(1), node(2), node(3)}, 0);
      if (plane == 3 || plane > 4)
        for (std::size_t i = 2; i < plane; ++i) see({node(0), node(i - 1), node(i), -1}, 0);
    }
  std::vector<std::array<int, 3>> triangles;
  for (const Face& key : order) {
    const auto& [face, cells] = faces.at(key);
    if (cells > 1) continue;
    triangles.push_back({face[0], face[1], face[2]});
    if (face[3] >= 0) triangles.push_back({face[0], face[2], face[3]});
  }
  return triangles;
}

}  // namespace cleft
