#include "explorer/body/body_lips.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "base/stations.h"

namespace cleft {

namespace {

constexpr double furthest_end = 2;                   // mm: of a body's end from that of the mesh
constexpr double furthest_pass = 0.3;                // mm: of a body's crossing from that of the mesh
constexpr double least_loop = 2;                     // mm: of a path that comes back to where it was
constexpr double least_reach = 1.5, most_reach = 2;  // of a shift, in its lengths: it folds nothing

}  // namespace

std::vector<int> first_at_place(const Body& body) {
  std::vector<int> first(body.points.size());
  std::iota(first.begin(), first.end(), 0);
  for (const BodyPair& pair : body.pairs) first[pair.right] = first[pair.left];
  return first;
}

BodyLips::BodyLips(const Body& body, int number, const Incision& cut, double scale) : scale_(scale) {
  const double half = scale * cut.path().length() / 2;
  const std::vector<int> place = first_at_place(body);
  std::map<int, int> pairs_at;
  for (const BodyPair& pair : body.pairs) ++pairs_at[place[pair.left]];
  for (const BodyPair& pair : body.pairs) {
    if (pair.cut != number || pair.depth > 0) continue;
    if (std::abs(pair.along) > half * (1 - 1e-9)) continue;  // those beyond the ends are said to be there
    const double s = pair.along + half;
    const bool reversed = dot(pair.normal, cut.path().at(s / scale).across) < 0;
    stations_[s] = {reversed ? pair.right : pair.left, reversed ? pair.left : pair.right,
                    body.points[pair.left], pairs_at[place[pair.left]] == 1};
  }
  add_earlier_passes(cut);
  for (const Incision::ChainVertex& c : cut.chain()) {
    const auto after = stations_.lower_bound(scale * c.s);
    if (after == stations_.begin() || after == stations_.end()) continue;
    const auto before = std::prev(after);
    const double part = (scale * c.s - before->first) / (after->first - before->first);
    s_.push_back(c.s);
    offset_.push_back(before->second.at + part * (after->second.at - before->second.at) -
                      scale * cut.mesh().position(c.left));
  }
}

/// Where a path crosses itself the pairs tell of its last pass alone.
void BodyLips::add_earlier_passes(const Incision& cut) {
  std::map<double, Station> earlier;
  for (const auto& [s, station] : stations_) {
    if (station.alone) continue;
    double nearest = furthest_pass, at = 0;
    for (const Incision::ChainVertex& c : cut.chain())
      if (const double apart = norm(scale_ * cut.mesh().position(c.left) - station.at);
          std::abs(scale_ * c.s - s) > least_loop && apart < nearest)
        nearest = apart, at = scale_ * c.s;
    if (nearest < furthest_pass) earlier.emplace(at, station);
  }
  stations_.merge(earlier);
}

int BodyLips::node(double s, bool right) const {
  if (stations_.empty()) return -1;
  auto at = stations_.lower_bound(scale_ * s);
  if (at == stations_.end() ||
      (at != stations_.begin() && scale_ * s - std::prev(at)->first < at->first - scale_ * s))
    --at;
  const Station& station = at->second;
  return !station.alone ? -1 : right ? station.right : station.left;
}

Vec3 BodyLips::offset(double s) const {
  if (s_.empty()) return {};
  const auto [a, b, part] = between(s_, s);
  return lerp(offset_[a], offset_[b], part);
}

EndShift::EndShift(const Body& body, const std::vector<const Incision*>& cuts, double scale) {
  std::map<int, std::set<int>> next;  // of nodes on lips, over the skin
  for (const BodyPair& pair : body.pairs) next[pair.left], next[pair.right];
  for (const auto& t : body.skin)
    for (const int a : t)
      if (const auto lip = next.find(a); lip != next.end()) lip->second.insert(t.begin(), t.end());
  for (const BodyPair& pair : body.pairs) {
    const auto& chain = cuts[pair.cut]->chain();
    if (pair.depth > 0 || chain.empty()) continue;
    const Vec3 end =
        scale * cuts[pair.cut]->mesh().position((pair.along < 0 ? chain.front() : chain.back()).left);
    for (const int n : next[pair.left]) {
      if (!next[pair.right].contains(n) || next.contains(n)) continue;  // no closed node between the lips
      const Vec3 by = body.points[n] - end;
      double reach = most_reach * norm(by);  // not to where another cut is
      for (const BodyPair& other : body.pairs)
        if (other.cut != pair.cut) reach = std::min(reach, norm(body.points[other.left] - end));
      if (norm(by) < furthest_end && reach > least_reach * norm(by)) ends_.push_back({end, by, reach});
    }
  }
}

double EndShift::reach() const {
  double most = 0;
  for (const End& end : ends_) most = std::max(most, end.reach);
  return most;
}

Vec3 EndShift::at(const Vec3& x) const {
  Vec3 sum;
  for (const auto& [end, by, reach] : ends_) sum += std::max(0., 1 - norm(x - end) / reach) * by;
  return sum;
}

}  // namespace cleft
