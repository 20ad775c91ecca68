// Lines along which a skin is pulled more than across them, as Langer's lines, at places on it.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/vec3.h"

namespace cleft {

/// The direction of the skin's larger tension at a place, both in the mesh's space; mm.
struct TensionLine {
  Vec3 place, direction;
};

/// The sine of the angle, about one degree, between the skin's normal and a line that stands upright on it:
/// rounding of the mesh would decide its direction within the skin.
inline constexpr double upright_line = 0.02;

/// Twice the angle, radians, by which the mean of the lines at a place is turned from the first of two unit
/// vectors within the skin toward the second: the mean of their doubled angles, as a line has no head, by the
/// squares of their inverse distances. Lines that stand upright on the skin count little. None where there is
/// nothing left of them.
std::optional<double> twice_angle_of(const std::vector<TensionLine>& lines,
                                     const std::array<Vec3, 2>& directions, const Vec3& place);

/// Of a CSV file with columns x,y,z,dx,dy,dz, in a mesh's units, of which `scale` is the length in mm. Throws
/// FileError if there is none, or one without a direction.
std::vector<TensionLine> read_tension_lines(const std::string& file, double scale);

}  // namespace cleft
