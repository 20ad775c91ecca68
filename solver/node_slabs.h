// Displacements by node, as files want them, from unknowns as the solver owns them.
#pragma once

#include <vector>

#include "base/vec3.h"
#include "solver/patch_system.h"

namespace cleft {

/// Every rank takes a run of consecutive nodes of the mesh. Calls are collective.
class NodeSlabs {
 public:
  NodeSlabs(const PatchSystem& system, std::size_t nodes);

  std::size_t first() const { return first_; }
  std::size_t count() const {
    return count_;
  }  ///< this rank takes the nodes first() .. first() + count() - 1

  /// One column of unknowns (owned() entries) as displacements of this rank's nodes.
  std::vector<Vec3> operator()(const double* column) const;

 private:
  const PatchSystem& system_;
  std::size_t first_, count_;
  std::vector<int> send_order_;      // local unknowns, by receiving rank
  std::vector<int> receive_places_;  // 3 node + axis, from first_
  std::vector<int> send_counts_, send_starts_, receive_counts_, receive_starts_;
};

}  // namespace cleft
