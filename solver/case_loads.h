// The loads that are solved for several cases of one K and one release, such that each case is a sum of them.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "solver/patch_system.h"

namespace cleft {

inline constexpr int most_units = 3;  ///< series of unit prestresses: uu, vv, uv

/// The parameters skin.prestress_... of a direction.
std::array<std::string, 3> prestress_names();

/// With `by_units` the loads are unit prestresses, and the frames of each case are sums; with contact a
/// series is not linear, and the case is solved separately. Without it the loads are those of the cases.
struct CaseLoads {
  /// `every_unit`: solve all three unit prestresses, even if the cases do not need them. Collective.
  CaseLoads(const PatchSystem& system, const std::vector<const Parameters*>& cases, bool by_units,
            bool every_unit);

  struct Case {
    Eigen::VectorXd share;    ///< of every load
    double largest_load = 0;  ///< N
    std::size_t part = 0;     ///< the part whose loads it is a sum of
  };

  bool by_units;
  Block loads;                                             ///< N, a column each
  std::vector<int> units;                                  ///< directions of the first loads
  std::vector<bool> contact;                               ///< by load
  std::vector<std::pair<std::size_t, std::size_t>> parts;  ///< ranges of the loads, each solved together
  std::vector<Case> cases;                                 ///< in the order in which they were given
};

}  // namespace cleft
