// A decoded series as .vtu files, one for each frame, and their list; processes may share the frames.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/output_folder.h"
#include "encoder/import/decode_series.h"

namespace cleft {

/// OUT.pvd and OUT/frame_0000.vtu, ...: all of them, or nothing.
class DecodedVtu {
 public:
  /// Throws InputError if one of them exists or cannot be written.
  explicit DecodedVtu(const std::string& out);
  /// Temporary: where the frames are to be written.
  std::string folder() const;
  /// Writes the list, and moves all to where it belongs.
  void commit(const std::vector<double>& times);

 private:
  std::string name_;
  OutputFolder place_;
};

/// The frames first, first + step, ... of a series.
struct FramesInTurn {
  std::size_t first = 0, step = 1;
};

/// Writes these frames into DecodedVtu::folder().
void write_frames(const DecodedNodes& decoded, const SourceMesh& mesh, FramesInTurn turn,
                  const std::string& folder, const std::function<void(const std::string&)>& progress);

}  // namespace cleft
