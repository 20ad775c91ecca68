// From another program's time series to a snapshot.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "encoder/import/placement.h"
#include "solver/snapshot/snapshot.h"

namespace cleft {

struct ImportOptions {
  std::string series, out;
  std::vector<std::string> fields;         ///< SOURCE[:NAME]
  std::optional<std::string> break_plane;  ///< nx,ny,nz,offset, or "none"; nothing: found
  Box box = Box::smaller;
  std::vector<std::string> parameters =
      {};  ///< NAME=VALUE: what the series does not tell of skin, tissue and load
};

struct ImportReport {
  Snapshot snapshot;                  ///< as written
  std::vector<SnapshotArray> arrays;  ///< beside the displacement
  bool has_displacement = false;
  std::vector<std::string> notes;  ///< what was welded, left or not found
};

/// Writes a snapshot, whole or not at all. Throws InputError where the series, its fields or the break are
/// not as they must be.
ImportReport import_series(const ImportOptions& options,
                           const std::function<void(const std::string&)>& progress);

}  // namespace cleft
