#include "benchmarks/elements/patch_nodes.h"

namespace cleft::elements {

PatchNodes::PatchNodes(const CutLines& cut_lines, Kind k)
    : lines(cut_lines),
      kind(k),
      size_{2 * static_cast<int>(lines.u.size()) - 1, 2 * static_cast<int>(lines.v.size()) - 1,
            2 * static_cast<int>(lines.w.size()) - 1},
      first_(static_cast<std::size_t>(size_[0]) * size_[1] * size_[2], -1) {
  dissect({0, 0, 0}, size_);
}

bool PatchNodes::is_open(const Place& p) const {
  return p[1] == 2 * lines.plane && p[0] > 2 * lines.first && p[0] < 2 * lines.last &&
         p[2] < 2 * lines.bottom;
}

bool PatchNodes::is_end(const Place& p) const {
  return p[1] == 2 * lines.plane && p[2] <= 2 * lines.bottom &&
         (p[0] == 2 * lines.first || p[0] == 2 * lines.last);
}

bool PatchNodes::is_front(const Place& p) const {
  return is_end(p) || (p[1] == 2 * lines.plane && p[2] == 2 * lines.bottom && p[0] >= 2 * lines.first &&
                       p[0] <= 2 * lines.last);
}

Vec3 PatchNodes::point(const Place& p) const {
  return {lines.u[p[0] / 2], lines.v[p[1] / 2], lines.w[p[2] / 2]};
}

bool PatchNodes::is_node(const Place& p) const {
  const bool between = p[0] % 2 != 0 || p[1] % 2 != 0, below = p[2] % 2 != 0;
  if (kind == Kind::linear || kind == Kind::enriched) return !between && !below;
  return !between || !below;
}

/// Halves a box across its longest side by a plane of corners, which comes after both halves.
void PatchNodes::dissect(const Place& from, const Place& to) {
  int axis = 0;
  for (const int a : {1, 2})
    if (to[a] - from[a] > to[axis] - from[axis]) axis = a;
  constexpr int smallest = 6;
  if (to[axis] - from[axis] <= smallest) return append(from, to);
  const int middle = (from[axis] + to[axis]) / 4 * 2;
  Place before = to, after = from, plane_from = from, plane_to = to;
  before[axis] = plane_from[axis] = middle;
  after[axis] = plane_to[axis] = middle + 1;
  dissect(from, before);
  dissect(after, to);
  append(plane_from, plane_to);
}

void PatchNodes::append(const Place& from, const Place& to) {
  for (int k = from[2]; k < to[2]; ++k)
    for (int j = from[1]; j < to[1]; ++j)
      for (int i = from[0]; i < to[0]; ++i) {
        const Place place = {i, j, k};
        if (!is_node(place)) continue;
        first_[index(place)] = count_;
        count_ += is_open(place) ? 2 : kind == Kind::enriched && is_front(place) ? 5 : 1;
      }
}

}  // namespace cleft::elements
