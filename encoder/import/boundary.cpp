#include "encoder/import/boundary.h"

#include <vtkCellArray.h>
#include <vtkGenericCell.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <set>

#include "solver/snapshot/cell_types.h"

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

/// The cells of each node of the largest dimension, and their faces; edges, of cells of a plane mesh.
class Faces {
 public:
  using Corners = std::vector<std::int64_t>;  // ascending
  struct Outer {
    Corners corners;
    Vec3 outward;
  };

  /// Without cells that have both nodes of a pair: those are between the lips.
  Faces(const SourceMesh& mesh, const std::vector<std::array<std::int32_t, 2>>& pairs) : mesh_(mesh) {
    std::map<std::uint8_t, int> dimensions;
    for (const std::uint8_t type : mesh.cell_types) dimensions.try_emplace(type, 0);
    for (auto& [type, dimension] : dimensions) {
      cell_->SetCellType(type);
      dimension = cell_->GetCellDimension(), dimension_ = std::max(dimension_, dimension);
    }
    std::vector<std::int32_t> partner(mesh.points.size(), -1);
    for (const auto& [left, right] : pairs) partner[left] = right;
    const auto is_asked = [&](std::size_t c) {
      if (dimensions.at(mesh.cell_types[c]) < dimension_) return false;
      const auto first = mesh.connectivity.begin() + mesh.cell_offsets[c],
                 last = mesh.connectivity.begin() + mesh.cell_offsets[c + 1];
      return std::none_of(first, last, [&](std::int64_t n) {
        return partner[n] >= 0 && std::find(first, last, partner[n]) != last;
      });
    };
    first_.assign(mesh.points.size() + 1, 0);
    std::vector<char> asked(mesh.cell_types.size());
    const auto for_each_corner = [&](const auto& take) {
      for (std::size_t c = 0; c < asked.size(); ++c)
        for (auto i = mesh.cell_offsets[c]; asked[c] && i < mesh.cell_offsets[c + 1]; ++i)
          take(static_cast<std::size_t>(mesh.connectivity[i]), static_cast<std::int32_t>(c));
    };
    for (std::size_t c = 0; c < asked.size(); ++c) asked[c] = is_asked(c);
    for_each_corner([&](std::size_t n, std::int32_t) { ++first_[n + 1]; });
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    cells_.resize(static_cast<std::size_t>(first_.back()));
    std::vector<std::int64_t> next = first_;
    for_each_corner([&](std::size_t n, std::int32_t c) { cells_[static_cast<std::size_t>(next[n]++)] = c; });
  }

  /// How many corners two faces share that are neighbours.
  std::size_t shared() const { return dimension_ == 3 ? 2 : 1; }

  /// Those of one cell alone that have the node.
  std::vector<Outer> outer_at(std::int64_t node) {
    std::map<Corners, std::pair<int, Vec3>> found;
    for (std::int64_t i = first_[node]; i < first_[node + 1]; ++i) {
      set_cell(static_cast<std::size_t>(cells_[i]));
      const Vec3 inside = centroid(mesh_, cell_->GetPointIds());
      const int count = dimension_ == 3 ? cell_->GetNumberOfFaces() : cell_->GetNumberOfEdges();
      for (int f = 0; f < count; ++f) {
        vtkCell* face = dimension_ == 3 ? cell_->GetFace(f) : cell_->GetEdge(f);
        Corners corners(face->GetPointIds()->begin(), face->GetPointIds()->end());
        if (std::find(corners.begin(), corners.end(), node) == corners.end()) continue;
        const Vec3 outward = dimension_ == 3 ? normal_of(mesh_, face, inside) : away(corners, inside);
        std::sort(corners.begin(), corners.end());
        const auto [at, is_new] = found.try_emplace(corners, 1, outward);
        if (!is_new) ++at->second.first;
      }
    }
    std::vector<Outer> outer;
    for (auto& [corners, face] : found)
      if (face.first == 1 && face.second != Vec3{}) outer.push_back({corners, face.second});
    return outer;
  }

 private:
  void set_cell(std::size_t c) {
    cell_->SetCellType(mesh_.cell_types[c]);
    const auto first = mesh_.cell_offsets[c], count = mesh_.cell_offsets[c + 1] - first;
    cell_->PointIds->SetNumberOfIds(count), cell_->Points->SetNumberOfPoints(count);
    for (std::int64_t i = 0; i < count; ++i) {
      const std::int64_t node = mesh_.connectivity[first + i];
      cell_->PointIds->SetId(i, node);
      cell_->Points->SetPoint(i, mesh_.points[node].x, mesh_.points[node].y, mesh_.points[node].z);
    }
  }
  /// From a place in a cell across one of its edges.
  Vec3 away(const Corners& edge, const Vec3& inside) const {
    const Vec3 &a = mesh_.points[edge[0]], along = mesh_.points[edge[1]] - a;
    if (along == Vec3{}) return {};
    const Vec3 way = a - inside, across = way - (dot(way, along) / squared_norm(along)) * along;
    return across == Vec3{} ? across : normalized(across);
  }

  const SourceMesh& mesh_;
  vtkNew<vtkGenericCell> cell_;
  int dimension_ = 0;
  std::vector<std::int64_t> first_;  // of the cells of each node
  std::vector<std::int32_t> cells_;
};

}  // namespace

std::optional<Vec3> normal_of_shell(const SourceMesh& mesh, const std::vector<char>& at) {
  if (!std::all_of(mesh.cell_types.begin(), mesh.cell_types.end(), is_flat_type)) return {};
  Vec3 sum;
  for (std::size_t c = 0; c < mesh.cell_types.size(); ++c) {
    const auto first = mesh.connectivity.begin() + mesh.cell_offsets[c],
               last = mesh.connectivity.begin() + mesh.cell_offsets[c + 1];
    if (last - first < 3 || std::none_of(first, last, [&](std::int64_t n) { return at[n]; })) continue;
    const Vec3& corner = mesh.points[*first];
    const Vec3 normal = cross(mesh.points[first[1]] - corner, mesh.points[first[2]] - corner);
    sum += (dot(normal, sum) < 0 ? -1 : 1) * normal;
  }
  if (sum == Vec3{}) return {};
  return normalized(sum);
}

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

std::vector<std::int32_t> nodes_continuing_lips(const SourceMesh& mesh,
                                                const std::vector<std::array<std::int32_t, 2>>& pairs,
                                                const std::vector<bool>& at_front, const Vec3& normal) {
  const double least_cosine = std::cos(std::numbers::pi / 6), steepest = std::cos(std::numbers::pi / 3);
  std::vector<char> on_lip(mesh.points.size());
  for (const auto& pair : pairs)
    for (const std::int32_t node : pair) on_lip[node] = 1;
  Faces faces(mesh, pairs);
  std::set<Faces::Corners> seen;
  std::vector<Faces::Outer> todo;
  for (const auto& pair : pairs)
    for (const std::int32_t node : pair)
      for (Faces::Outer& face : faces.outer_at(node))
        if (std::all_of(face.corners.begin(), face.corners.end(),
                        [&](std::int64_t n) { return on_lip[n] || at_front[n]; }) &&
            seen.insert(face.corners).second)
          todo.push_back(std::move(face));
  std::set<std::int32_t> nodes;
  while (!todo.empty()) {
    const Faces::Outer from = std::move(todo.back());
    todo.pop_back();
    for (const std::int64_t node : from.corners)
      for (Faces::Outer& face : faces.outer_at(node)) {
        Faces::Corners both;
        std::set_intersection(from.corners.begin(), from.corners.end(), face.corners.begin(),
                              face.corners.end(), std::back_inserter(both));
        if (both.size() < faces.shared() || dot(from.outward, face.outward) < least_cosine ||
            std::abs(dot(face.outward, normal)) < steepest || !seen.insert(face.corners).second)
          continue;
        for (const std::int64_t n : face.corners)
          if (!on_lip[n] && !at_front[n]) nodes.insert(static_cast<std::int32_t>(n));
        todo.push_back(std::move(face));
      }
  }
  return {nodes.begin(), nodes.end()};
}

}  // namespace cleft
