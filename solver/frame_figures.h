// The accuracy of a frame: the residual of its forces, and the gaps across its cut.
#pragma once

#include <vector>

#include "solver/cut_nodes.h"
#include "solver/frame_solver.h"

namespace cleft {

struct FrameFigures {
  double smallest_gap =
      0;            ///< mm: least opening along the cut's normal over the open pairs; 0 if none is open
  double gape = 0;  ///< mm: largest such opening
  double residual_equilibrium = 0;  ///< largest residual force / largest load
  double residual_closure = 0;      ///< largest gap of a closed pair / largest displacement
};

/// What the figures of frames are computed from; linear in displacement and load, so that figures of combined
/// frames cost no product with K.
class FrameResidual {
 public:
  FrameResidual(const PatchMesh& mesh, const PatchSystem& system);

  /// The residual f - K u of each column. Collective.
  Block left_over(const Block& loads, const Block& displacements) const {
    return loads - system_.multiply(displacements);
  }

  /// Figures of columns with the given numbers of open pairs of a release, from their displacements, their
  /// residuals and the largest load. Collective; equal on all ranks.
  std::vector<FrameFigures> figures(const Release& release, const std::vector<FrameSolver::Column>& columns,
                                    const Block& displacements, const Block& left_over,
                                    double largest_load) const;

 private:
  FrameFigures at_cut(const Release& release, const FrameSolver::Column& column,
                      const Eigen::VectorXd& displacement, Eigen::VectorXd force) const;

  const PatchMesh& mesh_;
  const PatchSystem& system_;
  CutNodes cut_;
  std::vector<bool> in_face_;  // by node: in the middle of a face, without unknowns
};

}  // namespace cleft
