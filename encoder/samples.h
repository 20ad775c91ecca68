// The nodes of a snapshot as places in the field's parameter space.
#pragma once

#include <vector>

#include "encoder/field/field.h"
#include "solver/snapshot/snapshot.h"

namespace cleft {

/// The place of a datum: a position, and the side if it is on v = 0. With Side::both both sides have the
/// value.
struct Sample {
  Vec3 uvw;
  Side side;
};

/// One sample for each node, in node order. On v = 0 the side of a node comes from /cut/pairs; nodes there
/// without a partner are uncut.
std::vector<Sample> samples_of(const Snapshot& snapshot);

/// The same in the coordinates of the field: those of the cut where the snapshot has them.
std::vector<Sample> samples_in_field(const SnapshotReader& reader);

/// In space, of a displacement along the axes of the cut: nine numbers, the vectors u, v and w of its node.
inline Vec3 in_space(const Vec3& displacement, const double* axes) {
  const auto axis = [axes](int k) { return Vec3{axes[3 * k], axes[3 * k + 1], axes[3 * k + 2]}; };
  return displacement.x * axis(0) + displacement.y * axis(1) + displacement.z * axis(2);
}

}  // namespace cleft
