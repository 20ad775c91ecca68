// The surface of meshes of every kind of cell.
#include "explorer/study/mesh_skin.h"

#include <gtest/gtest.h>

namespace cleft {
namespace {

struct Cell {
  std::uint8_t type;
  std::vector<Vec3> places;  ///< of its corners; further nodes are in the origin
  std::size_t nodes;
  double volume;
};

const std::vector<Vec3> tetrahedron{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
    box{{0, 0, 0}, {1, 0, 0}, {1, 2, 0}, {0, 2, 0}, {0, 0, 3}, {1, 0, 3}, {1, 2, 3}, {0, 2, 3}},
    voxel{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {1, 2, 0}, {0, 0, 3}, {1, 0, 3}, {0, 2, 3}, {1, 2, 3}},
    pyramid{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 3}},
    // VTK's picture of a wedge has its first triangle face away from the second; others have the opposite.
    wedge{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 2}, {0, 1, 2}, {1, 0, 2}},
    other_wedge{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 2}, {1, 0, 2}, {0, 1, 2}};

const std::vector<Cell> cells{{10, tetrahedron, 4, 1. / 6},
                              {24, tetrahedron, 10, 1. / 6},
                              {12, box, 8, 6},
                              {25, box, 20, 6},
                              {29, box, 27, 6},
                              {11, voxel, 8, 6},
                              {14, pyramid, 5, 1},
                              {27, pyramid, 13, 1},
                              {13, wedge, 6, 1},
                              {26, wedge, 15, 1},
                              {13, other_wedge, 6, 1}};

Snapshot mesh_of(const std::vector<Cell>& some) {
  Snapshot s;
  s.cell_offsets = {0};
  for (const Cell& cell : some) {
    for (std::size_t i = 0; i < cell.nodes; ++i) {
      s.connectivity.push_back(static_cast<std::int64_t>(s.points.size()));
      s.points.push_back(i < cell.places.size() ? cell.places[i] : Vec3{});
    }
    s.cell_types.push_back(cell.type);
    s.cell_offsets.push_back(static_cast<std::int64_t>(s.connectivity.size()));
  }
  return s;
}

/// By the divergence theorem: right only of a closed surface that faces outward everywhere.
double enclosed(const Snapshot& mesh, const Vec3& from) {
  double volume = 0;
  for (const auto& [a, b, c] : skin_of(mesh))
    volume += dot(mesh.points[a] - from, cross(mesh.points[b] - from, mesh.points[c] - from)) / 6;
  return volume;
}

}  // namespace

TEST(MeshSkin, OfEveryKindOfSolidCellEnclosesItsVolume) {
  for (const Cell& cell : cells)
    for (const Vec3& from : {Vec3{0, 0, 0}, Vec3{5, -3, 2}})
      EXPECT_NEAR(enclosed(mesh_of({cell}), from), cell.volume, 1e-12) << int(cell.type);
}

TEST(MeshSkin, FacesThatCellsShareAreNotOnIt) {
  Snapshot mesh = mesh_of({{12, box, 8, 6}});
  for (int i = 0; i < 4; ++i) mesh.points.push_back(box[static_cast<std::size_t>(4 + i)] + Vec3{0, 0, 1});
  mesh.cell_types.push_back(12);
  mesh.connectivity.insert(mesh.connectivity.end(), {4, 5, 6, 7, 8, 9, 10, 11});
  mesh.cell_offsets.push_back(16);
  EXPECT_EQ(skin_of(mesh).size(), 20u);
  EXPECT_NEAR(enclosed(mesh, {1, 1, 1}), 8, 1e-12);
  // A plane cell on the surface changes nothing; one elsewhere is drawn.
  mesh.cell_types.push_back(9);
  mesh.connectivity.insert(mesh.connectivity.end(), {8, 9, 10, 11});
  mesh.cell_offsets.push_back(20);
  EXPECT_EQ(skin_of(mesh).size(), 20u);
  mesh.cell_types.push_back(5);
  mesh.connectivity.insert(mesh.connectivity.end(), {0, 6, 11});
  mesh.cell_offsets.push_back(23);
  EXPECT_EQ(skin_of(mesh).size(), 21u);
}

}  // namespace cleft
