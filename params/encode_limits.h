// Limits of the encoder's options, checked before a study is solved and before a command reads files.
#pragma once

#include <array>
#include <string>

namespace cleft {

inline constexpr double least_tolerance = 1e-9;                              ///< and less than 1
inline constexpr double least_pack_error = 1e-4, greatest_pack_error = 0.1;  ///< of cleft pack --modes

inline constexpr double least_regularisation = 1e-10, greatest_regularisation = 0.1;

/// Throws InputError "<where>: ..." if it is outside these.
void check_regularisation(double strength, const std::string& where);

/// Control points along u, v (both sides together), w, t. Throws InputError "<where>: ..." if they are fewer
/// than the parametrisation needs, or too many.
void check_control_points(const std::array<int, 4>& counts, const std::string& parametrization,
                          const std::string& where);

}  // namespace cleft
