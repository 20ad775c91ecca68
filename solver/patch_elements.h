// The patch's elements in deal.II, distributed over the ranks, and the numbers of their unknowns.
#pragma once

#include <deal.II/distributed/fully_distributed_tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_fe.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <memory>
#include <vector>

#include "params/parameters/parameters.h"
#include "solver/patch_mesh.h"
#include "solver/patch_system.h"

namespace cleft {

/// Kinds of the faces on the surface. A face of the skin has the number `skin` plus its region's row in
/// skin_regions().
struct BoundaryId {
  static constexpr dealii::types::boundary_id other = 0, bottom = 1, side = 2, bone = 3, skin = 4;
};

/// A cell's material id is its region's row in tissue_regions(), or its number in the mesh's materials.
class PatchElements {
 public:
  /// `division`: rank_of_cell of earlier elements, for equal numbers of the unknowns, because Zoltan's
  /// division is not reproducible. Keeps a reference to the mesh.
  PatchElements(const PatchMesh& mesh, const Parameters& parameters, MPI_Comm communicator,
                const Discretization& discretization, std::vector<unsigned> division = {});

  ElementOrder order() const { return mesh.is_quadratic() ? ElementOrder::quadratic : ElementOrder::linear; }
  int nodes_of_cell() const { return mesh.is_quadratic() ? 18 : 6; }

  /// Frees the elements, whose memory the factor needs. Numbers of unknowns remain.
  void forget();

  MPI_Comm communicator;
  const PatchMesh& mesh;
  const Discretization discretization;
  std::vector<unsigned> rank_of_cell;                       ///< on rank 0
  std::unique_ptr<dealii::Triangulation<3>> triangulation;  ///< distributed where there are several ranks
  dealii::FESystem<3> element;
  dealii::MappingFE<3> mapping;
  dealii::DoFHandler<3> dofs;
  dealii::TrilinosWrappers::SparsityPattern pattern;
  std::vector<int> first_unknown;  ///< by node: of its three
  std::vector<int> offsets;        ///< by rank: its first unknown; then their number
  int rank = 0;

 private:
  void create_triangulation(const Parameters& parameters);
  void distribute_unknowns();
  void make_pattern(bool bending);
  void add_quadratic_pattern();
};

}  // namespace cleft
