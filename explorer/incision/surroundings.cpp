#include "explorer/incision/surroundings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <queue>
#include <tuple>

namespace cleft {

namespace {

/// The skin triangle across edge i of t; beyond a wound, that at the opposite lip; -1: there is none.
int skin_across(const CutMesh& mesh, int t, int i) {
  const int other = mesh.triangle(t).neighbor[i];
  if (other < 0 || mesh.is_skin(other)) return other < 0 ? -1 : other;
  const int corner = mesh.triangle(other).corner(mesh.triangle(t).vertex[(i + 1) % 3]),
            twin = mesh.twin(other);
  const int beyond = mesh.triangle(twin).neighbor[CutMesh::twin_edge(corner)];
  return mesh.is_skin(beyond) ? beyond : -1;
}

/// Where a corner of a triangle lies, looked for near a known place of the path: one that comes back to where
/// it was before is still followed.
struct Corner {
  int vertex = -1;
  PathCoordinates at;
  bool right() const { return at.v >= 0; }
};

/// The zero of v on the surface, from triangle to triangle.
class Trace {
 public:
  Trace(const CutMesh& mesh, const ScalpelPath& path, double reach)
      : mesh_(mesh), path_(path), reach_(reach) {}

  /// From triangle t on, where the path passes it near s, ahead or back. False where it does not pass.
  bool follow(int t, double s, bool ahead) {
    double farthest = -std::numeric_limits<double>::infinity();
    int stuck = 0;
    for (bool first = true; t >= 0; first = false) {
      const std::optional<int> out = pass(t, s, ahead, first);
      if (!out) return !first;
      const double now = ahead ? s : -s;
      stuck = now > farthest ? 0 : stuck + 1;
      farthest = std::max(farthest, now);
      if (stuck > 20 || s < -reach_ || s > path_.length() + reach_) break;
      t = skin_across(mesh_, t, *out);
    }
    return true;
  }

  std::vector<Surroundings::Station> stations;
  std::vector<Corner> corners;  // of all triangles passed

 private:
  /// The edge by which the path leaves t, if it passes it and t does not turn away from the blade; s becomes
  /// that of the place.
  std::optional<int> pass(int t, double& s, bool ahead, bool first) {
    const auto& v = mesh_.triangle(t).vertex;
    const Vec3 p[3] = {mesh_.position(v[0]), mesh_.position(v[1]), mesh_.position(v[2])};
    const double longest = std::sqrt(
        std::max({squared_norm(p[1] - p[0]), squared_norm(p[2] - p[1]), squared_norm(p[0] - p[2])}));
    Corner corner[3];
    for (int i = 0; i < 3; ++i) corner[i] = {v[i], path_.coordinates(p[i], s - 3 * longest, s + 3 * longest)};
    int crossing[2], count = 0;
    for (int i = 0; i < 3; ++i)
      if (corner[i].right() != corner[(i + 1) % 3].right()) crossing[count++] = i;
    if (count != 2) return std::nullopt;
    double at[2], height[2];
    for (int k = 0; k < 2; ++k) {
      const PathCoordinates &a = corner[crossing[k]].at, &b = corner[(crossing[k] + 1) % 3].at;
      const double part = a.v / (a.v - b.v);
      at[k] = (1 - part) * a.s + part * b.s, height[k] = (1 - part) * a.w + part * b.w;
    }
    const Vec3 normal = cross(p[1] - p[0], p[2] - p[0]);
    if (dot(normal, path_.at((at[0] + at[1]) / 2).outward) <= 0) return std::nullopt;
    const double length = std::abs(at[1] - at[0]);
    const bool known = first && !stations.empty();  // the second of two ways from the same triangle
    if (length > 0 && !known)
      stations.push_back({(at[0] + at[1]) / 2, length, (height[0] + height[1]) / 2, normalized(normal)});
    for (const Corner& c : corner) corners.push_back(c);
    const int out = (at[1] > at[0]) == ahead ? 1 : 0;
    s = at[out];
    return crossing[out];
  }

  const CutMesh& mesh_;
  const ScalpelPath& path_;
  double reach_;
};

/// The skin triangles around every vertex, by index into one list.
struct Star {
  std::vector<int> first, triangles;

  explicit Star(const CutMesh& mesh) : first(mesh.vertices().size() + 2) {
    const auto each_corner = [&](const auto& use) {
      for (std::size_t t = 0; t < mesh.triangles().size(); ++t)
        if (mesh.triangles()[t].region == Region::skin)
          for (const int v : mesh.triangles()[t].vertex) use(v, static_cast<int>(t));
    };
    each_corner([&](int v, int) { ++first[v + 2]; });
    for (std::size_t v = 2; v < first.size(); ++v) first[v] += first[v - 1];
    triangles.resize(first.back());
    each_corner([&](int v, int t) { triangles[first[v + 1]++] = t; });
  }
};

/// The vertices of other lips at the same place: those across a closed wound.
std::vector<int> across_wound(const CutMesh& mesh, int v) {
  std::vector<int> result;
  if (mesh.vertex(v).kind == VertexKind::skin) return result;
  for (const int t : mesh.fan(v))
    if (mesh.is_wall(t))
      result.push_back(mesh.triangle(mesh.twin(t)).vertex[CutMesh::twin_corner(mesh.triangle(t).corner(v))]);
  return result;
}

}  // namespace

Surroundings::Surroundings(const CutMesh& mesh, const ScalpelPath& path, const std::vector<int>& seeds,
                           double reach)
    : reach_(reach) {
  Trace trace(mesh, path, reach);
  for (const int seed : seeds)
    if (trace.follow(seed, 0, true)) {
      trace.follow(seed, 0, false);
      break;
    }
  stations_ = std::move(trace.stations);
  std::sort(stations_.begin(), stations_.end(), [](const Station& a, const Station& b) { return a.s < b.s; });
  labels_.resize(mesh.vertices().size());

  // Nearest first over the skin (Dijkstra), by lengths across the path.
  struct Known {
    double v, w;
  };
  std::vector<std::optional<Known>> known(labels_.size());
  const auto across = [&](int i) {
    if (!known[i]) {
      const PathCoordinates at = path.coordinates(mesh.position(i));
      const auto after = std::lower_bound(stations_.begin(), stations_.end(), at.s,
                                          [](const Station& a, double s) { return a.s < s; });
      double height = 0;
      if (!stations_.empty()) {
        const auto next = std::min(after, stations_.end() - 1),
                   last = after == stations_.begin() ? after : after - 1;
        const double part =
            next->s > last->s ? std::clamp((at.s - last->s) / (next->s - last->s), 0., 1.) : 0;
        height = (1 - part) * last->height + part * next->height;
      }
      const bool inside = at.s >= -reach_ && at.s <= path.length() + reach_;
      known[i] = {inside ? at.v : std::numeric_limits<double>::infinity(), at.w - height};
    }
    return *known[i];
  };
  using Entry = std::tuple<double, int, Side>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
  const double tiny = 1e-9 * path.length();
  for (const Corner& c : trace.corners)
    front.push({std::abs(c.at.v), c.vertex, side_of(std::abs(c.at.v) <= tiny ? 0 : c.at.v)});
  const Star star(mesh);
  while (!front.empty()) {
    const auto [distance, v, side] = front.top();
    front.pop();
    if (labels_[v].reached || distance > reach_ || std::isinf(across(v).v)) continue;
    const double straight = std::abs(across(v).v), detour = distance - straight;
    labels_[v] = {detour > 1e-9 * (distance + path.length()) ? detour : 0, side, true};
    for (int k = star.first[v]; k < star.first[v + 1]; ++k)
      for (const int next : mesh.triangle(star.triangles[k]).vertex) {
        if (labels_[next].reached || std::isinf(across(next).v)) continue;
        const Known &a = across(v), &b = across(next);
        const double edge = norm(mesh.position(next) - mesh.position(v));
        front.push({distance + std::min(edge, std::hypot(a.v - b.v, a.w - b.w)), next, side});
      }
    for (const int other : across_wound(mesh, v))
      if (!labels_[other].reached) front.push({distance, other, side});
  }
}

}  // namespace cleft
