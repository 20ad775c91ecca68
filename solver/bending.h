// The bending stiffness of the skin, over the edges between its triangles.
#pragma once

#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <array>
#include <vector>

#include "solver/patch_elements.h"

namespace cleft {

/// Two triangles at a common edge, and their four nodes. The sum of `bend` times the displacements of these
/// is the edge's length times the jump of the displacement's gradient across it.
struct Hinge {
  std::array<int, 4> nodes;
  std::array<double, 4> bend;
  double weight;  ///< 1 over the sum of the triangles' areas, 1/mm^2
};

/// All of a mesh that no cut parts.
std::vector<Hinge> skin_hinges(const PatchMesh& mesh);

/// A hinge across a cut, which holds as long as the cut is closed at both ends of its edge. Of the edge it
/// has the nodes of one lip, with which those of the other move until then.
struct Joint {
  Hinge hinge;
  std::vector<int> pairs;  ///< that tie its two lips, sorted
};

std::vector<Joint> skin_joints(const PatchMesh& mesh);

/// Adds the matrix of the energy of bending, to the rows that this rank owns, of a matrix whose pattern has
/// these entries. It is quadratic in the displacements as long as triangles keep their shape, however far
/// they turn (Bergou, Wardetzky, Harmon, Zorin and Grinspun 2006). On squares with a diagonal it is D/2
/// (k_u^2 + k_v^2) of the curvatures along u and v, and twice a plate's energy of twist. `stiffness`: D, N
/// mm.
void add_bending(const PatchElements& elements, double stiffness,
                 dealii::TrilinosWrappers::SparseMatrix& matrix);

/// A hinge's part of it, times a factor. `first_unknown` by node; rows from `first` to before `end`.
void add_hinge(const Hinge& hinge, double factor, const std::vector<int>& first_unknown, int first, int end,
               dealii::TrilinosWrappers::SparseMatrix& matrix);

/// Of hinges and joints.
void add_bending_pattern(const PatchMesh& mesh, const std::vector<int>& first_unknown,
                         const dealii::IndexSet& owned, dealii::TrilinosWrappers::SparsityPattern& pattern);

}  // namespace cleft
