// The time series of a growing cut, for the price of about one solve.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "solver/condensed_factor.h"
#include "solver/opening.h"
#include "solver/patch_mesh.h"
#include "solver/patch_system.h"

namespace cleft {

/// The figures of one frame.
struct FrameFigures {
  double smallest_gap = 0;  ///< mm: least opening along v over the released pairs; 0 where none is released
  double residual_equilibrium = 0;  ///< largest force left over, / largest load
  double residual_closure = 0;      ///< largest gap of a closed pair / largest displacement
};

/// Keeps the factorisation and the dense problem of the cut. Calls are collective over the system's ranks.
class CutSeries {
 public:
  CutSeries(const PatchMesh& mesh, const PatchSystem& system);

  /// Displacements of the frames first .. first + count - 1 on rank 0: unknowns by rows, a column a frame.
  Eigen::MatrixXd frames(int first, int count);

  /// Figures of the same frames, on rank 0.
  std::vector<FrameFigures> figures(int first, const Eigen::MatrixXd& frames) const;

 private:
  const PatchMesh& mesh_;
  const PatchSystem& system_;
  std::vector<int> cut_unknowns_;  // left ones, then right ones, in release order
  CondensedFactor factor_;
  Opening opening_;
};

}  // namespace cleft
