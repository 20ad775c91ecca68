// Which loads are solved for several cases of one K and one release, so that every case is a sum of them.
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "solver/patch_system.h"

namespace cleft {

inline constexpr int most_units = 3;  ///< series of unit prestresses: uu, vv, uv

/// The parameters skin.prestress_... of a direction.
inline constexpr const char* prestress_names[] = {"skin.prestress_u", "skin.prestress_v",
                                                  "skin.prestress_uv"};

/// With `by_units`, unit prestresses, of which the frames of every case are sums; with contact a series is
/// not linear, and the case is solved for itself. Without, every case's own load.
struct CaseLoads {
  /// `every_unit`: solve all three unit prestresses, whatever the cases need. Collective.
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
  std::vector<std::pair<std::size_t, std::size_t>> parts;  ///< ranges of the loads: each solved in one go
  std::vector<Case> cases;                                 ///< in the order in which they were given
};

}  // namespace cleft
