// From another program's time series to a snapshot.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/ranks/ranks.h"
#include "encoder/import/placement.h"
#include "solver/snapshot/snapshot.h"

namespace cleft {

struct ImportOptions {
  std::string series, out;
  std::vector<std::string> fields;         ///< SOURCE[:NAME]
  std::optional<std::string> break_plane;  ///< nx,ny,nz,offset, or "none"; nothing: found
  Box box = Box::smaller;
  std::vector<std::string> parameters =
      {};  ///< NAME=VALUE: parameters of skin, tissue and load, which the series does not hold
  std::optional<std::string> open_at = {};    ///< jump above which a pair is open; nothing: found
  std::vector<std::string> more_series = {};  ///< with further fields of the same mesh at the same times
};

struct ImportReport {
  Snapshot snapshot;                  ///< as written
  std::vector<SnapshotArray> arrays;  ///< besides the displacement
  bool has_displacement = false;
  std::vector<std::string> notes;  ///< messages: nodes that were merged or left, data that were not found
};

/// Writes a snapshot, completely or not at all. `ranks`: read the frames in turn (SeriesOnRanks). Throws
/// InputError if the series, its fields or the break do not satisfy the requirements.
ImportReport import_series(const ImportOptions& options,
                           const std::function<void(const std::string&)>& progress,
                           const Ranks* ranks = nullptr);

}  // namespace cleft
