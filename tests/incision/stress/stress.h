// Random cuts through a mesh, with every invariant looked at after every step.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "explorer/incision/surface_mesh.h"
#include "tests/incision/stress/random_path.h"

namespace cleft::stress {

struct Tally {
  long paths = 0, refused = 0, violations = 0, steps = 0, crossings = 0, undone = 0;
  double worst_quality = 1;      ///< of new triangles over what the issue asks for: at least 1 is asked
  double worst_lip_length = 0;   ///< relative error of the lip's length, to the blade's way over the surface
  double worst_area = 0;         ///< relative change of the skin where nothing was moved
  long poor = 0, long_lips = 0;  ///< paths beyond what the issue asks for
  long squeezed = 0;             ///< poor ones between the cut and the outline or another cut that it grazes
  long jumping = 0;  ///< whose blade's way over the surface jumps: lips without a length to compare
  long due = 0;      ///< refused paths that asked for what no blade can do (refusals.h)
  std::map<std::string, long> reasons;        ///< of the other refusals, without their numbers
  std::map<std::string, long> due_reasons;    ///< of those
  std::vector<std::string> first_violations;  ///< with what makes them again
  std::vector<std::string> listed;            ///< what came of paths that were refused or left poor triangles
  std::array<long, path_kinds> paths_of{}, refused_of{}, poor_of{};
  void add(const Tally& other);
};

using Clock = std::chrono::steady_clock;

struct Plan {
  std::uint64_t seed = 1;
  long paths = 100;
  Clock::time_point until = Clock::time_point::max();
  bool good = true;        ///< the mesh: poor triangles and lips of another length are violations
  int cuts_at_once = 3;    ///< up to so many cuts lie in the mesh before all are undone
  std::vector<long> only;  ///< paths to cut, with those that are in the mesh at once; none: all
  bool list = false;       ///< every path that was refused, or left poor triangles or lips of another length
};

/// `sound`: whether the mesh came as an oriented manifold.
Tally stress(const std::string& name, const SurfaceMesh& surface, const Plan& plan);

}  // namespace cleft::stress
