// Stiffness and loads of the patch's elements: tissue, skin and springs.
#pragma once

#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <Eigen/Core>
#include <vector>

#include "solver/patch_elements.h"

namespace cleft {

/// Of a face below or at the side, N/mm^3. Tissue that is grown to bone gives way a thousand times less than
/// by its own strain.
double spring_of(dealii::types::boundary_id boundary, const Parameters& parameters);

/// A matrix and columns of loads over the unknowns of some elements.
class Assembly {
 public:
  Assembly() = default;
  /// Sets all to 0.
  Assembly(const PatchElements& elements, int loads);

  /// Adds factor K to the matrix, and factor times the unit loads, combined by columns, to the loads.
  void add(const PatchElements& elements, const Parameters& parameters, double factor,
           const Eigen::Matrix3Xd& combination);
  /// To be called after the last add(). Collective.
  void finish();
  /// Frees the loads.
  void forget_loads() { loads_.clear(); }

  const dealii::TrilinosWrappers::SparseMatrix& stiffness() const { return stiffness_; }
  /// Loads, N, one in each column.
  Block loads() const;

 private:
  dealii::TrilinosWrappers::SparseMatrix stiffness_;
  std::vector<dealii::TrilinosWrappers::MPI::Vector> loads_;
};

}  // namespace cleft
