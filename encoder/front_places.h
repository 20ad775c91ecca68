// Where within the elements a front stands, by how far the break is open behind it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "encoder/samples.h"
#include "encoder/stored_frames.h"

namespace cleft {

/// The break of a series: pairs of samples in the order in which they open, how many are open in each frame,
/// and the displacements.
struct OpenPairs {
  const std::vector<Sample>& samples;
  const std::vector<std::array<std::int32_t, 2>>& pairs;
  const std::vector<std::int32_t>& released;
  const StoredFrames<3>& frames;
  bool round = false;  ///< whether u is the distance from the middle of a round front
};

/// Nodes tell only between which two columns a front is: `tip`, of each frame, is the first closed column.
/// Where the break opens as the root of the distance from its front (Williams 1957), as its squares over u
/// tell by being on a line, the front is where that line is 0: between the last open column and the first
/// closed one. Around a round front the squares are over those of u (Sneddon 1946). Other frames,
/// in which few columns are open or they open in another way, keep their tip.
void place_fronts(std::vector<double>& tip, const OpenPairs& open);

}  // namespace cleft
