// The interface of solvers for the patch with its cut open as far as in a frame; one is direct, one
// iterative.
#pragma once

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "solver/patch_mesh.h"
#include "solver/patch_system.h"

namespace cleft {

/// An error of a solver, thrown on all ranks.
struct SolveError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A matrix is not positive definite.
struct IndefiniteError : SolveError {
  using SolveError::SolveError;
};

/// The remedy in messages about a matrix K that is not positive definite.
inline constexpr const char* cause_of_indefinite =
    "are the springs and moduli large enough, and the skin nowhere compressed?";

/// Runs `work` on rank 0; a std::runtime_error there becomes a SolveError on every rank. Collective.
void on_root(const PatchSystem& system, const std::function<void()>& work);

/// Holds the data that all frames share. Calls are collective over the system's ranks.
class FrameSolver {
 public:
  virtual ~FrameSolver() = default;

  /// Sets the order in which the cut opens. Discards the loads.
  virtual void set_release(const Release& release) = 0;

  /// Which columns may be solved in one block. The rounding of a factor's sums depends on the columns of the
  /// block: with `each`, the columns of a load are solved separately, so that their bits do not depend on the
  /// other loads.
  enum class Together { all, each };
  /// Sets the loads, one in each column, N.
  virtual void set_loads(Block loads, Together together = Together::all) = 0;

  /// A displacement to compute: under one of the loads, with the first `open` pairs of the release open; with
  /// contact their lips press on each other where they would overlap.
  struct Column {
    int load = 0, open = 0;
    bool contact = false;
    double residual = 1e-10;  ///< at which iterations stop, relative to the load
  };
  /// Solves K u + C^T v = f, C u = 0, mm, one displacement in each column. Columns in the order of a release
  /// are fastest.
  virtual Block solve(const std::vector<Column>& columns) = 0;

  /// Open pairs whose lips touch, by their places in the release, and their normal openings, mm.
  struct Touching {
    std::vector<int> places;
    Eigen::VectorXd openings;
  };
  /// A frame under a load of its own: pairs that touch have the openings that are given and slide, all others
  /// of the open ones are free.
  struct Frame {
    int open = 0;
    Touching touching = {};
  };
  /// The displacements under full loads, one for each frame, for half the work of set_loads() and solve().
  /// Discards the loads that are set. Iterations are for no pairs that touch.
  virtual Block solve_each(const Block& loads, const std::vector<Frame>& frames);
  Block solve_once(const Block& load, int open, const Touching& touching = {}) {
    return solve_each(load, {{open, touching}});
  }

  /// Iterations of every column solved so far; empty for a direct solver.
  virtual std::vector<int> iterations() const { return {}; }
};

/// The relative rounding error of a displacement: the difference between K^-1 K x and x for a translation x,
/// which only the springs resist. It is about the unit roundoff times the condition of K, which no residual
/// reveals. Needs a release and discards the loads. Collective; equal on all ranks.
double rounding_error(const PatchSystem& system, FrameSolver& solver);

enum class Method { automatic, direct, iterative };

/// The chosen solver and the reason.
struct ChosenSolver {
  std::unique_ptr<FrameSolver> solver;
  Method method;
  std::string reason;
  double expected_peak = 0;  ///< bytes that all ranks together will have held at most
};

/// Largest rounding_error for which results are accepted.
inline constexpr double largest_rounding = 1e-6;

/// Throws SolveError if the direct solver is chosen and its rounding_error is above the largest: a factor
/// balances the forces even if it has lost the displacement. (Iterations do not converge then.)
void check_rounding(const PatchSystem& system, const ChosenSolver& chosen);

/// Throws InputError if K of so many unknowns cannot be assembled in the memory of the machines. Collective.
void check_assembly_fits(std::size_t unknowns, MPI_Comm communicator);

/// Operations of a factorisation, a minute or two of a core, from which on iterations take less time.
inline constexpr double many_operations = 3e12;

/// Chooses the direct solver if its factor fits into memory and takes fewer operations than
/// `most_operations`, unless a method is given; of a body, if it fits. Throws InputError if the method does
/// not fit either. `progress` is called with the current step.
ChosenSolver make_frame_solver(const PatchMesh& mesh, const PatchSystem& system, Method method,
                               double most_operations,
                               const std::function<void(const std::string&)>& progress);

/// Factorises K once more, whose values have changed; the solver is a direct one.
void factorize_again(const PatchSystem& system, const ChosenSolver& chosen);

}  // namespace cleft
