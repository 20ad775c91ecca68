// Dots and lines with colours that are drawn over a scene, without VTK.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/vec3.h"
#include "explorer/incision/scalpel_path.h"
#include "explorer/study/raw_case.h"

namespace cleft {

using Ink = std::array<double, 3>;  ///< red, green, blue, 0 to 1
inline Ink between(const Ink& a, const Ink& b, double part) {
  Ink ink;
  for (std::size_t i = 0; i < 3; ++i) ink[i] = a[i] + part * (b[i] - a[i]);
  return ink;
}

struct Overlay {
  struct Dot {
    Vec3 place;
    Ink ink;
  };
  struct Line {
    std::vector<Vec3> places;
    Ink ink;
  };
  std::vector<Dot> dots;
  std::vector<Line> lines;
  std::vector<Dot> handles;  ///< small balls that can be dragged
  double surface_opacity = 1;
  bool in_front = false;  ///< drawn in front of the surface
  std::string caption;
  /// The scale of the dots' colours, from 0 to `largest`.
  struct Scale {
    std::string title;
    double largest;
    Ink none, most;
  };
  std::optional<Scale> scale;

  bool empty() const { return dots.empty() && lines.empty() && handles.empty() && caption.empty(); }
};

/// The simulation's nodes within `radius` mm of a place, displaced as in the frame nearest to t, coloured by
/// the local error of the field: from pale to dark at the largest.
Overlay nodes_around(const RawCase& raw, const Vec3& place, double radius, double t);

/// The mesh of the skin, and the pairs of nodes on the cut: closed by a constraint, or released.
Overlay constraints_at(const RawCase& raw, double t);

/// The lattice of the four-variate spline at t: the lines of its knots on the skin and on both walls of the
/// plane of the cut, displaced by the field.
Overlay lattice_at(const Field& field, double t);

/// The incision parametrisation volume along a path, as wide and deep as the field's patch, and the blade in
/// it when s mm are cut. Lengths in mm.
Overlay volume_along(const ScalpelPath& path, const Field& field, double s);

}  // namespace cleft
