// Nodes at the same place.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include "encoder/import/series.h"

namespace cleft {

using Groups = std::vector<std::vector<std::int32_t>>;

/// Sets of numbers from 0 on, joined one by one.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }
  std::int32_t root(std::int32_t i) {
    while (parent_[i] != i) {
      auto& up = parent_[i];
      i = up = parent_[up];
    }
    return i;
  }
  /// The lowest number is the root.
  void join(std::int32_t a, std::int32_t b) {
    a = root(a), b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::int32_t> parent_;
};

/// Groups of two or more points closer than `tolerance` to another of the group; each ascending, by their
/// first.
Groups coincident_groups(const std::vector<Vec3>& points, double tolerance);

/// Whether the mesh is unwelded: (nearly) each cell has its own nodes, so that most nodes have coincident
/// ones.
bool is_unwelded(const SourceMesh& mesh, const Groups& groups);

/// Merges coincident nodes whose values agree in all fields and frames, up to rounding. Returns the number of
/// nodes that were removed.
std::size_t weld(ImportedSeries& series, const Groups& groups);

}  // namespace cleft
