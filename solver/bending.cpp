#include "solver/bending.h"

#include <map>

#include "solver/skin_triangle.h"

namespace cleft {

std::vector<Hinge> skin_hinges(const PatchMesh& mesh) {
  struct Side {
    int triangle, opposite;  // the corner that is not on the edge
  };
  std::map<std::pair<int, int>, std::vector<Side>> sides;  // by edge
  for (std::size_t t = 0; t < mesh.skin.size(); ++t)
    for (int c = 0; c < 3; ++c) {
      const int a = mesh.skin[t][(c + 1) % 3], b = mesh.skin[t][(c + 2) % 3];
      sides[std::minmax(a, b)].push_back({static_cast<int>(t), c});
    }
  std::vector<Hinge> hinges;
  for (const auto& [edge, both] : sides) {
    if (both.size() != 2) continue;
    const Vec3 &a = mesh.points[edge.first], &b = mesh.points[edge.second];
    Hinge hinge{{edge.first, edge.second}, {}, 0};
    double areas = 0;
    for (int side = 0; side < 2; ++side) {
      const auto& corners = mesh.skin[both[side].triangle];
      const SkinTriangle triangle(mesh.points[corners[0]], mesh.points[corners[1]], mesh.points[corners[2]]);
      areas += triangle.area();
      hinge.nodes[2 + side] = corners[both[side].opposite];
      // The edge turned by a right angle: the length times the unit normal.
      const Eigen::RowVector3d slope =
          Eigen::RowVector2d(b.y - a.y, a.x - b.x) * triangle.gradients() * (side == 0 ? 1 : -1);
      for (int c = 0; c < 3; ++c)
        for (int n = 0; n < 4; ++n)
          if (corners[c] == hinge.nodes[n] && (n < 2 || n == 2 + side)) hinge.bend[n] += slope[c];
    }
    hinge.weight = 1 / areas;
    hinges.push_back(hinge);
  }
  return hinges;
}

void add_bending(const PatchElements& elements, double stiffness,
                 dealii::TrilinosWrappers::SparseMatrix& matrix) {
  if (stiffness == 0) return;
  const int first = elements.offsets[elements.rank], end = elements.offsets[elements.rank + 1];
  for (const Hinge& hinge : skin_hinges(elements.mesh))
    for (int a = 0; a < 4; ++a)
      for (int axis = 0; axis < 3; ++axis) {
        const int row = elements.first_unknown[hinge.nodes[a]] + axis;
        for (int b = 0; b < 4 && first <= row && row < end; ++b)
          matrix.add(row, elements.first_unknown[hinge.nodes[b]] + axis,
                     stiffness * hinge.weight * hinge.bend[a] * hinge.bend[b]);
      }
}

void add_bending_pattern(const PatchMesh& mesh, const std::vector<int>& first_unknown,
                         const dealii::IndexSet& owned, dealii::TrilinosWrappers::SparsityPattern& pattern) {
  for (const Hinge& hinge : skin_hinges(mesh))
    for (const int a : hinge.nodes)
      for (int axis = 0; axis < 3; ++axis)
        for (const int b : hinge.nodes)
          if (owned.is_element(first_unknown[a] + axis))
            pattern.add(first_unknown[a] + axis, first_unknown[b] + axis);
}

}  // namespace cleft
