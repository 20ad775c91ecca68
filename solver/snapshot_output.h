// The snapshot of a case on its way, written by rank 0.
#pragma once

#include <mpi.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "params/parameters.h"
#include "solver/frame_figures.h"
#include "solver/patch_mesh.h"
#include "solver/snapshot/snapshot.h"

namespace cleft {

/// A case's snapshot without its frames.
Snapshot describe(const Parameters& parameters, const PatchMesh& mesh, const Release& release);

/// Takes its final name with finish(), and leaves nothing behind without it. Every rank makes the calls, and
/// none but rank 0 does anything in them: HDF5's own writing by all ranks hangs where a write fails on one.
/// What cannot be written is a std::runtime_error on one rank, and on several the end of them all, with exit
/// code 1.
class SnapshotOutput {
 public:
  SnapshotOutput(const std::string& out, Snapshot snapshot, const std::vector<SnapshotArray>& arrays,
                 MPI_Comm communicator);

  /// Of all nodes, in a frame, or 0 for an array that is the same in all.
  void write_vectors(const std::string& array, std::size_t frame, const std::vector<Vec3>& values);
  void write_scalars(const std::string& array, const std::vector<double>& values);
  /// Of the next frame.
  void add_figures(const FrameFigures& figures);
  std::size_t frames_with_figures() const { return snapshot_.smallest_gap.size(); }

  void finish();

 private:
  void on_root(const std::function<void()>& work);

  Snapshot snapshot_;  // but for the mesh, which is written at once
  MPI_Comm communicator_;
  std::optional<SnapshotWriter> writer_;  // rank 0
};

}  // namespace cleft
