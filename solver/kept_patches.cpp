#include "solver/kept_patches.h"

#include "params/stiffness.h"

namespace cleft {

namespace {

constexpr std::size_t most_nodes = 20000;  // of a patch that is kept

}  // namespace

MeshedPatch::MeshedPatch(PatchMesh of, const Parameters& parameters, MPI_Comm communicator,
                         const Discretization& discretization, KeepElements keep)
    : mesh(std::move(of)), system(mesh, parameters, communicator, discretization, keep) {}

KeepElements KeptPatches::wants(const Parameters& parameters, const PatchMesh& mesh) const {
  return parameters.model == Model::small && mesh.points.size() <= most_nodes ? KeepElements::yes
                                                                              : KeepElements::no;
}

void KeptPatches::keep(const Parameters& parameters, std::shared_ptr<MeshedPatch> patch) {
  if (wants(parameters, patch->mesh) == KeepElements::yes && patch->chosen.method == Method::direct)
    patches_[pattern_key(parameters)] = std::move(patch);
}

std::shared_ptr<MeshedPatch> KeptPatches::reassembled(const Parameters& parameters) const {
  const auto found = patches_.find(pattern_key(parameters));
  if (found == patches_.end()) return nullptr;
  found->second->system.reassemble(parameters);
  return found->second;
}

}  // namespace cleft
