// What solves the patch with its cut open as far as in a frame: directly, or by iterations.
#pragma once

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "solver/patch_mesh.h"
#include "solver/patch_system.h"

namespace cleft {

/// What went wrong in a solve, thrown on all ranks alike.
struct SolveError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What to look at where K is not positive definite.
inline constexpr const char* cause_of_indefinite =
    "are the springs and moduli large enough, and the skin nowhere compressed?";

/// Runs `work` on rank 0; a std::runtime_error there becomes a SolveError on every rank. Collective.
void on_root(const PatchSystem& system, const std::function<void()>& work);

/// Keeps what all frames share. Calls are collective over the system's ranks.
class FrameSolver {
 public:
  virtual ~FrameSolver() = default;

  /// How the cut opens from here on. Forgets the loads.
  virtual void set_release(const Release& release) = 0;

  /// Which columns may be solved in one block. How a factor's sums are rounded depends on what stands in a
  /// block: with `each`, the columns of a load are solved by themselves, and come out the same, bit for bit,
  /// whatever else there is.
  enum class Together { all, each };
  /// The loads to solve for, a column each, N.
  virtual void set_loads(Block loads, Together together = Together::all) = 0;

  /// A displacement to be found: under one of the loads, with the first pairs of the release open; with
  /// contact their lips press on each other where they would overlap.
  struct Column {
    int load = 0, open = 0;
    bool contact = false;
    double residual = 1e-10;  ///< where iterations may end, relative to the load
  };
  /// K u + C^T v = f, C u = 0, a column each. Columns in the order of a release are the quickest.
  virtual Block solve(const std::vector<Column>& columns) = 0;

  /// Iterations of every column solved so far; empty for a direct solver.
  virtual std::vector<int> iterations() const { return {}; }
};

/// What rounding makes of a displacement, relative: how far K^-1 K x is from x, a translation, which only the
/// springs resist. It is the unit roundoff times the condition of K or so, which no residual tells. Needs a
/// release, and forgets the loads. Collective; the same on every rank.
double rounding_error(const PatchSystem& system, FrameSolver& solver);

enum class Method { automatic, direct, iterative };

/// What was chosen, and why.
struct ChosenSolver {
  std::unique_ptr<FrameSolver> solver;
  Method method;
  std::string reason;
};

/// Beyond it the numbers mean nothing.
inline constexpr double largest_rounding = 1e-6;

/// A factor balances the forces however little of the displacement is left in it: throws SolveError where
/// that is the chosen solver and its rounding_error above the largest. Iterations do not balance them then.
void check_rounding(const PatchSystem& system, const ChosenSolver& chosen);

/// Takes the direct solver where its factor fits into memory, unless a method is forced. Throws InputError
/// where what is left does not fit. `progress` is told what is being done.
ChosenSolver make_frame_solver(const PatchMesh& mesh, const PatchSystem& system, Method method,
                               const std::function<void(const std::string&)>& progress);

}  // namespace cleft
