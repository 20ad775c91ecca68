#include "explorer/incision/surroundings.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <queue>
#include <span>
#include <tuple>
#include <utility>

#include "explorer/incision/incision_tolerances.h"
#include "explorer/incision/path_trace.h"

namespace cleft {

namespace {

using Limits = IncisionTolerances;

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

/// The vertices of other lips at the same place: those across a closed wound of another cut than `own`.
std::vector<int> across_wound(const CutMesh& mesh, int v, int own) {
  std::vector<int> result;
  if (mesh.vertex(v).kind == VertexKind::skin) return result;
  for (const int t : mesh.fan(v))
    if (mesh.is_wall(t) && mesh.sheets()[mesh.triangle(t).sheet].cut != own)
      result.push_back(mesh.triangle(mesh.twin(t)).vertex[CutMesh::twin_corner(mesh.triangle(t).corner(v))]);
  return result;
}

}  // namespace

/// Nearest first over the skin (Dijkstra), by lengths across the path.
class Surroundings::Front {
 public:
  /// Over vertices beside the path from one place to another. `cut`: the path's own number in the mesh.
  Front(Surroundings& around, const CutMesh& mesh, const ScalpelPath& path, double first, double last,
        int cut)
      : around_(around),
        mesh_(mesh),
        path_(path),
        first_(first),
        last_(last),
        cut_(cut),
        known_(mesh.vertices().size()) {}

  void begin(const std::vector<PathTrace::Corner>& trace) {
    for (const PathTrace::Corner& c : trace)
      front_.push({std::abs(c.at.v), c.vertex, side_beside(c.at.s, c.at.v)});
  }
  void begin(const std::vector<int>& beside) {
    for (const int v : beside) front_.push({std::abs(known(v).v), v, side_beside(known(v).s, known(v).v)});
  }
  /// Beside the lips of the path's own cut, on either side.
  void begin_beside_lips() {
    const auto of_own_lip = [&](int v, Side otherwise) {
      return mesh_.vertex(v).cut == cut_ ? side_of(mesh_.vertex(v).kind) : otherwise;
    };
    for (const CutMesh::Triangle& triangle : mesh_.triangles()) {
      if (triangle.region != Region::skin) continue;
      for (const int v : triangle.vertex)
        if (const Side side = of_own_lip(v, Side::both); side != Side::both)
          for (const int corner : triangle.vertex)
            front_.push({std::abs(known(corner).v), corner, of_own_lip(corner, side)});
    }
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
      for (const int other : across_wound(mesh_, v, cut_))
        if (!around_.labels_[other].reached) front_.push({distance, other, side});
    }
  }
  double straight(int v) { return std::abs(known(v).v); }
  /// The side of a vertex whose label is known. Of a lip of the own cut its label tells that of the skin
  /// before, and where a vertex is reached straight from the path its place tells it: the path may have
  /// turned.
  Side known_side(int v) {
    if (mesh_.vertex(v).cut == cut_) return side_of(mesh_.vertex(v).kind);
    const Label& label = around_.labels_[v];
    return label.detour > 0 || label.side == Side::both ? label.side : side_beside(known(v).s, known(v).v);
  }

  /// Those among the vertices that were reached, and their neighbours.
  template <class TrianglesOf>
  void find_irregular(const TrianglesOf& triangles_of) {
    std::vector<std::tuple<int, double, int>> found;  // a vertex, how many times, its neighbour
    for (const int v : around_.reached_) {
      const auto compare = [&](int next) {
        if (next == v || !around_.labels_[next].reached) return;
        if (const double times = stretch(v, next); times > Limits::irregular)
          found.insert(found.end(), {{v, times, next}, {next, times, v}});
      };
      for (const int t : triangles_of(v))
        for (const int next : mesh_.triangle(t).vertex) compare(next);
      for (const int other : across_wound(mesh_, v, cut_)) compare(other);
    }
    std::sort(found.begin(), found.end());
    for (std::size_t i = 0; i < found.size(); ++i)
      if (const auto [v, times, next] = found[i]; i + 1 == found.size() || std::get<0>(found[i + 1]) != v)
        around_.irregular_.push_back(
            {mesh_.position(v),
             known(v).s,
             across(v),
             times,
             side(v),
             known(v).steady,
             {known(next).steady, across(next), norm(mesh_.position(next) - mesh_.position(v))}});
  }

 private:
  struct Known {
    double s, v, w, steady;
  };
  /// How much further apart the coordinates of two neighbours are than they are.
  double stretch(int a, int b) {
    const double distance = norm(mesh_.position(a) - mesh_.position(b)),
                 apart = std::hypot(known(a).steady - known(b).steady, across(a) - across(b));
    return apart > Limits::in_the_way * path_.length() ? apart / distance : 0;
  }
  Side side(int v) {
    const Side found = around_.labels_[v].side;
    return found == Side::both ? side_of(known(v).v) : found;
  }
  double across(int v) { return Surroundings::across(known(v).v, around_.labels_[v].detour, side(v)); }
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
    known_[v] = Known{at.s, at.v, at.w - height, path_.steady_place(mesh_.position(v), at)};
    return *known_[v];
  }

  Surroundings& around_;
  const CutMesh& mesh_;
  const ScalpelPath& path_;
  double first_, last_;
  int cut_;
  std::vector<std::optional<Known>> known_;
  using Entry = std::tuple<double, int, Side>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front_;
};

Surroundings::Surroundings(const CutMesh& mesh, const ScalpelPath& path, const std::vector<int>& seeds,
                           double reach)
    : reach_(reach) {
  PathTrace trace(mesh, path, -reach, path.length() + reach);
  for (const int seed : seeds)
    if (trace.follow(seed, 0, true)) {
      trace.follow(seed, 0, false);
      break;
    }
  if (!seeds.empty()) trace.cover(seeds.front());
  add_stations(std::move(trace.pieces));
  labels_.resize(mesh.vertices().size());
  for (const PathTrace::Corner& c : trace.corners)
    if (c.at.s < 0) before_start_.push_back(c.vertex);
  constexpr int not_cut_yet = -1;
  Front front(*this, mesh, path, -reach, path.length() + reach, not_cut_yet);
  front.begin(trace.corners);
  const Star star(mesh);
  const auto triangles_of = [&](int v) {
    return std::span(star.triangles).subspan(star.first[v], star.first[v + 1] - star.first[v]);
  };
  front.spread(triangles_of);
  front.find_irregular(triangles_of);
  for (int v = 0; v < static_cast<int>(labels_.size()); ++v)
    if (mesh.vertex(v).depth > 0) walls_.push_back(v);
  label_walls(mesh);
}

/// Walls are where the lips above them are.
void Surroundings::label_walls(const CutMesh& mesh) {
  for (const int v : walls_) {  // parents come first
    const Label before = std::exchange(labels_[v], of_parents(mesh, v, labels_));
    if (labels_[v] != before) relabelled_.push_back(v);
  }
}

/// Those beyond the last one so far.
void Surroundings::add_stations(std::vector<Station> stations) {
  std::sort(stations.begin(), stations.end(), [](const Station& a, const Station& b) { return a.s < b.s; });
  for (const Station& s : stations)
    if (stations_.empty() || s.s > stations_.back().s) stations_.push_back(s);
}

double Surroundings::across(double straight, double detour, Side side) {
  return side == Side::left    ? std::min(straight, 0.0) - detour
         : side == Side::right ? std::max(straight, 0.0) + detour
                               : 0;
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
  std::erase_if(irregular_, [&](const Irregular& i) { return i.s > from; });
  relabelled_.clear();
  for (const int v : reached_) {
    if (labels_[v].s <= from) continue;
    relabelled_.push_back(v);
    labels_[v] = {};
  }
  reached_.clear();
}

/// From the triangle `seed` on.
std::vector<PathTrace::Corner> Surroundings::trace_on(const CutMesh& mesh, const ScalpelPath& path,
                                                      double from, double ahead, int seed) {
  PathTrace trace(mesh, path, from - reach_, from + ahead);
  trace.follow(seed, from, true);
  add_stations(std::move(trace.pieces));
  return std::move(trace.corners);
}

void Surroundings::search_again(const CutMesh& mesh, const ScalpelPath& path, double from, int seed,
                                int cut) {
  keep_until(from);
  irregular_.clear(), reached_.clear(), relabelled_.clear();
  labels_.assign(mesh.vertices().size(), {});
  Front front(*this, mesh, path, -reach_, path.length() + reach_, cut);
  front.begin(trace_on(mesh, path, from, reach_, seed));
  front.begin(before_start_);
  front.begin_beside_lips();
  const Star star(mesh);
  const auto triangles_of = [&](int v) {
    return std::span(star.triangles).subspan(star.first[v], star.first[v + 1] - star.first[v]);
  };
  front.spread(triangles_of);
  front.find_irregular(triangles_of);
  for (int v = 0; v < static_cast<int>(labels_.size()); ++v)  // parents come first
    if (mesh.vertex(v).depth > 0) labels_[v] = of_parents(mesh, v, labels_);
}

void Surroundings::extend(const CutMesh& mesh, const ScalpelPath& path, double from, double ahead, int seed,
                          int cut) {
  const auto before = static_cast<int>(labels_.size()), now = static_cast<int>(mesh.vertices().size());
  keep_until(from);
  labels_.resize(now);
  const auto corners = trace_on(mesh, path, from, ahead, seed);
  Front front(*this, mesh, path, from, from + ahead, cut);
  front.begin(corners);
  const auto begin_from_neighbors = [&](int v) {
    for (const int t : mesh.skin_fan(v))
      for (const int u : mesh.triangle(t).vertex)
        if (labels_[u].reached)
          if (const Side side = front.known_side(u); side != Side::both)  // none in the blade's way
            front.go_on(front.straight(u) + labels_[u].detour, u, v, side);
  };
  for (const int v : relabelled_) begin_from_neighbors(v);
  for (int v = before; v < now; ++v)
    if (mesh.vertex(v).kind == VertexKind::skin) begin_from_neighbors(v);
  front.spread([&](int v) { return mesh.skin_fan(v); });
  front.find_irregular([&](int v) { return mesh.skin_fan(v); });
  for (int v = before; v < now; ++v)
    if (!labels_[v].reached) labels_[v] = of_parents(mesh, v, labels_);
  relabelled_.insert(relabelled_.end(), reached_.begin(), reached_.end());
  label_walls(mesh);
  for (int v = before; v < now; ++v) relabelled_.push_back(v);
  std::sort(relabelled_.begin(), relabelled_.end());
  relabelled_.erase(std::unique(relabelled_.begin(), relabelled_.end()), relabelled_.end());
}

}  // namespace cleft
