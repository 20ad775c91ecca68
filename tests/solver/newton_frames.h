// Frames of a small patch under finite strains, by Newton's method.
#pragma once

#include <vector>

#include "solver/newton.h"
#include "tests/solver/dense_patch.h"

namespace cleft {

inline Parameters finite_case() {
  Parameters p = dense_patch_case();
  p.model = Model::finite;
  p.skin.initial_stress_stiffness =
      true;  // of the system, whose K is then the tangent at the reference state
  return p;
}

/// All frames of a case.
inline std::vector<Block> newton_frames(const DensePatch& patch, const Parameters& p,
                                        std::vector<NewtonFrame>* reports = nullptr) {
  DirectSolver solver(patch.mesh, patch.system);
  solver.factorize();
  solver.set_release(patch.release);
  const FrameResidual residual(patch.mesh, patch.system);
  FinitePatch finite(patch.system, p);
  NewtonSolver newton(patch.mesh, patch.system, finite, patch.release, solver, residual,
                      patch.load.cwiseAbs().maxCoeff(), p.cut.contact);
  Block u = Block::Zero(patch.system.owned(), 1);
  std::vector<Block> frames;
  for (int frame = 0; frame < static_cast<int>(patch.release.released.size()); ++frame) {
    const NewtonFrame report = newton.solve(frame, u);
    if (reports) reports->push_back(report);
    frames.push_back(u);
  }
  return frames;
}

}  // namespace cleft
