#include "encoder/import/source_mesh.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "base/error.h"
#include "encoder/import/frame_files.h"

namespace cleft {

namespace {

constexpr std::uint8_t polyhedron = 42;  // VTK_POLYHEDRON

}  // namespace

void check_cells(const std::string& where, const SourceMesh& mesh) {
  const auto refuse = [&](const std::string& what) { throw InputError(where + ": " + what); };
  const auto& offsets = mesh.cell_offsets;
  if (mesh.cell_types.empty()) refuse("holds no cells");
  if (offsets.size() != mesh.cell_types.size() + 1 || offsets.front() != 0 ||
      !std::is_sorted(offsets.begin(), offsets.end()) ||
      offsets.back() != static_cast<std::int64_t>(mesh.connectivity.size()))
    refuse("is damaged: the cells' offsets do not agree with their types and corners");
  for (std::size_t c = 0; c < mesh.cell_types.size(); ++c) {
    if (mesh.cell_types[c] == polyhedron)
      refuse("cell " + std::to_string(c) +
             " is a polyhedron, which snapshots cannot hold; split it into tetrahedra first");
    if (offsets[c + 1] == offsets[c]) refuse("cell " + std::to_string(c) + " has no corners");
  }
  const auto points = static_cast<std::int64_t>(mesh.points.size());
  for (const std::int64_t i : mesh.connectivity)
    if (i < 0 || i >= points)
      refuse("is damaged: a cell names node " + std::to_string(i) + " of " + std::to_string(points));
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    if (!std::isfinite(squared_norm(mesh.points[i])))
      refuse("the place of node " + std::to_string(i) + " is not finite");
}

namespace {

std::span<const std::int64_t> corners_of(const SourceMesh& mesh, std::size_t cell) {
  return {mesh.connectivity.data() + mesh.cell_offsets[cell],
          mesh.connectivity.data() + mesh.cell_offsets[cell + 1]};
}

/// By type and corners; less than 0, 0 or more than 0.
int compared(const SourceMesh& a, std::size_t i, const SourceMesh& b, std::size_t k) {
  if (a.cell_types[i] != b.cell_types[k]) return a.cell_types[i] < b.cell_types[k] ? -1 : 1;
  const auto x = corners_of(a, i), y = corners_of(b, k);
  if (std::lexicographical_compare(x.begin(), x.end(), y.begin(), y.end())) return -1;
  return std::equal(x.begin(), x.end(), y.begin(), y.end()) ? 0 : 1;
}

CellOrder sorted_cells(const SourceMesh& mesh) {
  CellOrder cells(mesh.cell_types.size());
  std::iota(cells.begin(), cells.end(), 0);
  std::sort(cells.begin(), cells.end(), [&](std::size_t i, std::size_t k) {
    const int order = compared(mesh, i, mesh, k);
    return order != 0 ? order < 0 : i < k;
  });
  return cells;
}

}  // namespace

std::optional<CellOrder> order_as(const SourceMesh& mesh, const SourceMesh& as) {
  const std::size_t cells = as.cell_types.size();
  if (mesh.points.size() != as.points.size()) return {};
  if (same_cells(mesh, as)) return CellOrder();
  if (mesh.cell_types.size() != cells || mesh.cell_offsets.size() != cells + 1 ||
      as.cell_offsets.size() != cells + 1 || mesh.connectivity.size() != as.connectivity.size())
    return {};
  CellOrder order(cells);
  const CellOrder here = sorted_cells(mesh), there = sorted_cells(as);
  for (std::size_t i = 0; i < cells; ++i) {
    if (compared(mesh, here[i], as, there[i]) != 0) return {};
    order[there[i]] = here[i];
  }
  return order;
}

bool same_mesh(const SourceMesh& a, const SourceMesh& b) { return order_as(a, b).has_value(); }

double diagonal(const std::vector<Vec3>& points) {
  if (points.empty()) return 0;
  Vec3 low = points.front(), high = low;
  for (const Vec3& p : points)
    for (int i = 0; i < 3; ++i) low[i] = std::min(low[i], p[i]), high[i] = std::max(high[i], p[i]);
  return norm(high - low);
}

}  // namespace cleft
