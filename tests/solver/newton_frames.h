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

/// A case's frames by Newton's method, with all that it needs.
class NewtonCase {
 public:
  NewtonCase(const DensePatch& patch, const Parameters& p)
      : solver_(patch.mesh, patch.system),
        residual_(patch.mesh, patch.system),
        finite_(patch.system, p),
        newton_(patch.mesh, patch.system, finite_, patch.release, factorized(patch), residual_,
                patch.load.cwiseAbs().maxCoeff(), p.cut.contact) {}

  NewtonFrame solve(int frame, Block& displacement) { return newton_.solve(frame, displacement); }

 private:
  DirectSolver& factorized(const DensePatch& patch) {
    solver_.factorize();
    solver_.set_release(patch.release);
    return solver_;
  }

  DirectSolver solver_;
  FrameResidual residual_;
  FinitePatch finite_;
  NewtonSolver newton_;
};

/// The first frame of a case, from any displacement.
inline Block newton_from(const DensePatch& patch, const Parameters& p, Block displacement,
                         NewtonFrame* report = nullptr) {
  const NewtonFrame found = NewtonCase(patch, p).solve(0, displacement);
  if (report) *report = found;
  return displacement;
}

/// All frames of a case.
inline std::vector<Block> newton_frames(const DensePatch& patch, const Parameters& p,
                                        std::vector<NewtonFrame>* reports = nullptr) {
  NewtonCase all(patch, p);
  Block u = Block::Zero(patch.system.owned(), 1);
  std::vector<Block> frames;
  for (int frame = 0; frame < static_cast<int>(patch.release.released.size()); ++frame) {
    const NewtonFrame report = all.solve(frame, u);
    if (reports) reports->push_back(report);
    frames.push_back(u);
  }
  return frames;
}

}  // namespace cleft
