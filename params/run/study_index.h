// What is known of a study's published cases at a glance. The manifests are the truth; the index is made from
// them, and made again wherever it differs from what stands on disk.
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace cleft {

/// Of a published case, from its manifest.
struct IndexedCase {
  std::int64_t stamp = 0;  ///< when its manifest was written, ns; another one: the case is another
  std::uint64_t manifest_bytes = 0;
  std::string solve;                                      ///< identity of what the solver saw
  double seconds = 0, bytes = 0, nodes = 0, columns = 0;  ///< what it cost, and how large it is; 0: unknown
  double memory = 0;                                      ///< most bytes the solver held
  double node_error = 0, largest_displacement = 0;        ///< of its field (mm); 0: unknown
  bool snapshot = true;                                   ///< whether its raw data were kept
};

/// By the case's hash. Reads DIR/index.json and the manifests of those cases that it lacks or that have
/// changed since; a case whose manifest is damaged is left out, and cleft check says so. Where the folder can
/// be written, what was found anew is kept.
std::map<std::string, IndexedCase> study_index(const std::string& study);

}  // namespace cleft
