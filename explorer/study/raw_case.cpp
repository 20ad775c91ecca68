#include "explorer/study/raw_case.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"

namespace cleft {

RawCase::RawCase(const std::string& snapshot, std::shared_ptr<const Field> field)
    : reader_(snapshot), field_(std::move(field)) {
  const Snapshot& s = reader_.snapshot();
  if (!field_->case_hash.empty() && !s.case_hash.empty() && field_->case_hash != s.case_hash)
    throw InputError(snapshot + " is the simulation of another case than the field");
  for (const Vec3& x : s.points) sides_.push_back(side_of(x.y));
  for (const auto& [left, right] : s.pairs) {
    sides_[left] = Side::left;
    sides_[right] = Side::right;
  }
  by_u_.resize(s.points.size());
  std::iota(by_u_.begin(), by_u_.end(), 0);
  std::stable_sort(by_u_.begin(), by_u_.end(), [&](int a, int b) { return s.points[a].x < s.points[b].x; });
}

std::size_t RawCase::nearest_frame(double t) const {
  const std::vector<double>& times = snapshot().times;
  const auto nearer = [t](double a, double b) { return std::abs(a - t) < std::abs(b - t); };
  return static_cast<std::size_t>(std::min_element(times.begin(), times.end(), nearer) - times.begin());
}

int RawCase::nearest_node(const Vec3& uvw, Side wanted) const {
  const std::vector<Vec3>& points = snapshot().points;
  const auto at = [&](std::ptrdiff_t k) { return static_cast<std::size_t>(by_u_[k]); };
  int nearest = -1;
  double least = HUGE_VAL;
  const auto look = [&](std::ptrdiff_t k) {  // false: no further node can be nearer
    const Vec3& x = points[at(k)];
    if (nearest >= 0 && std::abs(x.x - uvw.x) > least) return false;
    const Side side = sides_[at(k)];
    const bool other = wanted != Side::both && side != Side::both && side != wanted;
    if (const double distance = norm(x - uvw); !other && distance < least)
      least = distance, nearest = static_cast<int>(at(k));
    return true;
  };
  const auto count = static_cast<std::ptrdiff_t>(by_u_.size());
  const auto begin =
      std::lower_bound(by_u_.begin(), by_u_.end(), uvw.x, [&](int n, double u) { return points[n].x < u; });
  const std::ptrdiff_t middle = begin - by_u_.begin();
  for (std::ptrdiff_t k = middle; k < count && look(k); ++k) {
  }
  for (std::ptrdiff_t k = middle - 1; k >= 0 && look(k); --k) {
  }
  return nearest;
}

std::vector<int> RawCase::nodes_within(const Vec3& uvw, double radius) const {
  std::vector<int> nodes;
  const std::vector<Vec3>& points = snapshot().points;
  for (std::size_t n = 0; n < points.size(); ++n)
    if (norm(points[n] - uvw) <= radius) nodes.push_back(static_cast<int>(n));
  return nodes;
}

std::vector<Vec3> RawCase::rows_of(std::size_t frame, std::span<const int> nodes) const {
  constexpr int widest_gap = 4096;  // rows, a tenth of a chunk: read rather than left out
  std::vector<Vec3> rows;
  for (std::size_t i = 0; i < nodes.size();) {
    std::size_t end = i + 1;
    while (end < nodes.size() && nodes[end] - nodes[end - 1] <= widest_gap) ++end;
    const std::size_t first = nodes[i];
    const std::size_t count = static_cast<std::size_t>(nodes[end - 1]) - first + 1;
    const std::vector<Vec3> slab = reader_.displacement(frame, first, count);
    rows_read_ += count;
    for (; i < end; ++i) rows.push_back(slab[static_cast<std::size_t>(nodes[i]) - first]);
  }
  return rows;
}

std::vector<Vec3> RawCase::displacements(std::size_t frame, std::span<const int> nodes) const {
  std::vector<Vec3> now = rows_of(frame, nodes);
  const std::vector<Vec3> closed = rows_of(0, nodes);
  for (std::size_t i = 0; i < now.size(); ++i) now[i] = now[i] - closed[i];
  return now;
}

std::vector<double> RawCase::errors(std::size_t frame, std::span<const int> nodes) const {
  const std::vector<Vec3> raw = displacements(frame, nodes);
  const Snapshot& s = snapshot();
  std::vector<double> errors;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    errors.push_back(norm(raw[i] - field_->displacement(s.points[nodes[i]], side(nodes[i]), s.times[frame])));
  return errors;
}

}  // namespace cleft
