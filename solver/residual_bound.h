// How far displacements are from the solution of their case, bounded without solving it.
//
// Among the displacements that keep the closed pairs of a frame together, the error e of a displacement u
// satisfies K e = r = f - K u, so that its energy norm |e| = sqrt(e . K e) is that of the residual r in the
// dual norm: |e|^2 = r . K^-1 r. With another stiffness R of the same mesh, of which the factor is at hand
// and least R <= K <= greatest R (params/stiffness.h),
//
//     r . R^-1 r / greatest  <=  |e|^2  <=  r . R^-1 r / least .
//
// The right-hand side is the square of the bound, which is at most sqrt(greatest / least) times the error.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "params/stiffness.h"
#include "solver/frame_solver.h"
#include "solver/snapshot/snapshot.h"

namespace cleft {

/// Of a frame; energy norms, (N mm)^1/2.
struct FrameBound {
  double bound = 0;             ///< of the error
  double size = 0;              ///< of the displacement
  std::optional<double> error;  ///< by the solution, if it was asked for
};

struct SnapshotBound {
  StiffnessRatios ratios;  ///< of the case's stiffness to that of the reference
  double moved = 0;        ///< mm: by how much closed pairs were apart, which were put together
  std::vector<FrameBound> frames;
};

class ResidualBound {
 public:
  /// Assembles and factorises the stiffness of a case, which is the reference. Collective, as all calls.
  ResidualBound(const Parameters& reference, MPI_Comm communicator,
                const std::function<void(const std::string&)>& progress);

  /// Of the displacements of a snapshot, which are those of a patch of the reference's mesh with small
  /// strains and no contact: throws InputError with the remedy otherwise. `where` names the
  /// snapshot. With `solve` the case is solved too.
  SnapshotBound of(const SnapshotReader& reader, bool solve, const std::string& where);

 private:
  /// What is bounded.
  struct Work {
    const SnapshotReader& reader;
    const PatchSystem& system;
    const Release& release;
    const Block& load;
    FrameSolver* own;  ///< that solves the case; null if it is not to be solved
  };
  void add_frames(const Work& work, Eigen::Index first, Eigen::Index count, SnapshotBound& result);

  Parameters reference_;
  MPI_Comm communicator_;
  std::function<void(const std::string&)> progress_;
  PatchMesh mesh_;
  std::unique_ptr<PatchSystem> system_;
  ChosenSolver chosen_;
};

/// The parameters of a snapshot, if bounds apply to it; throws InputError as ResidualBound::of() does.
Parameters parameters_to_bound(const Snapshot& snapshot, const std::string& where);

}  // namespace cleft
