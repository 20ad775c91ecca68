// Which control points are unknowns, and which follow from others because the tissue is uncut.
#pragma once

#include <array>
#include <vector>

#include "encoder/field/bspline.h"

namespace cleft {

/// The control points of one row across and in height, (j, k), as combinations of at most two unknowns each.
///
/// Where tissue is uncut, the two control points that meet in v = 0 are the mean of their neighbours weighted
/// by the knots: the sides agree there, bit for bit, and so do their slopes, up to the start and the tip.
/// Along the bottom of the cut, which is hidden, the displacement may have a cusp across v = 0: the two are
/// one unknown.
class ControlTies {
 public:
  struct Term {
    int unknown = 0;    ///< within the row of its index along the cut
    double weight = 0;  ///
  };
  struct Control {
    std::array<Term, 2> term;
    int terms;  ///< 1 (an unknown itself, weight 1) or 2
  };
  using Row = std::vector<Control>;  ///< by j W + k

  /// Bases over along, across and height of a parametrisation that follows the tip: `along` interpolates at 1
  /// and 2 (or begins or ends there), `height` at -1 (or begins there), `across` is broken at 0. Control
  /// points between those of 1 and 2 and above that of -1 belong to the cut.
  static ControlTies following_tip(const std::array<BSplineBasis, 3>& bases);
  /// Each control point is an unknown.
  static ControlTies none(const std::array<BSplineBasis, 3>& bases);

  int rows() const { return static_cast<int>(kinds_.size()); }     ///< along the cut
  int size() const { return first_.back(); }                       ///< unknowns in all
  int first(int i) const { return first_[i]; }                     ///< unknown of the row; of rows(): size()
  int row_size(int i) const { return first_[i + 1] - first_[i]; }  ///<
  const Row& row(int i) const { return patterns_[kinds_[i]].controls; }  ///<

 private:
  struct Pattern {
    Row controls;
    int size = 0;
  };
  ControlTies(const std::array<BSplineBasis, 3>& bases, int open_first, int open_last, int open_from);

  std::array<Pattern, 2> patterns_;  // along the cut, and beyond its ends
  std::vector<int> kinds_;           // of every row: which pattern
  std::vector<int> first_;
};

}  // namespace cleft
