// A sparse Cholesky factor of a matrix without a few chosen unknowns, and the Schur complement of these.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <exception>
#include <functional>
#include <memory>
#include <vector>

#include "solver/patch_system.h"

namespace cleft {

/// MUMPS, symmetric positive definite, distributed over the system's ranks. With `kept` unknowns c and the
/// rest i of a matrix K: schur() = K_cc - K_ci K_ii^-1 K_ic. Calls are collective. Throws std::runtime_error
/// with MUMPS's own codes where the matrix is not positive definite or memory runs out.
class CondensedFactor {
 public:
  /// Analyses only. `entries`: lower or upper triangle of the matrix, anywhere on the ranks; repeated ones
  /// are added. Its unknowns are those of the system, which also defines their ranks. `order`: position of
  /// each unknown in the elimination order, the kept ones last and in the order of `kept`; rank 0.
  CondensedFactor(const PatchSystem& system, PatchSystem::Entries entries, const std::vector<int>& kept,
                  const std::vector<int>& order);
  ~CondensedFactor();

  /// Another matrix with entries at the same places, which the analysis serves too. To be factorised anew.
  void replace(PatchSystem::Entries entries);

  double bytes_needed() const;  ///< by the factorisation on this rank, as estimated
  double operations() const;    ///< of the factorisation, on all ranks

  void factorize();
  const Eigen::MatrixXd& schur() const;  ///< in the order of `kept`; rank 0

  using SparseColumns = Eigen::SparseMatrix<double>;
  /// x_i = K_ii^-1 b_i for every column; rows of kept unknowns are 0. `right` is read on rank 0.
  Block solve(const SparseColumns& right);

  /// x = K^-1 b of dense columns, for the work of half of that: x_i and, between them, the kept unknowns.
  /// `find_kept` replaces b_c - K_ci K_ii^-1 b_i, in the order of `kept`, by x_c, on rank 0.
  Block solve(const Block& right, const std::function<void(Eigen::MatrixXd&)>& find_kept);

 private:
  class Redistribution;
  struct Mumps;
  std::unique_ptr<Mumps> mumps_;
  int exceptions_at_birth_ = std::uncaught_exceptions();
};

}  // namespace cleft
