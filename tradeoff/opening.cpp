#include "tradeoff/opening.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/error.h"

namespace cleft {

namespace {

/// Number of the last of `values` that is not above x and not the last of all, and how far x is on the way to
/// the next one: 0 to 1.
std::pair<std::size_t, double> place_in(const std::vector<double>& values, double x) {
  const auto above = std::upper_bound(values.begin() + 1, values.end() - 1, x);
  const auto i = static_cast<std::size_t>(above - values.begin()) - 1;
  return {i, std::clamp((x - values[i]) / (values[i + 1] - values[i]), 0.0, 1.0)};
}

}  // namespace

Opening::Opening(const SnapshotReader& reader) : times_(reader.snapshot().times) {
  const Snapshot& s = reader.snapshot();
  const auto node_at = [&](int n) -> const Vec3& { return s.points[n]; };
  std::vector<std::array<std::int32_t, 2>> pairs;
  for (const auto& pair : s.pairs) {
    const Vec3& p = node_at(pair[0]);
    if (p.z == 0 && p.x > s.cut_start && p.x < s.cut_start + s.cut_length) pairs.push_back(pair);
    if (p.y != 0) throw InputError("the cut is not straight in v = 0: its opening cannot be compared");
  }
  if (pairs.empty() || times_.size() < 2) throw InputError("the cut opens no pair of nodes in the skin");
  std::sort(pairs.begin(), pairs.end(),
            [&](const auto& a, const auto& b) { return node_at(a[0]).x < node_at(b[0]).x; });
  along_ = {0};
  for (const auto& pair : pairs) along_.push_back(node_at(pair[0]).x - s.cut_start);
  along_.push_back(s.cut_length);
  jump_.resize(times_.size() * along_.size());
  std::vector<Vec3> closed;
  for (std::size_t j = 0; j < times_.size(); ++j) {
    const std::vector<Vec3> d = reader.displacement(j);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const Vec3 jump = d[pairs[i][1]] - d[pairs[i][0]];
      jump_[j * along_.size() + i + 1] = jump;
      largest_ = std::max(largest_, norm(jump));
    }
  }
}

/// Lips of a growing cut close as the square root of the distance from its ends, so what is divided by that
/// is smooth, and linear between nodes and frames.
Vec3 Opening::at(double s, double t) const {
  if (s <= 0 || s >= t) return {};
  const auto [j, y] = place_in(times_, t);
  Vec3 sum;
  double weights = 0;
  for (const auto& [frame, weight] : {std::pair{j, 1 - y}, std::pair{j + 1, y}})
    if (const std::optional<Vec3> shape = shape_at(frame, s)) sum += weight * *shape, weights += weight;
  return weights > 0 ? std::sqrt(s * (t - s)) / weights * sum : Vec3{};
}

std::optional<Vec3> Opening::shape_at(std::size_t frame, double s) const {
  const double t = times_[frame];
  std::size_t open = 0;  // nodes between the start and the tip
  while (open + 1 < along_.size() && along_[open + 1] < t) ++open;
  if (open == 0) return {};
  const auto shape = [&](std::size_t i) {
    return (1 / std::sqrt(along_[i] * (t - along_[i]))) * node(frame, i);
  };
  std::size_t i = 1;
  while (i + 1 < open && along_[i + 1] <= s) ++i;
  if (open == 1 || s <= along_[1]) return shape(1);
  const double x = std::clamp((s - along_[i]) / (along_[i + 1] - along_[i]), 0.0, 1.0);
  return (1 - x) * shape(i) + x * shape(i + 1);
}

Vec3 opening(const Field& field, double s, double t) {
  const Vec3 at{field.cut().start + s, 0, 0};
  return field.displacement(at, Side::right, t) - field.displacement(at, Side::left, t);
}

namespace {

template <class Difference>
double largest_of(const Opening& nodes, const Difference& difference) {
  double most = 0;
  for (std::size_t j = 0; j < nodes.times().size(); ++j)
    for (std::size_t i = 0; i < nodes.along().size(); ++i)
      most = std::max(most, norm(difference(nodes.along()[i], nodes.times()[j], nodes.node(j, i))));
  return most;
}

}  // namespace

double opening_error(const Opening& found, const Opening& truth) {
  return largest_of(found, [&](double s, double t, const Vec3& here) { return here - truth.at(s, t); }) /
         truth.largest();
}

double opening_error(const Field& found, const Opening& truth) {
  return largest_of(truth,
                    [&](double s, double t, const Vec3& here) { return opening(found, s, t) - here; }) /
         truth.largest();
}

}  // namespace cleft
