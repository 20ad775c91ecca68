// The mesh of another program, in its own space.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/vec3.h"

namespace cleft {

/// N points, C cells of any of VTK's types.
struct SourceMesh {
  std::vector<Vec3> points;                ///< N
  std::vector<std::uint8_t> cell_types;    ///< C
  std::vector<std::int64_t> cell_offsets;  ///< C + 1
  std::vector<std::int64_t> connectivity;
};

inline bool same_cells(const SourceMesh& a, const SourceMesh& b) {
  return a.cell_types == b.cell_types && a.cell_offsets == b.cell_offsets && a.connectivity == b.connectivity;
}

/// Of each cell of one mesh its number in another; empty where they are in the same order.
using CellOrder = std::vector<std::size_t>;

/// Where the cells of `as` are in a mesh with as many nodes and the same cells, with the same corners in
/// their order; none of another mesh. Filters that make the skin of a body may list its cells in another
/// order each time.
std::optional<CellOrder> order_as(const SourceMesh& mesh, const SourceMesh& as);

/// Whether a mesh has the same nodes, by their number, and the same cells in any order.
bool same_mesh(const SourceMesh& a, const SourceMesh& b);

/// Length of the diagonal of the box around the points.
double diagonal(const std::vector<Vec3>& points);

/// Points that are closer are at the same place: much less than any element, more than rounding to single
/// precision.
inline double same_place(const SourceMesh& mesh) { return 1e-7 * diagonal(mesh.points); }

/// Points that are closer to a plane are in it: more than rounding to the six digits of a text file.
inline double in_plane(const SourceMesh& mesh) { return 2e-5 * diagonal(mesh.points); }

}  // namespace cleft
