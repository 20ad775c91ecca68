// The snapshot of a case on its way, written by all ranks.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "params/parameters.h"
#include "solver/frame_figures.h"
#include "solver/node_slabs.h"
#include "solver/patch_mesh.h"
#include "solver/snapshot/snapshot.h"

namespace cleft {

/// A case's snapshot without its frames.
Snapshot describe(const Parameters& parameters, const PatchMesh& mesh, const Release& release);

/// Takes its final name with finish(), and leaves nothing behind without it. Calls are collective. What
/// cannot be written is a std::runtime_error on one rank, and on several the end of them all, with exit
/// code 1.
class SnapshotOutput {
 public:
  SnapshotOutput(const std::string& out, Snapshot snapshot, const std::vector<SnapshotArray>& arrays,
                 const NodeSlabs& slabs, const PatchSystem& system);

  /// Of this rank's nodes.
  void write_vectors(const std::string& array, std::size_t frame, const std::vector<Vec3>& slab);
  /// Of all nodes, known on rank 0.
  void write_scalars(const std::string& array, std::vector<double> values);
  /// Of the next frame.
  void add_figures(const FrameFigures& figures);
  std::size_t frames_with_figures() const { return snapshot_.smallest_gap.size(); }

  void finish();

 private:
  Snapshot snapshot_;  // but for the mesh, which is written at once
  std::size_t nodes_;
  const NodeSlabs& slabs_;
  MPI_Comm communicator_;
  std::string name_;                      // of the unfinished file
  std::optional<SnapshotWriter> writer_;  // rank 0
  std::optional<SnapshotRows> rows_;
};

}  // namespace cleft
