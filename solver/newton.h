// The equilibrium of the open patch under finite strains, frame after frame, by Newton's method.
#pragma once

#include <memory>

#include "solver/direct_solver.h"
#include "solver/finite_patch.h"
#include "solver/frame_figures.h"
#include "solver/lip_contact.h"
#include "solver/prediction.h"
#include "solver/solve.h"

namespace cleft {

/// The linear system of a step is solved by conjugate gradients among the displacements that keep closed
/// pairs together, to a relative residual like that of the forces, so that convergence stays quadratic
/// (Dembo, Eisenstat and Steihaug 1982). The preconditioner is a frame's exact solution with a factor of an
/// earlier tangent, at first that of the reference state, later that of the last frame: it is made to see
/// that an equilibrium is stable. Where lips touch, each step is one among the displacements that keep them
/// together along their normals. Calls are collective.
class NewtonSolver {
 public:
  /// `reference`: a solver with the factor of the tangent at the reference state, which must live as long as
  /// this object, and whose loads are changed. `largest_load`: N, the unit of residuals. `contact`: whether
  /// lips press on each other where they would overlap.
  NewtonSolver(const PatchMesh& mesh, const PatchSystem& system, FinitePatch& patch, const Release& release,
               FrameSolver& reference, const FrameResidual& residual, double largest_load, bool contact);

  /// From the equilibrium of the frame before (frame 0: from the reference state), which is replaced. To be
  /// called for the frames in their order. If Newton's method does not converge, the forces that tie what the
  /// frame releases are taken away in smaller parts. Throws SolveError, which names frame, load and the
  /// element that has shrunk most.
  NewtonFrame solve(int frame, Block& displacement);

  /// How the equilibrium that solve() has found gives way to small forces, a column each: the solutions with
  /// its tangent. Throws SolveError if that is not positive definite.
  Block responses(int frame, const Block& displacement, const Block& forces);

  /// Forces out of balance at the last frame, but for what closed pairs transmit.
  Block left_over() const { return balance_.left_over + contact_.forces(balance_.left_over); }

 private:
  struct Direction {
    Block step;
    int iterations = 0;
    bool indefinite = false;
  };

  bool predict(int frame, const Block& start, Block& displacement);
  bool converge(int frame, const Block& tied, Block& displacement, NewtonFrame& report);
  bool close_gaps(int open, Block& displacement);
  Direction direction(const Block& force, int open, double enough);
  double line_search(const Block& step, const Block& tied, Block& displacement);
  double residual_of(int open, const Block& force, const Block& displacement) const;
  Block precondition(const Block& force, int open);
  FrameSolver& factor() { return has_factor_ ? *factor_ : reference_; }
  bool is_stable(int open, const Block& displacement);
  [[noreturn]] void fail(int frame, double fraction, const NewtonFrame& report) const;

  const PatchMesh& mesh_;
  const PatchSystem& system_;
  FinitePatch& patch_;
  const Release& release_;
  FrameSolver& reference_;
  const FrameResidual& residual_;
  double largest_load_;
  Prediction prediction_;
  LipContact contact_;
  Block before_;                          // the frame before the last
  std::unique_ptr<DirectSolver> factor_;  // of later tangents, one after another
  bool has_factor_ = false;               // whether it is that of a definite one
  bool saddle_ = false;                   // whether the frame has come to an equilibrium that is not stable
  FinitePatch::Balance balance_;          // at the displacement reached
};

}  // namespace cleft
