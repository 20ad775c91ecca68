#include "solver/multigrid/doubled_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"

namespace cleft {

DoubledGrid::DoubledGrid(std::array<std::vector<double>, 3> places, std::vector<Pair> pairs,
                         const std::vector<std::array<int, 6>>& wedges)
    : places_(std::move(places)), pairs_(std::move(pairs)) {
  for (int axis = 0; axis < 3; ++axis) size_[axis] = static_cast<int>(places_[axis].size());
  place_of_right_.assign(pairs_.size(), -1), pair_of_right_.assign(pairs_.size(), -1);
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    const int right = pairs_[p].right - single_nodes();
    place_of_right_[right] = place(pairs_[p].left), pair_of_right_[right] = static_cast<int>(p);
    const int here = place_of_right_[right];
    seen_[here] = {here, here, here, here};
  }
  for (const auto& wedge : wedges) {
    std::array<Index, 6> at;
    Index least{std::numeric_limits<int>::max(), std::numeric_limits<int>::max(), 0};
    bool at_cut = false;
    for (int c = 0; c < 6; ++c) {
      at[c] = index(wedge[c]);
      for (int axis = 0; axis < 2; ++axis) least[axis] = std::min(least[axis], at[c][axis]);
      at_cut = at_cut || wedge[c] >= single_nodes() || seen_.count(wedge[c]) > 0;
    }
    if (!at_cut) continue;
    for (int c = 0; c < 6; ++c)
      if (const auto found = seen_.find(number(at[c])); found != seen_.end())
        found->second[(least[0] == at[c][0] ? 1 : 0) + (least[1] == at[c][1] ? 2 : 0)] = wedge[c];
  }
  add_kept_lines();
}

DoubledGrid::Index DoubledGrid::index(int node) const {
  const int at = place(node);
  return {at % size_[0], at / size_[0] % size_[1], at / size_[0] / size_[1]};
}

int DoubledGrid::seen(int place, int side) const {
  const auto found = seen_.find(place);
  return found == seen_.end() ? place : found->second[side];
}

int DoubledGrid::side_of(int node) const {
  const auto found = seen_.find(place(node));
  if (found == seen_.end()) return 0;
  return static_cast<int>(std::find(found->second.begin(), found->second.end(), node) -
                          found->second.begin()) %
         4;
}

/// A line is kept where a place is doubled and a neighbour along the axis is not, or is so in another way.
void DoubledGrid::add_kept_lines() {
  for (int axis = 0; axis < 3; ++axis) kept_[axis].assign(size_[axis], false);
  // Whether copies differ across u and across v.
  const auto kind = [&](const Index& at) {
    const int here = number(at);
    const bool across_u = seen(here, 0) != seen(here, 1) || seen(here, 2) != seen(here, 3);
    const bool across_v = seen(here, 0) != seen(here, 2) || seen(here, 1) != seen(here, 3);
    return std::pair(across_u, across_v);
  };
  for (const auto& [here, sides] : seen_) {
    const Index at = index(here);
    const auto own = kind(at);
    for (int axis = 0; axis < 3; ++axis)
      for (const int step : {-1, 1}) {
        Index next = at;
        next[axis] += step;
        if (next[axis] < 0 || next[axis] >= size_[axis]) continue;
        const auto other = kind(next);
        if (other == own) continue;
        // The cut is in this line, or goes along the axis and ends.
        const bool across = axis == 0 ? own.first : axis == 1 && own.second;
        const bool along = axis == 0 ? own.second : axis == 2 || own.first;
        if (across) kept_[axis][at[axis]] = true;
        if (along && other == std::pair(false, false)) kept_[axis][next[axis]] = true;
      }
  }
}

GridLines DoubledGrid::finest() const {
  GridLines lines;
  for (int axis = 0; axis < 3; ++axis)
    for (int line = 0; line < size_[axis]; ++line) lines[axis].push_back(line);
  return lines;
}

GridLines DoubledGrid::coarser(const GridLines& lines, double longest) const {
  GridLines coarse;
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<int>& of = lines[axis];
    const std::vector<double>& at = places_[axis];
    const std::size_t last = of.size() - 1;
    coarse[axis] = {of[0]};
    for (std::size_t i = 0; i < last;) {
      const bool join =
          i + 2 <= last && !kept_[axis][of[i + 1]] && std::abs(at[of[i + 2]] - at[of[i]]) <= longest;
      i += join ? 2 : 1;
      coarse[axis].push_back(of[i]);
    }
  }
  return coarse;
}

std::size_t DoubledGrid::count(const GridLines& lines) const {
  std::size_t count = lines[0].size() * lines[1].size() * lines[2].size();
  for (const Pair& pair : pairs_) count += has(lines, pair.right);
  return count;
}

bool DoubledGrid::has(const GridLines& lines, int node) const {
  const Index at = index(node);
  for (int axis = 0; axis < 3; ++axis)
    if (!std::binary_search(lines[axis].begin(), lines[axis].end(), at[axis])) return false;
  return true;
}

double DoubledGrid::shortest(const GridLines& lines) const {
  double least = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis)
    for (std::size_t i = 0; i + 1 < lines[axis].size(); ++i)
      least = std::min(least, std::abs(places_[axis][lines[axis][i + 1]] - places_[axis][lines[axis][i]]));
  return least;
}

DoubledGrid::Interpolation::Interpolation(const DoubledGrid& grid, const GridLines& coarse) : grid_(grid) {
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<double>& at = grid.places_[axis];
    for (int line = 0; line < grid.size_[axis]; ++line) {
      const auto upper = std::lower_bound(coarse[axis].begin(), coarse[axis].end(), line);
      if (*upper == line) {
        brackets_[axis].push_back({line, line, 0});
        continue;
      }
      const int below = *std::prev(upper), above = *upper;
      brackets_[axis].push_back({below, above, (at[line] - at[below]) / (at[above] - at[below])});
    }
  }
}

void DoubledGrid::Interpolation::shares(int node, std::vector<Share>& shares) const {
  shares.clear();
  const int side = grid_.side_of(node);
  const Index at = grid_.index(node);
  std::array<const Bracket*, 3> along;
  for (int axis = 0; axis < 3; ++axis) along[axis] = &brackets_[axis][at[axis]];
  for (int corner = 0; corner < 8; ++corner) {
    Index to;
    double share = 1;
    int from = 0;  // the side of the corner on which the node is
    bool twice = false;
    for (int axis = 0; axis < 3; ++axis) {
      const Bracket& bracket = *along[axis];
      const bool upper = (corner >> axis) % 2 == 1, on_line = bracket.lower == bracket.upper;
      twice = twice || (upper && on_line);
      to[axis] = upper ? bracket.upper : bracket.lower;
      if (!on_line) share *= upper ? bracket.share : 1 - bracket.share;
      if (axis < 2 && (on_line ? (side >> axis) % 2 == 1 : !upper)) from += 1 << axis;
    }
    if (!twice) shares.emplace_back(grid_.seen(grid_.number(to), from), share);
  }
}

std::vector<int> DoubledGrid::pairs_between(int a, int b) const {
  const auto up = [&](int node) {
    std::vector<int> pairs;
    for (int pair = pair_of(node); pair >= 0; pair = pair_of(pairs_[pair].left)) pairs.push_back(pair);
    return pairs;
  };
  std::vector<int> of_a = up(a), of_b = up(b);
  while (!of_a.empty() && !of_b.empty() && of_a.back() == of_b.back()) of_a.pop_back(), of_b.pop_back();
  of_a.insert(of_a.end(), of_b.begin(), of_b.end());
  return of_a;
}

std::vector<int> DoubledGrid::opens_after(const std::vector<int>& finer, const GridLines& fine,
                                          const GridLines& coarse) const {
  std::vector<int> after(finer);
  const Interpolation interpolation(*this, coarse);
  std::vector<Share> left, right;
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    if (!has(fine, pairs_[p].left) || has(coarse, pairs_[p].left)) continue;
    interpolation.shares(pairs_[p].left, left);
    interpolation.shares(pairs_[p].right, right);
    for (std::size_t s = 0; s < left.size(); ++s)
      for (const int pair : pairs_between(left[s].first, right[s].first))
        after[pair] = std::max(after[pair], finer[p]);
  }
  return after;
}

std::vector<int> DoubledGrid::copies(int node) const {
  const auto found = seen_.find(place(node));
  if (found == seen_.end()) return {node};
  std::vector<int> list(found->second.begin(), found->second.end());
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
  return list;
}

}  // namespace cleft
