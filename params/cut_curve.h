// The curve of a cut in the plane of its patch.
#pragma once

#include <array>
#include <vector>

#include "params/parameters/parameters.h"

namespace cleft {

/// A curve whose curvature changes linearly along it (a clothoid; an arc, or a straight line), from -half to
/// half a length on either side of its middle, and the straight lines that continue it. Its middle is the
/// origin, where it goes along the first axis. Exact to rounding.
class CutCurve {
 public:
  /// The cut as the mesh has it (params/meshed_cut.h).
  explicit CutCurve(const Parameters& parameters);

  struct Place {
    double x, y, direction;  ///< mm; radians against the first axis

    /// Another place, along the curve's direction here and to its left, mm.
    std::array<double, 2> seen(double of_x, double of_y) const;
  };

  bool is_straight() const { return curvature_ == 0 && rate_ == 0; }
  double half_length() const { return half_; }
  /// At u mm from the middle.
  Place operator()(double u) const;
  /// All (u, v) from which a place of the plane is seen at a right angle: v is the distance from u of the
  /// curve, positive toward its left, mm. The nearest one first. Of two that are nearer to each other than a
  /// hundredth of the length both may be missing, as they are next to where normals meet.
  std::vector<std::array<double, 2>> feet(double x, double y) const;

 private:
  Place from(const Place& start, double u, double length) const;
  double foot_between(double from, double to, bool ahead_at_from, double x, double y) const;

  double curvature_, rate_, half_, step_;
  std::vector<Place> nodes_;  // at even distances
};

}  // namespace cleft
