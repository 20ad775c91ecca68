// What an encoding needs, told before it begins.
#pragma once

#include <string>

#include "solver/snapshot/snapshot.h"

namespace cleft {

/// Samples that a fit uses, about, of snapshots with more: fitted_nodes.h.
inline constexpr std::size_t most_fitted = 1000000;

struct MemoryNeed {
  double values = 0;  ///< bytes of all fields at all nodes and frames: in memory, or in a temporary file
  double others = 0;  ///< bytes of all else, at most: the mesh, what splines leave at nodes, the fit
  double nodes = 0, frames = 0, components = 0;
  bool spilled = false;  ///< whether the values are in a file

  double in_memory() const;
  /// Lets the values go to a file in `folder` where they do not fit into so many bytes of memory. Throws
  /// InputError about `path`, with what is needed and what helps, if not even that fits, or the disk there is
  /// too full.
  void fit_into(double memory, const std::string& folder, const std::string& path);
};

MemoryNeed memory_need(const SnapshotReader& reader);
/// Of two pieces of one body.
MemoryNeed operator+(const MemoryNeed& a, const MemoryNeed& b);

/// "1.2 GB"
std::string gigabytes(double bytes);

}  // namespace cleft
