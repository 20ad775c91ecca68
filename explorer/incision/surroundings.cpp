#include "explorer/incision/surroundings.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <queue>
#include <span>
#include <tuple>
#include <unordered_map>

#include "explorer/incision/incision_tolerances.h"

namespace cleft {

namespace {

using Limits = IncisionTolerances;

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

/// The zero of v on the surface, from triangle to triangle. Beyond the path's ends, where it goes straight
/// on, only as far as the end is the nearest place of the whole path: a loop's end does not lead over its
/// start.
class Trace {
 public:
  /// Between these places of the path.
  Trace(const CutMesh& mesh, const ScalpelPath& path, double first, double last)
      : mesh_(mesh), path_(path), first_(first), last_(last) {}

  /// From triangle t on, where the path passes it near s, ahead or back. False where it does not pass.
  bool follow(int t, double s, bool ahead) {
    std::unordered_map<int, double> passed;  // triangles, and s where the path has left them
    for (int from = -1; t >= 0;) {
      const std::optional<Exit> exit = pass(t, from, s, ahead);
      if (!exit) return from >= 0;
      s = exit->s;
      if (s < first_ || s > last_ || leads_over_path(*exit)) break;
      const auto [seen, is_new] = passed.try_emplace(t, s);
      if (!is_new && from >= 0 && std::abs(seen->second - s) < Limits::trace_window * exit->longest_edge)
        break;
      seen->second = s;
      from = t;
      t = skin_across(mesh_, t, exit->edge);
    }
    return true;
  }

  std::vector<Surroundings::Station> stations;
  std::vector<Corner> corners;  // of all triangles passed

 private:
  /// Where the path leaves a triangle.
  struct Exit {
    int edge;
    double s, longest_edge;
    Vec3 place;
  };

  bool leads_over_path(const Exit& exit) const {
    if (exit.s >= 0 && exit.s <= path_.length()) return false;
    const double nearest = path_.coordinates(exit.place).s;
    return nearest > exit.longest_edge && nearest < path_.length() - exit.longest_edge;
  }

  /// Where the path leaves t, if it passes it and t does not turn away from the blade: by the edge that it
  /// did not enter by. Where it passes a vertex both edges are at the same s but for rounding, and s could
  /// not tell them apart.
  std::optional<Exit> pass(int t, int from, double s, bool ahead) {
    const auto& v = mesh_.triangle(t).vertex;
    const Vec3 p[3] = {mesh_.position(v[0]), mesh_.position(v[1]), mesh_.position(v[2])};
    const double longest = std::sqrt(
        std::max({squared_norm(p[1] - p[0]), squared_norm(p[2] - p[1]), squared_norm(p[0] - p[2])}));
    Corner corner[3];
    for (int i = 0; i < 3; ++i) corner[i] = corner_at(v[i], s, Limits::trace_window * longest);
    int crossing[2], count = 0;
    for (int i = 0; i < 3; ++i)
      if (corner[i].right() != corner[(i + 1) % 3].right()) crossing[count++] = i;
    if (count != 2) return std::nullopt;
    double at[2], height[2];
    Vec3 place[2];
    for (int k = 0; k < 2; ++k) {
      const int i = crossing[k], next = (i + 1) % 3;
      const PathCoordinates &a = corner[i].at, &b = corner[next].at;
      const double part = a.v / (a.v - b.v);
      at[k] = (1 - part) * a.s + part * b.s, height[k] = (1 - part) * a.w + part * b.w;
      place[k] = lerp(p[i], p[next], part);
    }
    const Vec3 normal = cross(p[1] - p[0], p[2] - p[0]);
    if (dot(normal, path_.at((at[0] + at[1]) / 2).outward) <= 0) return std::nullopt;
    const double length = std::abs(at[1] - at[0]);
    const bool known = from < 0 && !stations.empty();  // the second of two ways from the same triangle
    if (length > 0 && !known)
      stations.push_back({(at[0] + at[1]) / 2, length, (height[0] + height[1]) / 2, normalized(normal)});
    for (const Corner& c : corner) corners.push_back(c);
    int out = (at[1] > at[0]) == ahead ? 1 : 0;
    if (from >= 0 && skin_across(mesh_, t, crossing[out]) == from) out = 1 - out;
    return Exit{crossing[out], at[out], longest, place[out]};
  }

  /// A corner of the triangles before is the same in this one: on which side it is, is decided once.
  Corner corner_at(int vertex, double s, double reach) const {
    const std::size_t oldest = corners.size() - std::min(corners.size(), Limits::trace_memory);
    for (std::size_t i = corners.size(); i-- > oldest;)
      if (corners[i].vertex == vertex && std::abs(corners[i].at.s - s) <= reach) return corners[i];
    return {vertex, path_.coordinates(mesh_.position(vertex), s - reach, s + reach)};
  }

  const CutMesh& mesh_;
  const ScalpelPath& path_;
  double first_, last_;
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

/// Nearest first over the skin (Dijkstra), by lengths across the path.
class Surroundings::Front {
 public:
  /// Over vertices beside the path from one place to another.
  Front(Surroundings& around, const CutMesh& mesh, const ScalpelPath& path, double first, double last)
      : around_(around),
        mesh_(mesh),
        path_(path),
        first_(first),
        last_(last),
        known_(mesh.vertices().size()) {}

  void begin(const std::vector<Corner>& trace) {
    for (const Corner& c : trace) front_.push({std::abs(c.at.v), c.vertex, side_beside(c.at.s, c.at.v)});
  }
  /// A way on from a vertex, `distance` from the path, to one beside it.
  void go_on(double distance, int from, int next, Side side) {
    if (around_.labels_[next].reached || !inside(next)) return;
    const Known &a = known(from), &b = known(next);
    const double edge = norm(mesh_.position(next) - mesh_.position(from));
    front_.push({distance + std::min(edge, std::hypot(a.v - b.v, a.w - b.w)), next, side});
  }
  /// `triangles_of(v)`: those of the skin around v.
  template <class TrianglesOf>
  void spread(const TrianglesOf& triangles_of) {
    while (!front_.empty()) {
      const auto [distance, v, side] = front_.top();
      front_.pop();
      Label& label = around_.labels_[v];
      if (label.reached || distance > around_.reach_ || !inside(v)) continue;
      const double detour = distance - std::abs(known(v).v);
      label = {detour > Limits::no_detour * (distance + path_.length()) ? detour : 0,
               static_cast<float>(known(v).s), side, true};
      around_.reached_.push_back(v);
      const bool on_path =
          side == Side::both && on_cut(known(v).s);  // its neighbours have sides of their own
      for (const int t : triangles_of(v))
        for (const int next : mesh_.triangle(t).vertex)
          go_on(distance, v, next, on_path ? side_beside(known(v).s, known(next).v) : side);
      for (const int other : across_wound(mesh_, v))
        if (!around_.labels_[other].reached) front_.push({distance, other, side});
    }
  }
  double straight(int v) { return std::abs(known(v).v); }

 private:
  struct Known {
    double s, v, w;
  };
  bool on_cut(double s) const { return s >= 0 && s <= path_.length(); }
  /// Beyond the path's ends nothing is cut, and there are no sides.
  Side side_beside(double s, double v) const {
    return on_cut(s) && std::abs(v) > Limits::in_the_way * path_.length() ? side_of(v) : Side::both;
  }
  bool inside(int v) { return known(v).s >= first_ && known(v).s <= last_; }
  const Known& known(int v) {
    if (known_[v]) return *known_[v];
    const auto& stations = around_.stations_;
    const PathCoordinates at = path_.coordinates(mesh_.position(v));
    const auto after = std::lower_bound(stations.begin(), stations.end(), at.s,
                                        [](const Station& a, double s) { return a.s < s; });
    double height = 0;
    if (!stations.empty()) {
      const auto next = std::min(after, stations.end() - 1),
                 last = after == stations.begin() ? after : after - 1;
      const double part = next->s > last->s ? std::clamp((at.s - last->s) / (next->s - last->s), 0., 1.) : 0;
      height = (1 - part) * last->height + part * next->height;
    }
    known_[v] = Known{at.s, at.v, at.w - height};
    return *known_[v];
  }

  Surroundings& around_;
  const CutMesh& mesh_;
  const ScalpelPath& path_;
  double first_, last_;
  std::vector<std::optional<Known>> known_;
  using Entry = std::tuple<double, int, Side>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front_;
};

Surroundings::Surroundings(const CutMesh& mesh, const ScalpelPath& path, const std::vector<int>& seeds,
                           double reach)
    : reach_(reach) {
  Trace trace(mesh, path, -reach, path.length() + reach);
  for (const int seed : seeds)
    if (trace.follow(seed, 0, true)) {
      trace.follow(seed, 0, false);
      break;
    }
  stations_ = std::move(trace.stations);
  std::sort(stations_.begin(), stations_.end(), [](const Station& a, const Station& b) { return a.s < b.s; });
  labels_.resize(mesh.vertices().size());
  Front front(*this, mesh, path, -reach, path.length() + reach);
  front.begin(trace.corners);
  const Star star(mesh);
  front.spread([&](int v) {
    return std::span(star.triangles).subspan(star.first[v], star.first[v + 1] - star.first[v]);
  });
}

Surroundings::Label Surroundings::of_parents(const CutMesh& mesh, int vertex,
                                             const std::vector<Label>& labels) {
  Label mean{0, 0, Side::both, true};
  int left = 0, right = 0;
  for (const int parent : mesh.vertex(vertex).parents) {
    const Label& label = labels[parent];
    mean.reached = mean.reached && label.reached;
    mean.detour += label.detour / 3;
    mean.s += label.s / 3;
    left += label.side == Side::left, right += label.side == Side::right;
  }
  mean.side = left > 0 && right == 0 ? Side::left : right > 0 && left == 0 ? Side::right : Side::both;
  return mean;
}

/// Forgets what lay beside the path beyond.
void Surroundings::keep_until(double from) {
  std::erase_if(stations_, [&](const Station& s) { return s.s > from; });
  relabelled_.clear();
  for (const int v : reached_) {
    if (labels_[v].s <= from) continue;
    relabelled_.push_back(v);
    labels_[v] = {};
  }
  reached_.clear();
}

void Surroundings::extend(const CutMesh& mesh, const ScalpelPath& path, double from, double ahead, int seed) {
  const auto before = static_cast<int>(labels_.size()), now = static_cast<int>(mesh.vertices().size());
  keep_until(from);
  labels_.resize(now);
  Trace trace(mesh, path, from - reach_, from + ahead);
  trace.follow(seed, from, true);
  std::sort(trace.stations.begin(), trace.stations.end(),
            [](const Station& a, const Station& b) { return a.s < b.s; });
  for (const Station& s : trace.stations)
    if (stations_.empty() || s.s > stations_.back().s) stations_.push_back(s);
  Front front(*this, mesh, path, from, from + ahead);
  front.begin(trace.corners);
  const auto begin_from_neighbors = [&](int v) {
    for (const int t : mesh.skin_fan(v))
      for (const int u : mesh.triangle(t).vertex)
        if (labels_[u].reached && labels_[u].side != Side::both)  // in the blade's way there is no side
          front.go_on(front.straight(u) + labels_[u].detour, u, v, labels_[u].side);
  };
  for (const int v : relabelled_) begin_from_neighbors(v);
  for (int v = before; v < now; ++v)
    if (mesh.vertex(v).kind == VertexKind::skin) begin_from_neighbors(v);
  front.spread([&](int v) { return mesh.skin_fan(v); });
  for (int v = before; v < now; ++v)
    if (!labels_[v].reached) labels_[v] = of_parents(mesh, v, labels_);
  relabelled_.insert(relabelled_.end(), reached_.begin(), reached_.end());
  for (int v = before; v < now; ++v) relabelled_.push_back(v);
  std::sort(relabelled_.begin(), relabelled_.end());
  relabelled_.erase(std::unique(relabelled_.begin(), relabelled_.end()), relabelled_.end());
}

}  // namespace cleft
