// Where the next frame of a growing cut will be, from the last two.
#pragma once

#include <vector>

#include "solver/patch_mesh.h"
#include "solver/patch_system.h"

namespace cleft {

/// Far from its ends a cut grows in nearly the same way from column to column: what has changed in the last
/// frame changes one column further on in the next.
class Prediction {
 public:
  /// Keeps references to all.
  Prediction(const PatchMesh& mesh, const PatchSystem& system, const Release& release);

  /// Whether this frame releases the column behind which the frame before released one. Never in a body.
  bool possible(int frame) const;

  /// The displacement of a frame from those of the two before it. Where the frame opens a part of a column,
  /// or a branch leaves, pairs that are still closed may part. Collective.
  Block predict(const Block& before_last, const Block& last) const;

 private:
  int column(int pair) const;

  const PatchMesh& mesh_;
  const PatchSystem& system_;
  const Release& release_;
  std::vector<int> base_;    // by node: the node of the grid at its place
  std::vector<int> behind_;  // by node: the one on the same lip, a column behind it along u
};

}  // namespace cleft
