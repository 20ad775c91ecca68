#include "explorer/wound/guard_passage.h"

#include <algorithm>
#include <cmath>

namespace cleft {

namespace {
/// Of the depth of the canonical cut: the field's displacements change quickly within this distance of the
/// tip.
constexpr double tip_part = 0.5;
/// At how many positions of the blade a triangle is looked at, while the blade passes it and within the
/// distance from the tip before and after.
constexpr int looks_while = 6, looks_beside = 5;
/// Where less than this is left of a triangle, the least is searched for, in so many thirds.
constexpr double little = 0.6;
constexpr int searches = 5;
}  // namespace

GuardPassage::GuardPassage(const Wound& wound, const std::vector<std::pair<int, double>>& vertices)
    : reached_(wound.reached()), near_(tip_part * wound.field.shape().cut().depth) {
  const CutMesh& mesh = wound.incision->mesh();
  const ScalpelPath& path = wound.incision->path();
  std::vector<double> s(mesh.vertices().size(), -1);  // of those near the path
  for (const auto& [v, at] : vertices)
    if (norm(mesh.position(v) - path.at(at / wound.scale()).position) * wound.scale() < near_)
      s[static_cast<std::size_t>(v)] = std::max(0., at);
  for (std::size_t t = 0; t < mesh.triangles().size(); ++t) {
    if (!mesh.is_skin(static_cast<int>(t))) continue;
    const auto& corner = mesh.triangle(static_cast<int>(t)).vertex;
    const double a = s[corner[0]], b = s[corner[1]], c = s[corner[2]];
    if (std::min({a, b, c}) < 0) continue;
    beside_.push_back({static_cast<int>(t), std::min({a, b, c}), std::max({a, b, c})});
  }
}

/// Positions of the blade at which a triangle is looked at, ascending: the closer the nearer it is.
std::vector<double> GuardPassage::looks(const Beside& one) const {
  std::vector<double> all;
  const auto add = [&](double s) {
    if (s > 0 && s <= reached_) all.push_back(s);
  };
  const auto way = [&](int i) { return near_ * i * i / (looks_beside * looks_beside); };
  for (int i = looks_beside; i >= 1; --i) add(one.first - way(i));
  for (int i = 0; i <= looks_while; ++i) add(one.first + (one.last - one.first) * i / looks_while);
  for (int i = 1; i <= looks_beside; ++i) add(one.last + way(i));
  return all;
}

/// A position of the blade at which the triangle is not sound: one of the looks, or, where little is left of
/// it, between the look with the least and those next to it.
std::optional<double> GuardPassage::least(const Left& left, int triangle, const std::vector<double>& looks) {
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < looks.size(); ++i) {
    const double now = left(triangle, looks[i]);
    if (now == unsound) return looks[i];
    if (now < least) least = now, best = i;
  }
  if (looks.empty() || least > little) return std::nullopt;
  for (const std::size_t next : {best, best + 1}) {
    if (next == 0 || next == looks.size()) continue;
    double low = looks[next - 1], high = looks[next];
    for (int i = 0; i < searches; ++i) {
      const double a = low + (high - low) / 3, b = high - (high - low) / 3, at_a = left(triangle, a),
                   at_b = left(triangle, b);
      if (at_a == unsound) return a;
      if (at_b == unsound) return b;
      (at_a < at_b ? high : low) = at_a < at_b ? b : a;
    }
  }
  return std::nullopt;
}

std::vector<double> GuardPassage::find(const Left& left, std::size_t most) const {
  std::vector<double> found;
  for (const Beside& one : beside_)
    if (const auto s = least(left, one.triangle, looks(one))) found.push_back(*s);
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  if (found.size() <= most) return found;
  std::vector<double> some;
  for (std::size_t i = 0; i < most; ++i) some.push_back(found[i * found.size() / most]);
  return some;
}

}  // namespace cleft
