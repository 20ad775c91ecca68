// Random cuts through a mesh, opened, and what that does to the skin.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "explorer/wound/cut_fields.h"
#include "tests/incision/stress/random_path.h"
#include "tests/incision/stress/subjects.h"
#include "tests/wound/stress/opened.h"

namespace cleft::stress {

struct OpeningPlan {
  std::uint64_t seed = 1;
  long cuts = 100;
  int positions = 5, cuts_at_once = 3;     ///< of the blade; in the mesh
  double least_edge = 0.7, most_edge = 4;  ///< mm: the mesh is scaled so that its mean edge is between
  std::vector<long> only;                  ///< these cuts, with those in the mesh at once; none: all
  bool list = false;
  bool crossing = false;  ///< groups are pairs of cuts that cross, in a mesh that is in mm as it is
};

/// Cuts made one after the other in one mesh and opened together count as one group.
struct OpeningTally {
  long cuts = 0, refused = 0, groups = 0, unsound = 0;
  double slowest = 0;  ///< s of the processor, of a group
  Opened sum;
  std::array<long, path_kinds> of{}, unsound_of{};  ///< by the kind of a group's last path
  std::vector<std::string> listed;                  ///< groups that are unsound, or take more than 10 s of it
  void add(const OpeningTally& other);
};

/// The fields of one group of cuts. Those of a family follow a tension along the group's first path.
using FieldsOfGroup = std::function<CutFields()>;

/// `limits` are those of the fields, but for a family.
OpeningTally open_random_cuts(const Subject& subject, const FieldsOfGroup& fields, const FieldLimits& limits,
                              const OpeningPlan& plan);

}  // namespace cleft::stress
