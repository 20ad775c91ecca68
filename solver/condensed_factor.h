// A sparse Cholesky factor of K that keeps a few chosen unknowns: their Schur complement comes with the
// factor.
#pragma once

#include <Eigen/Core>
#include <exception>
#include <memory>
#include <vector>

#include "solver/patch_system.h"

namespace cleft {

/// MUMPS, symmetric positive definite, distributed over the system's ranks. With `kept` unknowns c and the
/// rest i: schur() = K_cc - K_ci K_ii^-1 K_ic. Blocks live on rank 0; all calls are collective. Throws
/// std::runtime_error with MUMPS's own codes where K is not positive definite or memory runs out.
class CondensedFactor {
 public:
  /// `order`: position of every unknown in the order of elimination, the kept ones last, as in `kept`.
  CondensedFactor(const PatchSystem& system, const std::vector<int>& kept, const std::vector<int>& order);
  ~CondensedFactor();

  const Eigen::MatrixXd& schur() const;  ///< in the order of `kept`; rank 0

  /// Solves K_ii x_i = b_i for every column of `block` (unknowns by rows) in place; rows of kept unknowns
  /// become 0.
  void solve(Eigen::MatrixXd& block);

 private:
  struct Mumps;
  std::unique_ptr<Mumps> mumps_;
  int exceptions_at_birth_ = std::uncaught_exceptions();
};

}  // namespace cleft
