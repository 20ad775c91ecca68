#include "solver/unsolved.h"

#include "solver/patch_mesh.h"
#include "solver/snapshot_output.h"

namespace cleft {

void write_unsolved(const Parameters& parameters, const std::string& out, MPI_Comm communicator) {
  const PatchMesh mesh = make_patch_mesh(parameters);
  const Release release = make_release(mesh, parameters);
  Snapshot snapshot = describe(parameters, mesh, release, nullptr);
  snapshot.case_hash.clear();
  std::vector<SnapshotArray> arrays;
  if (snapshot.coordinates) arrays = {canonical_array, frame_array};
  SnapshotOutput output(out, std::move(snapshot), arrays, communicator);
  if (!arrays.empty())
    output.write_vectors(canonical_array.name, 0, mesh.canonical),
        output.write_frames(frame_array.name, mesh.frames);
  for (std::size_t frame = 0; frame < release.released.size(); ++frame)
    output.add_figures({.residual_equilibrium = frame == 0 ? 0. : 1.});
  output.finish();
}

}  // namespace cleft
