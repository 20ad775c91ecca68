// The snapshot of a case that is being solved, written by rank 0.
#pragma once

#include <mpi.h>

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "params/parameters/parameters.h"
#include "solver/body/body.h"
#include "solver/frame_figures.h"
#include "solver/patch_mesh.h"
#include "solver/snapshot/snapshot.h"

namespace cleft {

/// A case's snapshot without its frames. `body`: null for a patch.
Snapshot describe(const Parameters& parameters, const PatchMesh& mesh, const Release& release,
                  const Body* body);

/// The file gets its final name by finish(); without finish() no file remains. All ranks make the calls, and
/// only rank 0 writes, because HDF5's collective writing hangs if a write fails on one rank. A failed write
/// is a std::runtime_error on one rank, and ends all of several ranks with exit code 1.
class SnapshotOutput {
 public:
  SnapshotOutput(const std::string& out, Snapshot snapshot, const std::vector<SnapshotArray>& arrays,
                 MPI_Comm communicator);

  /// Values of all nodes in a frame; frame 0 for an array that is constant.
  void write_vectors(const std::string& array, std::size_t frame, const std::vector<Vec3>& values);
  void write_scalars(const std::string& array, const std::vector<double>& values);
  /// Three vectors for each node, of an array that is constant.
  void write_frames(const std::string& array, const std::vector<std::array<Vec3, 3>>& values);
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
