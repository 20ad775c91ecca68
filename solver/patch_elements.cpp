#include "solver/patch_elements.h"

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_wedge_p.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <array>
#include <map>

#include "base/error.h"
#include "solver/bending.h"
#include "solver/material/regions.h"

namespace cleft {

using namespace dealii;

namespace {

void partition(Triangulation<3>& triangulation, unsigned ranks, Partitioner partitioner) {
  if (partitioner == Partitioner::zorder)
    GridTools::partition_triangulation_zorder(ranks, triangulation);
  else
    GridTools::partition_triangulation(ranks, triangulation,
                                       partitioner == Partitioner::metis
                                           ? SparsityTools::Partitioner::metis
                                           : SparsityTools::Partitioner::zoltan);
}

/// What the faces on the surface are, by their nodes.
class Boundaries {
 public:
  Boundaries(const PatchMesh& mesh, const Parameters& p) {
    const WedgeCells& cells = mesh.elements();
    for (const auto& face : cells.skin) {
      const Vec3 center = 1. / 3 * (mesh.points[face[0]] + mesh.points[face[1]] + mesh.points[face[2]]);
      add(face, BoundaryId::skin + region_at(skin_regions(), p, center));
    }
    for (std::size_t f = 0; f < cells.bottom.size(); ++f)
      add(cells.bottom[f], !mesh.on_bone.empty() && mesh.on_bone[f] ? BoundaryId::bone : BoundaryId::bottom);
    for (const auto& face : cells.sides) add(face, BoundaryId::side);
  }

  template <class Face>
  types::boundary_id of(const Face& face) const {
    std::array<int, 4> nodes = none;
    for (unsigned v = 0; v < face->n_vertices(); ++v) nodes[v] = static_cast<int>(face->vertex_index(v));
    std::sort(nodes.begin(), nodes.end());
    const auto found = kinds_.find(nodes);
    return found == kinds_.end() ? BoundaryId::other : found->second;  // other: a wall of the cut
  }

 private:
  static constexpr std::array<int, 4> none = {-1, -1, -1, -1};

  template <std::size_t K>
  void add(const std::array<int, K>& face, unsigned kind) {
    std::array<int, 4> nodes = none;
    std::copy(face.begin(), face.end(), nodes.begin());
    std::sort(nodes.begin(), nodes.end());
    kinds_.emplace(nodes, static_cast<types::boundary_id>(kind));
  }

  std::map<std::array<int, 4>, types::boundary_id> kinds_;
};

/// The nodes of an element, in the order of deal.II: corners, middles of edges and of upright faces.
std::array<int, 18> nodes_of(const PatchMesh& mesh, std::size_t element) {
  std::array<int, 18> nodes{};
  auto next = std::copy_n(mesh.elements().wedges[element].begin(), 6, nodes.begin());
  if (!mesh.is_quadratic()) return nodes;
  next = std::copy_n(mesh.middles[element].edges.begin(), 9, next);
  std::copy_n(mesh.middles[element].faces.begin(), 3, next);
  return nodes;
}

/// The whole mesh, each element with its region.
void make_whole(const PatchMesh& mesh, const Parameters& parameters, Triangulation<3>& whole) {
  std::vector<Point<3>> vertices;
  for (const Vec3& p : mesh.points) vertices.emplace_back(p.x, p.y, p.z);
  std::vector<CellData<3>> cells;
  const auto& wedges = mesh.elements().wedges;
  for (std::size_t w = 0; w < wedges.size(); ++w) {
    const auto& wedge = wedges[w];
    CellData<3>& cell = cells.emplace_back(6);
    Vec3 center;
    for (unsigned i = 0; i < 6; ++i) {
      cell.vertices[i] = wedge[i];
      center = center + 1. / 6 * mesh.points[wedge[i]];
    }
    cell.material_id = mesh.region.empty() ? region_at(tissue_regions(), parameters, center) : mesh.region[w];
  }
  whole.create_triangulation(vertices, cells, SubCellData());
  const Boundaries boundaries(mesh, parameters);
  for (const auto& cell : whole.active_cell_iterators())
    for (const unsigned f : cell->face_indices())
      if (cell->face(f)->at_boundary()) cell->face(f)->set_boundary_id(boundaries.of(cell->face(f)));
}

}  // namespace

PatchElements::PatchElements(const PatchMesh& patch, const Parameters& parameters, MPI_Comm comm,
                             const Discretization& d, std::vector<unsigned> division)
    : communicator(comm),
      mesh(patch),
      discretization(d),
      rank_of_cell(std::move(division)),
      element(FE_WedgeP<3>(patch.is_quadratic() ? 2 : 1), 3),
      mapping(FE_WedgeP<3>(1)) {
  create_triangulation(parameters);
  distribute_unknowns();
  make_pattern(parameters.skin.bending_stiffness > 0);
}

void PatchElements::forget() {
  dofs.clear();
  triangulation->clear();
  pattern.clear();
}

/// Of several ranks, the first one makes the whole mesh, divides it and hands out the parts.
void PatchElements::create_triangulation(const Parameters& parameters) {
  const unsigned ranks = Utilities::MPI::n_mpi_processes(communicator);
  if (ranks == 1) {
    triangulation = std::make_unique<Triangulation<3>>();
    return make_whole(mesh, parameters, *triangulation);
  }
  triangulation = std::make_unique<parallel::fullydistributed::Triangulation<3>>(communicator);
  triangulation->create_triangulation(
      TriangulationDescription::Utilities::create_description_from_triangulation_in_groups<3, 3>(
          [&](Triangulation<3>& whole) { make_whole(mesh, parameters, whole); },
          [&](Triangulation<3>& whole, const MPI_Comm&, unsigned) {
            if (rank_of_cell.empty()) partition(whole, ranks, discretization.partitioner);
            rank_of_cell.resize(whole.n_active_cells(), numbers::invalid_subdomain_id);
            for (const auto& cell : whole.active_cell_iterators()) {
              unsigned& owner = rank_of_cell[cell->active_cell_index()];
              if (owner == numbers::invalid_subdomain_id) owner = cell->subdomain_id();
              cell->set_subdomain_id(owner);
            }
          },
          communicator, static_cast<int>(ranks)));
}

void PatchElements::distribute_unknowns() {
  dofs.reinit(*triangulation);
  dofs.distribute_dofs(element);
  offsets = {0};
  for (const IndexSet& owned : Utilities::MPI::all_gather(communicator, dofs.locally_owned_dofs())) {
    CLEFT_CHECK(owned.is_contiguous(), ==, true);
    offsets.push_back(offsets.back() + static_cast<int>(owned.n_elements()));
  }
  rank = static_cast<int>(Utilities::MPI::this_mpi_process(communicator));
  std::vector<int> known(mesh.points.size(), -1);
  std::vector<types::global_dof_index> indices(element.n_dofs_per_cell());
  constexpr double rounding = 1e-9;  // mm
  for (const auto& cell : dofs.active_cell_iterators()) {
    if (!cell->is_locally_owned()) continue;
    const std::array<int, 18> nodes = nodes_of(mesh, cell->id().get_coarse_cell_id());
    cell->get_dof_indices(indices);
    for (int a = 0; a < nodes_of_cell(); ++a) {
      const Vec3& at = mesh.points[nodes[a]];
      const Point<3> place =
          a < 6 ? cell->vertex(a)
                : mapping.transform_unit_to_real_cell(cell, element.unit_support_point(3 * a));
      CLEFT_CHECK(place.distance({at.x, at.y, at.z}), <, rounding);
      known[nodes[a]] = static_cast<int>(indices[3 * a]);
      CLEFT_CHECK(indices[3 * a + 2], ==, indices[3 * a] + 2);
    }
  }
  first_unknown.resize(known.size());
  MPI_Allreduce(known.data(), first_unknown.data(), static_cast<int>(known.size()), MPI_INT, MPI_MAX,
                communicator);
}

void PatchElements::make_pattern(bool bending) {
  const IndexSet& owned = dofs.locally_owned_dofs();
  pattern.reinit(owned, owned, communicator, 60);
  if (mesh.is_quadratic())
    add_quadratic_pattern();
  else
    DoFTools::make_sparsity_pattern(dofs, pattern, AffineConstraints<double>(), true,
                                    triangulation->locally_owned_subdomain());
  if (bending) add_bending_pattern(mesh, first_unknown, owned, pattern);
  pattern.compress();
}

/// The 15 nodes of an element are coupled with each other; those in its faces have entries of their own
/// alone.
void PatchElements::add_quadratic_pattern() {
  constexpr unsigned coupled = 3 * 15;
  std::vector<types::global_dof_index> indices(element.n_dofs_per_cell());
  for (const auto& cell : dofs.active_cell_iterators()) {
    if (!cell->is_locally_owned()) continue;
    cell->get_dof_indices(indices);
    const auto others = indices.begin() + coupled;
    for (auto row = indices.begin(); row != others; ++row) pattern.add_entries(*row, indices.begin(), others);
    for (auto row = others; row != indices.end(); ++row) pattern.add(*row, *row);
  }
}

}  // namespace cleft
