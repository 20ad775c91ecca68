// The patch under finite strains (total Lagrangian): forces out of balance and tangent at a displacement.
#pragma once

#include <Eigen/Core>
#include <memory>

#include "base/vec3.h"
#include "params/parameters/parameters.h"
#include "solver/patch_mesh.h"
#include "solver/patch_system.h"

namespace cleft {

/// Tissue, skin and springs from the reference state, in which the skin is under its prestress. The loads are
/// dead: what the surroundings pull at the reference state, which is what the patch's own forces there lack
/// of the system's load. All calls are collective; blocks and numbers of unknowns are those of the system.
class FinitePatch {
 public:
  /// Keeps a reference to the system, whose mesh, division and load it has.
  FinitePatch(const PatchSystem& system, const Parameters& parameters);
  ~FinitePatch();

  /// With the first `open` pairs of a release open: across the cut the skin resists bending where it is
  /// closed, before the first call nowhere.
  void set_open(const Release& release, int open);

  /// The element whose volume has shrunk most: the least determinant of the deformation gradient.
  struct LeastElement {
    double determinant;
    Vec3 place;  ///< its centroid in the reference state, mm
  };
  struct Balance {
    Block left_over;       ///< loads less the patch's own forces, N: a column
    double energy = 0;     ///< elastic energy less the work of the loads, N mm
    LeastElement least{};  ///< equal on all ranks; at most 0: the forces mean nothing
  };
  Balance balance(const Block& displacement) const;

  /// Computes the tangent at a displacement.
  void set_tangent(const Block& displacement);
  Block multiply(const Block& block) const;
  /// Its lower triangle, this rank's rows.
  PatchSystem::Entries lower_triangle() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace cleft
