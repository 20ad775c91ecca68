// A mesh with cuts that open as each case of a study says, for a page: positions sampled over the length cut,
// as sums of modes that the cases have in common.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "explorer/wound/wound_surface.h"

namespace cleft {

/// All lengths in mm.
struct MeshMotion {
  WoundSurface surface;
  double duration = 0;  ///< the length of all cuts
  /// The lips of a cut: pairs of points, their places along its path, and where on all paths it begins.
  struct Cut {
    std::vector<int> left, right;
    std::vector<double> places;
    double begin = 0;
  };
  std::vector<Cut> cuts;
  int cases = 0;
  /// The points of case i when t is cut.
  std::function<void(int i, double t, std::vector<Vec3>& points)> positions;
  std::string note;  ///< for the reader: what the cases stand for, how far they are off
};

struct MeshMotionData {
  std::string json;                               ///< docs/formats.md
  std::vector<std::vector<std::uint8_t>> pieces;  ///< as json says
  std::vector<double> gapes, largest;             ///< of each case, mm: widest opening, and displacement
  int modes = 0;
  double error = 0;  ///< of the modes at the sampled lengths, at most, over the largest displacement
};

/// Throws InputError if it would not fit into memory.
MeshMotionData mesh_motion_data(const MeshMotion& motion, const std::function<void(int i)>& report);

}  // namespace cleft
