#include "explorer/wound/guard_passage.h"

#include <algorithm>
#include <cmath>

namespace cleft {

namespace {
/// Of the depth of the canonical cut: the field's displacements change quickly within this distance of the
/// tip.
constexpr double tip_part = 0.5;
/// At how many positions of the blade a triangle is looked at while the blade passes it; from one to the next
/// before and after, the distance from the tip grows by this factor: what lips differ by falls with it.
constexpr int looks_while = 6;
constexpr double further = 1.3;
/// Among moments that begin and end closer: as many times in rounds after the first.
constexpr double closer = 3;
/// Of the distance between two looks, by which those of the next round are beside them: never twice the same.
constexpr double golden = 0.6180339887498949;
/// mm: of the way through a triangle at least.
constexpr double least_way = 0.01;
/// mm after the blade has passed a corner, which then belongs to one lip.
constexpr double passed = 1e-9;
/// Where less than this is left of a triangle, the least is searched for, in so many thirds. Where more of it
/// changes between two positions, it is looked at between them, so many times.
constexpr double little = 0.6, much = 0.3;
constexpr int searches = 5, halves = 4;
}  // namespace

GuardPassage::GuardPassage(const Wound& wound, const std::vector<std::pair<int, double>>& vertices,
                           double step)
    : reached_(wound.reached()),
      near_(tip_part * wound.field.shape().cut().depth),
      way_(std::max(near_, step)) {
  const CutMesh& mesh = wound.incision->mesh();
  const ScalpelPath& path = wound.incision->path();
  std::vector<double> s(mesh.vertices().size(), -1);  // of those near the path
  for (const auto& [v, at] : vertices)
    if (norm(mesh.position(v) - path.at(at / wound.scale()).position) * wound.scale() < near_)
      s[static_cast<std::size_t>(v)] = std::max(0., at);
  for (std::size_t t = 0; t < mesh.triangles().size(); ++t) {
    if (!mesh.is_skin(static_cast<int>(t))) continue;
    const auto& corner = mesh.triangle(static_cast<int>(t)).vertex;
    Beside one{static_cast<int>(t), {}};
    for (const int v : corner)
      if (s[v] >= 0) one.s.push_back(s[v]);
    if (one.s.empty()) continue;
    std::sort(one.s.begin(), one.s.end());
    beside_.push_back(one);
  }
}

/// Positions of the blade at which a triangle is looked at, ascending: the closer the nearer it is.
std::vector<double> GuardPassage::looks(const Beside& one, int round) const {
  std::vector<double> all;
  const double first = one.s.front(), last = one.s.back();
  const auto add = [&](double s) {
    if (s > 0 && s < reached_) all.push_back(s);
  };
  const double shift = std::fmod(golden * round, 1), step = std::max(least_way, last - first) / looks_while;
  const int parts = round == 0 ? looks_while : static_cast<int>(closer * looks_while);
  const double factor = round == 0 ? further : std::pow(further, 1 / closer);
  for (int i = 0; i < parts; ++i) add(first + (last - first) * (i + shift) / parts);
  for (double way = step * std::pow(factor, shift); way < factor * way_; way *= factor) {
    add(first - std::min(way, way_));
    add(last + std::min(way, way_));
  }
  for (const double s : one.s) add(s), add(s + passed);
  std::sort(all.begin(), all.end());
  return all;
}

bool GuardPassage::look(const Beside& one, int round, const Left& left, const Tell& tell) const {
  struct Look {
    double s, left;
    bool held;
  };
  bool told = false;
  const auto at = [&](double s, double first, double last) {
    Look look{s, left(one.triangle, s), false};
    if (look.left != unsound) return look;
    tell(s, first, last);
    told = true;
    return Look{s, left(one.triangle, s), true};
  };
  const std::function<void(const Look&, const Look&, int)> between = [&](const Look& a, const Look& b,
                                                                         int n) {
    if (n == 0 || (!a.held && !b.held && std::abs(a.left - b.left) < much)) return;
    const double s = (a.s + b.s) / 2;
    const Look middle = at(s, (a.s + s) / 2, (s + b.s) / 2);
    between(a, middle, n - 1);
    between(middle, b, n - 1);
  };
  const std::vector<double> places = looks(one, round);
  std::vector<Look> found;
  std::size_t best = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double s = places[i];
    found.push_back(
        at(s, i > 0 ? (places[i - 1] + s) / 2 : s, i + 1 < places.size() ? (s + places[i + 1]) / 2 : s));
    if (i > 0) between(found[i - 1], found[i], halves);
    if (found[i].left < found[best].left) best = i;
  }
  if (found.empty() || found[best].left > little) return told;
  const auto before = std::lower_bound(places.begin(), places.end(), places[best] - 2 * passed),
             after = std::upper_bound(places.begin(), places.end(), places[best] + 2 * passed);
  for (auto [low, high] : {std::pair(before == places.begin() ? places[best] : before[-1], places[best]),
                           std::pair(places[best], after == places.end() ? places[best] : *after)}) {
    if (low == high) continue;
    for (int i = 0; i < searches; ++i) {
      const double a = low + (high - low) / 3, b = high - (high - low) / 3, at_a = left(one.triangle, a),
                   at_b = left(one.triangle, b);
      (at_a < at_b ? high : low) = at_a < at_b ? b : a;
    }
    at((low + high) / 2, low, high);
  }
  return told;
}

}  // namespace cleft
