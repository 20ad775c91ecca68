#include "encoder/break_ends.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "solver/snapshot/break_front.h"

namespace cleft {

namespace {

constexpr double far = std::numeric_limits<double>::infinity();

/// Of an arm of a break: whether others begin at its first and last u and at its lowest w
/// (encoder/field/field_source.h). There it is open to the end of the domain.
struct Joined {
  bool first = false, last = false, lowest = false;

  explicit Joined(const Snapshot& s) {
    if (!s.source || s.source->break_extent.size() < 8) return;
    const std::vector<double>& extent = s.source->break_extent;
    first = extent[4] != 0, last = extent[5] != 0, lowest = extent[6] != 0;
  }
};

/// Places at which the body is whole across v = 0: of nodes with cells on both sides of it, which no pair
/// that parts has (`divided`: -1, 1), and of closed pairs.
std::vector<Vec3> whole_across(const Snapshot& s, const std::vector<std::int8_t>& divided) {
  std::vector<std::array<bool, 2>> sides(s.points.size(), {false, false});
  for (std::size_t c = 0; c < s.cell_types.size(); ++c) {
    const auto first = s.connectivity.begin() + s.cell_offsets[c],
               last = s.connectivity.begin() + s.cell_offsets[c + 1];
    const double side =
        std::accumulate(first, last, 0., [&](double sum, std::int64_t n) { return sum + s.points[n].y; });
    if (side != 0) std::for_each(first, last, [&](std::int64_t n) { sides[n][side > 0] = true; });
  }
  for (const auto& [left, right] : s.pairs)
    for (const std::size_t side : {0, 1}) sides[left][side] = sides[left][side] || sides[right][side];
  std::vector<Vec3> places;
  for (std::size_t n = 0; n < sides.size(); ++n)
    if (divided[n] == 0 && sides[n][0] && sides[n][1]) places.push_back(s.points[n]);
  return places;
}

/// The largest u below `end` of pairs that part; `end` where there is none.
double column_before(const Snapshot& s, const std::vector<bool>& parted, double end) {
  double before = -far;
  for (std::size_t p = 0; p < parted.size(); ++p)
    if (const double u = s.points[s.pairs[p][0]].x; parted[p] && u < end) before = std::max(before, u);
  return before > -far ? before : end;
}

/// Moves the tip beyond `end`, where the body ends, from frame `leaves` on: as fast as it came, by a column
/// of pairs at least and by the length of the cut at most.
void leave_body(std::vector<double>& tip, std::size_t leaves, const std::vector<double>& times, double end,
                double column, double length) {
  if (leaves == 0) return;
  std::size_t from = 0;  // the last frame before the tip moves
  while (from + 1 < leaves && tip[from + 1] <= tip.front()) ++from;
  const std::size_t to = from + 1 < leaves ? leaves - 1 : leaves;
  const double speed = (tip[to] - tip[from]) / (times[to] - times[from]), last = tip[leaves - 1];
  for (std::size_t j = leaves; j < tip.size(); ++j)
    tip[j] = end + std::max(column, std::min(last + speed * (times[j] - times[leaves - 1]) - end, length));
}

}  // namespace

BreakEnds break_ends(const Snapshot& s, const std::vector<bool>& parted,
                     const std::array<Interval, 3>& domain) {
  BreakEnds ends{{s.cut_start, s.cut_length, s.cut_depth}, s.position};
  const std::size_t open = s.released.back();
  if (open == 0) return {{}, s.position};
  const double slack = 1e-6 * s.cut_length;
  std::vector<std::int8_t> sides(s.points.size(), 0);
  double first = far, last = -far, lowest = far, highest = -far;
  for (std::size_t p = 0; p < open; ++p) {
    if (!parted[p]) continue;
    sides[s.pairs[p][0]] = -1, sides[s.pairs[p][1]] = 1;
    const Vec3& at = s.points[s.pairs[p][0]];
    first = std::min(first, at.x), last = std::max(last, at.x);
    lowest = std::min(lowest, at.z), highest = std::max(highest, at.z);
  }
  if (last < first) return ends;  // none parts
  std::vector<bool> at_front = nodes_at_front(s.cell_offsets, s.connectivity, s.pairs, sides);
  if (s.cell_types.empty())  // nodes of v = 0 tell instead
    for (std::size_t n = 0; n < at_front.size(); ++n)
      at_front[n] = sides[n] == 0 && std::abs(s.points[n].y) <= slack;
  std::vector<Vec3> whole;
  for (std::size_t n = 0; n < at_front.size(); ++n)
    if (at_front[n]) whole.push_back(s.points[n]);
  const Joined joined(s);
  if (joined.last) std::erase_if(whole, [&](const Vec3& at) { return at.x > last - slack; });
  double before = -far, below = -far;
  for (const Vec3& at : whole) {
    const bool beside =
        at.z > lowest - slack && at.z<highest + slack, under = at.x> first - slack && at.x < last + slack;
    if (beside && at.x < first - slack) before = std::max(before, at.x);
    if (under && at.z < lowest - slack) below = std::max(below, at.z);
  }
  const bool imported = s.source && !s.cell_types.empty();
  std::vector<Vec3> beyond;  // the holes in which the break begins or ends, or beside it
  double below_hollow = -far;
  if (imported)
    for (const Vec3& at : whole_across(s, sides)) {
      if (lowest - slack < at.z && at.z < highest + slack && !(joined.last && at.x > last - slack))
        beyond.push_back(at);
      if (first - slack < at.x && at.x < last + slack && at.z < lowest - slack)
        below_hollow = std::max(below_hollow, at.z);
    }
  if (below == -far && below_hollow > -far) below = (lowest + below_hollow) / 2;  // where no node is
  if (before == -far)
    for (const Vec3& at : beyond)
      if (at.x < first - slack) before = std::max(before, at.x);
  if (joined.first) before = -far;
  if (joined.lowest) below = -far;
  if (imported || std::abs(ends.cut.start - first) <= slack) {
    const double end = ends.cut.start + ends.cut.length;
    ends.cut.start = before > -far ? before : domain[0].front;
    ends.cut.length = end - ends.cut.start;
  }
  if (imported || std::abs(ends.cut.depth + lowest) <= slack)
    ends.cut.depth = below > -far ? -below : -domain[2].front;
  const bool at_once = s.position.front() == s.position.back();
  if (!imported) {
    if (s.source && ends.cut.start != s.cut_start && !at_once) ends.tip.front() = ends.cut.start;
    return ends;
  }

  // The tip that is recorded stands at an open pair where all open at once, or where nothing is whole ahead.
  std::optional<std::size_t> leaves;
  double of_open = -far;
  for (std::size_t j = 0, p = 0; j < ends.tip.size(); ++j) {
    for (; p < (at_once ? open : static_cast<std::size_t>(s.released[j])); ++p)
      of_open = std::max(of_open, s.points[s.pairs[p][0]].x);
    double& tip = ends.tip[j];
    if (tip <= of_open + slack) {
      double ahead = far;
      for (const auto* places : {&whole, &beyond})
        if (ahead == far)
          for (const Vec3& at : *places)
            if (at.x > of_open + slack) ahead = std::min(ahead, at.x);
      if (ahead == far && !leaves) leaves = j;
      tip = ahead < far ? ahead : domain[0].back;
    }
    if (tip > domain[0].back - slack) tip = domain[0].back;
  }
  if (leaves && !at_once && !joined.last) {
    leave_body(ends.tip, *leaves, s.times, domain[0].back, last - column_before(s, parted, last - slack),
               last - first);
    ends.reach = ends.tip.back();
  }
  // Next to the edge of the domain there is no room for a front that comes from another arm.
  if (joined.first && first - domain[0].front < ends.cut.depth)
    for (double& tip : ends.tip) tip = std::max(tip, first);
  // A front grows with the blade from where the cut begins, and waits there while all is closed.
  if (!at_once && before > -far)
    for (std::size_t j = 0; j < ends.tip.size() && (j == 0 || s.released[j] == 0); ++j)
      ends.tip[j] = ends.cut.start;
  ends.cut.length = ends.tip.back() - ends.cut.start;
  return ends;
}

}  // namespace cleft
