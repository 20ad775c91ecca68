// Stiffness K and load f of the open patch: every duplicated node free, no constraints.
#pragma once

#include <mpi.h>

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "params/parameters.h"
#include "solver/patch_mesh.h"

namespace dealii::TrilinosWrappers {
class SparseMatrix;
}

namespace cleft {

/// Assembled in parallel over the ranks of a communicator. Vectors and blocks of vectors live whole on rank 0
/// and are empty elsewhere; all calls are collective. Unknowns are numbered by deal.II: unknown(node, axis).
class PatchSystem {
 public:
  PatchSystem(const PatchMesh& mesh, const Parameters& parameters, MPI_Comm communicator);
  ~PatchSystem();

  MPI_Comm communicator() const;
  int size() const;                                              ///< number of unknowns, three a node
  int unknown(int node, int axis) const;                         ///< known on every rank
  const Eigen::VectorXd& load() const;                           ///< f, N; rank 0
  Eigen::MatrixXd multiply(const Eigen::MatrixXd& block) const;  ///< K block; rank 0

  /// Lower triangle of this rank's rows of K, 0-based.
  struct Entries {
    std::vector<int> row, column;
    std::vector<double> value;
  };
  Entries lower_triangle() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace cleft
