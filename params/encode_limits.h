// What can be asked of the encoder: a study is refused before it is solved, a command before it reads.
#pragma once

#include <array>
#include <string>

namespace cleft {

inline constexpr double least_tolerance = 1e-9;  ///< and less than 1

/// Control points along u, v (both sides together), w, t. Throws InputError "<where>: ..." where they are
/// fewer than the parametrisation's, or more than a summary may have.
void check_control_points(const std::array<int, 4>& counts, const std::string& parametrization,
                          const std::string& where);

}  // namespace cleft
