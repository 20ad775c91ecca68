// All cases of one K: the mesh, the system and its factor are made once.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "solver/compliance.h"
#include "solver/frame_figures.h"
#include "solver/kept_patches.h"
#include "solver/phases.h"
#include "solver/solve.h"

namespace cleft {

/// The arguments of solve_cases(), and its reports.
struct SolveJob {
  const std::vector<CaseToSolve>& cases;
  const SolveOptions& options;
  MPI_Comm communicator;
  const std::function<void(const std::string&)>& progress;
  std::vector<SolveReport>& reports;
};

class SharedStiffness {
 public:
  /// `members`: numbers of the job's cases of this K. Keeps a reference to the job. Collective, as all calls.
  /// `kept`: patches of earlier ones on the mesh, for which this one's is kept too; null where it is the only
  /// one.
  SharedStiffness(SolveJob& job, const std::vector<std::size_t>& members, KeptPatches* kept);

  /// Solves members whose cut opens in the same order, and writes their snapshots. Throws SolveError.
  void solve(const std::vector<std::size_t>& members);

  SolveJob& job() { return job_; }
  Phases& phases() { return phases_; }
  const PatchMesh& mesh() const { return patch_->mesh; }
  const PatchSystem& system() const { return patch_->system; }
  const FrameResidual& residual() const { return *residual_; }
  const ChosenSolver& chosen() const { return patch_->chosen; }
  const Compliance& compliance() const {
    return compliance_;
  }  ///< valid once solve() has begun; if has_compliance()

 private:
  void make_patch(const std::vector<std::size_t>& members, const Parameters& parameters);
  /// The error of mesh and patch, of members whose cut opens in the same order.
  void estimate(const std::vector<std::size_t>& members);

  SolveJob& job_;
  Phases phases_;
  KeptPatches* kept_;
  std::shared_ptr<MeshedPatch> patch_;
  std::optional<FrameResidual> residual_;
  bool checked_ = false;  // whether the factor was found to be exact enough
  Compliance compliance_;
};

}  // namespace cleft
