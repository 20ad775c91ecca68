#include "encoder/import/boundary.h"

#include <vtkCellArray.h>
#include <vtkGenericCell.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <map>

namespace cleft {

namespace {

struct Face {
  int cells = 0;
  Vec3 outward;
};

Vec3 place(const SourceMesh& mesh, vtkIdType node) { return mesh.points[node]; }

/// The cells that have one of the nodes; VTK knows the faces of all types.
vtkNew<vtkUnstructuredGrid> cells_at(const SourceMesh& mesh, const std::vector<char>& asked) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Vec3& p : mesh.points) points->InsertNextPoint(p.x, p.y, p.z);
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(points);
  grid->Allocate(0);
  for (std::size_t c = 0; c < mesh.cell_types.size(); ++c) {
    const std::vector<vtkIdType> corners(mesh.connectivity.begin() + mesh.cell_offsets[c],
                                         mesh.connectivity.begin() + mesh.cell_offsets[c + 1]);
    if (std::any_of(corners.begin(), corners.end(), [&](vtkIdType i) { return asked[i]; }))
      grid->InsertNextCell(mesh.cell_types[c], static_cast<vtkIdType>(corners.size()), corners.data());
  }
  return grid;
}

Vec3 centroid(const SourceMesh& mesh, vtkIdList* nodes) {
  Vec3 sum;
  for (vtkIdType i = 0; i < nodes->GetNumberOfIds(); ++i) sum += place(mesh, nodes->GetId(i));
  return (1 / static_cast<double>(nodes->GetNumberOfIds())) * sum;
}

/// By the first corners, which every type of face lists first.
Vec3 normal_of(const SourceMesh& mesh, vtkCell* face, const Vec3& inside) {
  vtkIdList* nodes = face->GetPointIds();
  const Vec3 a = place(mesh, nodes->GetId(0)), b = place(mesh, nodes->GetId(1)),
             c = place(mesh, nodes->GetId(2));
  const Vec3 normal = cross(b - a, c - a);
  const double length = norm(normal);
  if (!(length > 0)) return {};
  return ((dot(normal, centroid(mesh, nodes) - inside) < 0 ? -1 : 1) / length) * normal;
}

}  // namespace

std::vector<Vec3> outward_at(const SourceMesh& mesh, const std::vector<std::int32_t>& nodes) {
  std::vector<char> asked(mesh.points.size());
  for (const std::int32_t node : nodes) asked[node] = 1;
  const auto grid = cells_at(mesh, asked);

  std::map<std::vector<vtkIdType>, Face> faces;
  vtkNew<vtkGenericCell> cell;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c) {
    grid->GetCell(c, cell);
    if (cell->GetCellDimension() < 3) continue;
    const Vec3 inside = centroid(mesh, cell->GetPointIds());
    for (int f = 0; f < cell->GetNumberOfFaces(); ++f) {
      vtkCell* face = cell->GetFace(f);
      vtkIdList* ids = face->GetPointIds();
      std::vector<vtkIdType> corners(ids->begin(), ids->end());
      if (corners.size() < 3 ||
          std::none_of(corners.begin(), corners.end(), [&](vtkIdType i) { return asked[i]; }))
        continue;
      std::sort(corners.begin(), corners.end());
      const auto [found, is_new] = faces.try_emplace(corners, Face{1, normal_of(mesh, face, inside)});
      if (!is_new) ++found->second.cells;
    }
  }
  std::vector<Vec3> outward;
  for (const auto& [corners, face] : faces)
    if (face.cells == 1 && face.outward != Vec3{}) outward.push_back(face.outward);
  return outward;
}

}  // namespace cleft
