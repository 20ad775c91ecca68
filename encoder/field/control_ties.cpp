#include "encoder/field/control_ties.h"

namespace cleft {

namespace {

/// Index of the control point that interpolates at `knot`, or -1 where the basis does not.
int interpolating(const BSplineBasis& basis, double knot) {
  for (int i = 0; i < basis.size(); ++i) {
    bool all = true;
    for (int k = 1; k <= basis.degree(); ++k) all = all && basis.knots()[i + k] == knot;
    if (all) return i;
  }
  return -1;
}

/// The right one of the two control points that meet in a knot of full multiplicity at 0; -1 where none do.
int right_of_break(const BSplineBasis& across) {
  const int right = across.evaluate(0, Limit::from_right).first;
  return across.evaluate(0, Limit::from_left).first + across.degree() < right ? right : -1;
}

}  // namespace

ControlTies::ControlTies(const std::array<BSplineBasis, 3>& bases, int open_first, int open_last,
                         int open_from) {
  const BSplineBasis& across = bases[1];
  const int V = across.size(), W = bases[2].size(), right = right_of_break(across), p = across.degree();
  // Slopes at the break: p (c[right] - c[left - 1]) / before and p (c[right + 1] - c[right]) / after.
  double of_left = 0, of_right = 0;
  if (right > 0) {
    const double before = across.knots()[right] - across.knots()[right - 1];
    const double after = across.knots()[right + p + 1] - across.knots()[right + p];
    of_left = after / (before + after), of_right = before / (before + after);
  }
  enum Kind { open, bottom, closed };
  for (const Kind kind : {open, closed}) {
    // Of the meeting control points at height k: those of the cut are free, at its bottom one value, else one
    // value and one slope.
    const auto at = [&](int k) {
      if (right < 0) return open;
      return kind == closed || k < open_from - 1 ? closed : k < open_from ? bottom : open;
    };
    Pattern& pattern = patterns_[kind == open ? 0 : 1];
    std::vector<int> numbers(static_cast<std::size_t>(V) * W, -1);
    for (int j = 0; j < V; ++j)
      for (int k = 0; k < W; ++k) {
        const bool meets = j == right || j == right - 1;
        if (!meets || at(k) == open || (at(k) == bottom && j == right - 1))
          numbers[j * W + k] = pattern.size++;
      }
    for (int j = 0; j < V; ++j)
      for (int k = 0; k < W; ++k) {
        const int itself = numbers[j * W + k] >= 0 ? numbers[j * W + k] : numbers[(right - 1) * W + k];
        if (itself >= 0)
          pattern.controls.push_back({{Term{itself, 1}, Term{}}, 1});
        else
          pattern.controls.push_back(
              {{Term{numbers[(right - 2) * W + k], of_left}, Term{numbers[(right + 1) * W + k], of_right}},
               2});
      }
  }
  first_ = {0};
  for (int i = 0; i < bases[0].size(); ++i) {
    kinds_.push_back(i >= open_first && i <= open_last ? 0 : 1);
    first_.push_back(first_.back() + patterns_[kinds_[i]].size);
  }
}

ControlTies ControlTies::following_tip(const std::array<BSplineBasis, 3>& bases) {
  const int start = interpolating(bases[0], 1), tip = interpolating(bases[0], 2),
            bottom = interpolating(bases[2], -1);
  const bool from_edge = bases[0].front() == 1, to_edge = bases[0].back() == 2,
             through = bases[2].front() == -1;
  return {bases, from_edge ? 0 : start + 1, to_edge ? bases[0].size() - 1 : tip - 1,
          through ? 0 : bottom + 1};
}

ControlTies ControlTies::none(const std::array<BSplineBasis, 3>& bases) {
  return {bases, 0, bases[0].size() - 1, 0};
}

}  // namespace cleft
