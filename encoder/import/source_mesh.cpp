#include "encoder/import/source_mesh.h"

#include <algorithm>
#include <cmath>

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

double diagonal(const std::vector<Vec3>& points) {
  if (points.empty()) return 0;
  Vec3 low = points.front(), high = low;
  for (const Vec3& p : points)
    for (int i = 0; i < 3; ++i) low[i] = std::min(low[i], p[i]), high[i] = std::max(high[i], p[i]);
  return norm(high - low);
}

}  // namespace cleft
