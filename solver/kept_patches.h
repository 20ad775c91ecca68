// Meshes with their elements, K and its solver, kept for cases that differ in K.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "solver/frame_solver.h"

namespace cleft {

/// A mesh, its K, and the solver with that.
struct MeshedPatch {
  /// Assembles K; has no solver yet.
  MeshedPatch(PatchMesh mesh, const Parameters& parameters, MPI_Comm communicator,
              const Discretization& discretization, KeepElements keep);

  PatchMesh mesh;
  PatchSystem system;
  ChosenSolver chosen;
};

/// Patches of the small model that are small enough to be kept, the last one of each mesh: another K of the
/// mesh needs neither elements nor an analysis, and comes out the same to the last bit.
class KeptPatches {
 public:
  /// Whether a patch is one of those, which needs its elements then.
  KeepElements wants(const Parameters& parameters, const PatchMesh& mesh) const;
  void keep(const Parameters& parameters, std::shared_ptr<MeshedPatch> patch);
  /// That of the mesh of these parameters, with their K, for which its solver is not yet factorised; null
  /// where there is none.
  std::shared_ptr<MeshedPatch> reassembled(const Parameters& parameters) const;

 private:
  std::map<std::string, std::shared_ptr<MeshedPatch>> patches_;  // by pattern_key
};

}  // namespace cleft
