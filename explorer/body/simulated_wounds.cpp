#include "explorer/body/simulated_wounds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <queue>
#include <utility>

#include "base/error.h"
#include "explorer/body/extrusion.h"

namespace cleft {

namespace {

constexpr double furthest = 2;      // mm: of a vertex from the body's skin, whose triangles are larger
constexpr double faded_part = 0.3;  // of the way from the cuts to the rim: there displacements fade out
constexpr double aside = 0.05;      // mm: of a vertex next to a cut, to its own side; more than the body's
                                    // straight pieces of a path are from those of the mesh

/// The walls of a body's cuts: faces of one wedge that lie on another one.
SurfaceMesh walls_of(const Body& body) {
  std::vector<int> root(body.points.size());
  std::iota(root.begin(), root.end(), 0);
  for (const BodyPair& pair : body.pairs) root[pair.right] = root[pair.left];
  std::map<std::array<int, 4>, std::vector<std::array<int, 4>>> at_place;  // faces, outward, cyclic
  for (const auto& w : body.wedges)
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      const std::array<int, 4> face = {w[i], w[j], w[3 + j], w[3 + i]};
      std::array<int, 4> key;
      std::transform(face.begin(), face.end(), key.begin(), [&](int n) { return root[n]; });
      std::sort(key.begin(), key.end());
      at_place[key].push_back(face);
    }
  SurfaceMesh walls;
  walls.points = body.points;
  const auto sorted = [](std::array<int, 4> face) { return std::sort(face.begin(), face.end()), face; };
  for (const auto& [key, faces] : at_place) {
    if (faces.size() != 2 || sorted(faces[0]) == sorted(faces[1])) continue;  // at the surface, or within
    for (const auto& [a, b, c, d] : faces) {
      walls.triangles.push_back({a, b, c});
      walls.triangles.push_back({a, c, d});
    }
  }
  return walls;
}

/// Distances over the skin from its rim, by node: infinite without a rim.
std::vector<double> from_rim(const Body& body) {
  std::vector<std::vector<int>> around(body.points.size());
  std::vector<int> root(body.points.size());  // copies are one place
  std::iota(root.begin(), root.end(), 0);
  for (const BodyPair& pair : body.pairs) root[pair.right] = root[pair.left];
  for (const auto& t : body.skin)
    for (int i = 0; i < 3; ++i)
      for (const int j : {1, 2}) around[root[t[i]]].push_back(root[t[(i + j) % 3]]);
  std::vector<double> distance(body.points.size(), std::numeric_limits<double>::infinity());
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (const auto& side : body.sides)
    for (const int n : side)
      if (body.skin_above[n] == n && distance[n] > 0) distance[n] = 0, queue.emplace(0, n);
  while (!queue.empty()) {
    const auto [d, n] = queue.top();
    queue.pop();
    if (d > distance[n]) continue;
    for (const int m : around[n])
      if (const double next = d + norm(body.points[m] - body.points[n]); next < distance[m])
        distance[m] = next, queue.emplace(next, m);
  }
  for (std::size_t n = 0; n < distance.size(); ++n) distance[n] = distance[root[body.skin_above[n]]];
  return distance;
}

class Locator {
 public:
  Locator(const std::vector<const Incision*>& cuts, double scale, const Body& body)
      : cuts_(cuts),
        mesh_(cuts.front()->mesh()),
        scale_(scale),
        skin_({body.points, body.skin}),
        walls_(walls_of(body)) {
    const std::vector<double> rim = from_rim(body);
    double nearest = std::numeric_limits<double>::infinity();
    for (const BodyPair& pair : body.pairs) nearest = std::min(nearest, rim[pair.left]);
    for (const double d : rim) {
      const double x = std::isinf(d) ? 1 : std::clamp(d / (faded_part * nearest), 0., 1.);
      share_.push_back(x * x * (3 - 2 * x));
    }
  }

  std::vector<SimulatedWounds::Place> run() {
    const auto count = static_cast<int>(mesh_.vertices().size());
    std::vector<bool> seen(count, false);
    std::queue<int> next;
    for (int v = 0; v < count; ++v)
      if (mesh_.vertex(v).kind != VertexKind::skin) seen[v] = true, next.push(v);
    std::vector<std::vector<int>> around(count);
    for (const CutMesh::Triangle& t : mesh_.triangles())
      for (int i = 0; i < 3; ++i)
        around[t.vertex[i]].push_back(t.vertex[(i + 1) % 3]),
            around[t.vertex[(i + 1) % 3]].push_back(t.vertex[i]);
    std::vector<SimulatedWounds::Place> places;
    // Only what is connected with the cuts over places of the body.
    while (!next.empty()) {
      const int v = next.front();
      next.pop();
      const std::size_t had = places.size();
      locate(v, places);
      if (places.size() == had) continue;
      for (const int w : around[v])
        if (!seen[w]) seen[w] = true, next.push(w);
    }
    std::sort(places.begin(), places.end(), [](const auto& a, const auto& b) { return a.vertex < b.vertex; });
    return places;
  }

 private:
  Vec3 at(int v) const { return scale_ * mesh_.position(v); }
  Vec3 twice_area(int t) const {
    const auto& c = mesh_.triangle(t).vertex;
    return cross(at(c[1]) - at(c[0]), at(c[2]) - at(c[0]));
  }
  Vec3 middle(int t) const {
    const auto& c = mesh_.triangle(t).vertex;
    return 1. / 3 * (at(c[0]) + at(c[1]) + at(c[2]));
  }

  /// By some of the triangles around a vertex: their side of the cuts, and their normal.
  void add(int v, const std::vector<int>& triangles, const SurfaceIndex& surface, double share,
           std::vector<SimulatedWounds::Place>& places, const std::optional<Vec3>& beside = {}) const {
    if (triangles.empty()) return;
    Vec3 normal, toward;
    for (const int t : triangles) {
      normal += twice_area(t);
      toward += 1. / static_cast<double>(triangles.size()) * (middle(t) - at(v));
    }
    if (beside) toward = *beside;
    const double length = norm(toward);
    const Vec3 moved = length > 0 && (beside || &surface == &walls_) ? aside / length * toward : Vec3{};
    const SurfacePlace found = surface.nearest(at(v) + moved, normal, furthest);
    if (found.triangle < 0) return;
    const auto& corners = surface.surface().triangles[found.triangle];
    SimulatedWounds::Place place{v, corners, {}};
    double weights = 0;
    for (int i = 0; i < 3; ++i)
      place.weights[i] = share * share_[corners[i]] * found.weights[i], weights += place.weights[i];
    if (weights > 0) places.push_back(place);
  }

  void locate(int v, std::vector<SimulatedWounds::Place>& places) const {
    std::vector<int> skin, left, right;
    for (const int t : mesh_.fan(v)) {
      const Region region = mesh_.triangle(t).region;
      (region == Region::skin ? skin : region == Region::left_wall ? left : right).push_back(t);
    }
    const CutMesh::Vertex& vertex = mesh_.vertex(v);
    if (vertex.kind == VertexKind::shared && vertex.cut >= 0 && !skin.empty()) {  // an end: between the lips
      const Vec3 across = cuts_[vertex.cut]->path().at(vertex.s).across;
      std::vector<int> sides[2];
      for (const int t : skin) sides[dot(middle(t) - at(v), across) > 0].push_back(t);
      const double share = sides[0].empty() || sides[1].empty() ? 1 : 0.5;
      for (const int side : {0, 1}) add(v, sides[side], skin_, share, places, side ? across : -1. * across);
    } else if (!left.empty() || !right.empty()) {  // lips and walls; the bottom is shared by both walls
      const double share = left.empty() || right.empty() || !skin.empty() ? 1 : 0.5;
      const std::size_t had = places.size();
      add(v, left, walls_, share, places);
      if (skin.empty() || places.size() == had) add(v, right, walls_, share, places);
    } else {
      add(v, skin, skin_, 1, places, beside_cut(v));
    }
  }

  /// Toward the side of a vertex of the skin next to a lip.
  std::optional<Vec3> beside_cut(int v) const {
    for (const int t : mesh_.fan(v))
      for (const int w : mesh_.triangle(t).vertex) {
        const CutMesh::Vertex& lip = mesh_.vertex(w);
        if (lip.kind != VertexKind::left_lip && lip.kind != VertexKind::right_lip) continue;
        const Vec3 across = cuts_[lip.cut]->path().at(lip.s).across;
        return lip.kind == VertexKind::right_lip ? across : -1. * across;
      }
    return {};
  }

  const std::vector<const Incision*>& cuts_;
  const CutMesh& mesh_;
  double scale_;
  const SurfaceIndex skin_, walls_;
  std::vector<double> share_;  // of a node's displacement, by node
};

}  // namespace

SimulatedWounds::SimulatedWounds(const std::vector<const Incision*>& cuts, double scale, const Body& body,
                                 const SnapshotReader& series)
    : scale_(scale), times_(series.snapshot().times) {
  if (series.snapshot().body != body.hash || series.snapshot().points.size() != body.points.size())
    throw InputError("the simulation is of another body (" + series.snapshot().body + ", not " + body.hash +
                     "): solve this one with cleft solve --mesh");
  for (std::size_t f = 0; f < times_.size(); ++f) {
    auto& frame = frames_.emplace_back();
    for (const Vec3& d : series.displacement(f))
      frame.push_back({static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)});
  }
  for (const CutMesh::Vertex& v : cuts.front()->mesh().vertices()) rest_.push_back(v.position);
  places_ = Locator(cuts, scale, body).run();
}

SimulatedWounds::Moment SimulatedWounds::moment(double t) const {
  const auto next = std::upper_bound(times_.begin(), times_.end(), t) - times_.begin();
  const std::size_t frame = std::clamp<std::size_t>(next, 1, times_.size() - 1) - 1;
  return {frame, std::clamp((t - times_[frame]) / (times_[frame + 1] - times_[frame]), 0., 1.)};
}

Vec3 SimulatedWounds::displacement(const Place& place, double t) const {
  const auto [frame, part] = moment(t);
  const auto &before = frames_[frame], &after = frames_[frame + 1];
  Vec3 sum;
  for (int i = 0; i < 3; ++i)
    for (int axis = 0; axis < 3; ++axis)
      sum[axis] +=
          place.weights[i] * ((1 - part) * before[place.nodes[i]][axis] + part * after[place.nodes[i]][axis]);
  return sum;
}

void SimulatedWounds::positions(double t, std::span<Vec3> out) const {
  CLEFT_CHECK(out.size(), ==, rest_.size());
  std::copy(rest_.begin(), rest_.end(), out.begin());
  for (const Place& place : places_) out[place.vertex] += 1 / scale_ * displacement(place, t);
}

ReplayOff replay_off(const std::vector<const Incision*>& cuts, std::span<const Vec3> replayed,
                     std::span<const Vec3> simulated) {
  const CutMesh& mesh = cuts.front()->mesh();
  ReplayOff off;
  for (std::size_t v = 0; v < simulated.size(); ++v) {
    off.largest = std::max(off.largest, norm(simulated[v] - mesh.position(static_cast<int>(v))));
    off.displacement = std::max(off.displacement, norm(simulated[v] - replayed[v]));
  }
  for (const Incision* cut : cuts)
    for (const Incision::ChainVertex& c : cut->chain()) {
      const Vec3 open = simulated[c.right] - simulated[c.left];
      off.gape = std::max(off.gape, norm(open));
      off.opening = std::max(off.opening, norm(open - (replayed[c.right] - replayed[c.left])));
    }
  return off;
}

}  // namespace cleft
