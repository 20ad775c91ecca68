#include "explorer/body/vertex_places.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <queue>
#include <set>
#include <utility>

#include "explorer/body/body_lips.h"
#include "explorer/body/edge_distances.h"
#include "explorer/body/parted_surface.h"

namespace cleft {

namespace {

constexpr double furthest = 2;      // mm: of a vertex from the body's skin, whose triangles are larger
constexpr double faded_part = 0.3;  // of the way from what stays to the cuts: there displacements fade out
// A vertex on a cut, or next to one, is first sought where the skin around it, so many mm and triangles, is:
// there it is on one side of all cuts. A body's straight pieces of a path are off those of the mesh.
constexpr double around = 0.5;
constexpr std::size_t most_around = 64;
constexpr double aside = 0.2;       // mm: the same on a wall, and at the end of a cut
constexpr double as_near = 0.1;     // mm: of two places, one reached from a lip of the body
constexpr double most_winding = 2;  // of a path from vertex to vertex, over their distance
constexpr double least_of_end = 1.3 * std::numbers::pi;  // radians, of the skin around the end of a cut

/// By node: whether no cut parts it.
std::vector<bool> closed_nodes(const Body& body) {
  std::vector<bool> closed(body.points.size(), true);
  for (const BodyPair& pair : body.pairs) closed[pair.left] = closed[pair.right] = false;
  return closed;
}

class Locator {
 public:
  Locator(const Body& body, const std::vector<const Incision*>& cuts, double scale)
      : cuts_(cuts),
        mesh_(cuts.front()->mesh()),
        scale_(scale),
        skin_({body.points, body.skin}),
        closed_(closed_nodes(body)),
        walls_(walls_of(body), closed_),
        ends_(body, cuts, scale) {
    for (std::size_t k = 0; k < cuts.size(); ++k)
      lips_.emplace_back(body, static_cast<int>(k), *cuts[k], scale);
  }

  std::vector<VertexPlace> run() {
    const auto count = static_cast<int>(mesh_.vertices().size());
    std::vector<bool> seen(count, false);
    std::queue<int> next;
    // Lips first, where cuts meet after the others, which tell them their side; then the walls below them.
    std::array<std::vector<int>, 3> of_cuts;
    for (int v = 0; v < count; ++v)
      if (mesh_.vertex(v).kind != VertexKind::skin)
        of_cuts[fan(v).skin.empty() ? 2 : start_of(v) < 0 ? 1 : 0].push_back(v);
    for (const std::vector<int>& some : of_cuts)
      for (const int v : some) seen[v] = true, next.push(v);
    std::vector<std::vector<int>> linked(count);
    for (const CutMesh::Triangle& t : mesh_.triangles())
      for (int i = 0; i < 3; ++i)
        linked[t.vertex[i]].push_back(t.vertex[(i + 1) % 3]),
            linked[t.vertex[(i + 1) % 3]].push_back(t.vertex[i]);
    triangle_.assign(count, -1);
    for (auto& walls : wall_) walls.assign(count, -1);
    // Only what is connected with the cuts over places of the body.
    while (!next.empty()) {
      const int v = next.front();
      next.pop();
      const std::size_t had = places_.size();
      locate(v);
      if (places_.size() == had) continue;
      for (const int w : linked[v])
        if (!seen[w]) seen[w] = true, next.push(w);
    }
    fade();
    std::sort(places_.begin(), places_.end(),
              [](const auto& a, const auto& b) { return a.vertex < b.vertex; });
    return std::move(places_);
  }

 private:
  /// Triangles around a vertex, of the skin or of a wall.
  struct Fan {
    std::vector<int> skin, left, right;
  };

  Vec3 at(int v) const { return scale_ * mesh_.position(v); }
  Vec3 middle(int t) const {
    const auto& c = mesh_.triangle(t).vertex;
    return 1. / 3 * (at(c[0]) + at(c[1]) + at(c[2]));
  }
  Vec3 twice_area(int t) const {
    const auto& c = mesh_.triangle(t).vertex;
    return cross(at(c[1]) - at(c[0]), at(c[2]) - at(c[0]));
  }

  Fan fan(int v) const {
    Fan fan;
    for (const int t : mesh_.fan(v)) {
      const Region region = mesh_.triangle(t).region;
      (region == Region::skin ? fan.skin : region == Region::left_wall ? fan.left : fan.right).push_back(t);
    }
    return fan;
  }

  /// From a vertex toward the centroid of triangles around it, not far.
  Vec3 to_middle(int v, const std::vector<int>& triangles) const {
    Vec3 sum;
    double area = 0;
    for (const int t : triangles) {
      const double part = norm(twice_area(t));
      sum += part * (middle(t) - at(v)), area += part;
    }
    return area > 0 ? std::min(1., aside / norm(sum) * area) / area * sum : Vec3{};
  }

  /// Of triangles around a vertex, there.
  double angle(int v, const std::vector<int>& triangles) const {
    double sum = 0;
    for (const int t : triangles) {
      const auto& c = mesh_.triangle(t).vertex;
      const int i = mesh_.triangle(t).corner(v);
      const Vec3 a = at(c[(i + 1) % 3]) - at(v), b = at(c[(i + 2) % 3]) - at(v);
      sum += std::atan2(norm(cross(a, b)), dot(a, b));
    }
    return sum;
  }

  /// The direction from a lip into its skin: between its two edges there.
  Vec3 inward(int v, const std::vector<int>& fan) const {
    std::set<int> after, before;  // the vertices around it, counter-clockwise
    Vec3 normal;
    for (const int t : fan) {
      const auto& c = mesh_.triangle(t).vertex;
      const int i = mesh_.triangle(t).corner(v);
      after.insert(c[(i + 1) % 3]), before.insert(c[(i + 2) % 3]), normal += twice_area(t);
    }
    if (after == before) return {};
    const auto only_in = [](const std::set<int>& some, const std::set<int>& others) {
      return *std::find_if(some.begin(), some.end(), [&](int w) { return !others.contains(w); });
    };
    const Vec3 first = normalized(at(only_in(after, before)) - at(v));
    const Vec3 left = cross(normalized(normal), first);
    const double half = angle(v, fan) / 2;
    return std::cos(half) * first + std::sin(half) * left;
  }

  /// From a vertex to the middle of the skin that is near it, connected with `fan`, and not behind `inward`.
  Vec3 to_middle_of_skin(int v, const std::vector<int>& fan, const Vec3& inward) const {
    std::vector<int> patch = fan;
    std::set<int> seen(fan.begin(), fan.end());
    for (std::size_t k = 0; k < patch.size() && patch.size() < most_around; ++k)
      for (const int t : mesh_.triangle(patch[k]).neighbor)
        if (mesh_.is_skin(t) && norm(middle(t) - at(v)) < around && seen.insert(t).second) patch.push_back(t);
    Vec3 sum;
    double weights = 0;
    for (const int t : patch) {
      const Vec3 way = middle(t) - at(v);
      if (dot(way, inward) < 0) continue;
      const double weight = std::min(norm(twice_area(t)), around * around);
      sum += weight * std::min(1., around / norm(way)) * way, weights += weight;
    }
    return weights > 0 ? 1 / weights * sum : Vec3{};
  }

  /// How far a vertex of a cut is from its place in the body.
  Vec3 offset(int v) const {
    const CutMesh::Vertex& vertex = mesh_.vertex(v);
    return vertex.cut >= 0 && std::isfinite(vertex.s) ? lips_[vertex.cut].offset(vertex.s) : Vec3{};
  }

  /// At x, by some of the triangles around a vertex. From `start`, a triangle, if it leads there; else from
  /// where x + way is, on one side of all cuts. Returns the triangle, -1 if there is none.
  int add(int v, const std::vector<int>& triangles, const PartedSurface& surface, double share, const Vec3& x,
          const Vec3& way, int start = -1) {
    if (triangles.empty()) return -1;
    Vec3 normal;
    for (const int t : triangles) normal += twice_area(t);
    const bool on_lip = mesh_.vertex(v).kind != VertexKind::skin;
    SurfacePlace found = surface.nearest(x + way, normal, furthest);
    if (found.triangle >= 0) found = surface.nearest_from(found.triangle, x);
    // Beyond a fold of the body's skin: as far from where a neighbour is.
    if (found.triangle < 0 && start < 0 && &surface == &skin_) start = start_beside(triangles);
    if (start >= 0) {
      const SurfacePlace other = surface.nearest_from(start, x);
      if (norm(other.position - x) <
          (found.triangle < 0 ? furthest : norm(found.position - x) + (on_lip ? around : as_near)))
        found = other;
    }
    if (found.triangle < 0) return -1;
    if (&surface == &skin_) triangle_[v] = found.triangle;
    VertexPlace place{v, surface.nodes(found.triangle), {}};
    for (int i = 0; i < 3; ++i) place.weights[i] = share * found.weights[i];
    places_.push_back(place);
    return found.triangle;
  }

  /// Toward vertices that have no place in the body, and stay, where others next to them have one.
  void fade() {
    std::vector<int> number(mesh_.vertices().size(), -1), cut, staying;
    std::vector<Vec3> points;
    std::vector<std::array<int, 3>> triangles;
    for (int t = 0; t < static_cast<int>(mesh_.triangles().size()); ++t) {
      const auto& corners = mesh_.triangle(t).vertex;
      if (!mesh_.is_skin(t) ||
          std::all_of(corners.begin(), corners.end(), [&](int v) { return triangle_[v] < 0; }))
        continue;
      for (const int v : corners)
        if (number[v] < 0) {
          number[v] = static_cast<int>(points.size());
          points.push_back(at(v));
          if (mesh_.vertex(v).kind != VertexKind::skin) cut.push_back(number[v]);
          if (triangle_[v] < 0) staying.push_back(number[v]);
        }
      triangles.push_back({number[corners[0]], number[corners[1]], number[corners[2]]});
    }
    const std::vector<double> to_cut = edge_distances(points, triangles, cut),
                              to_staying = edge_distances(points, triangles, staying);
    for (VertexPlace& place : places_) {
      const int n = number[place.vertex];
      if (n < 0 || std::isinf(to_staying[n]) || !(to_cut[n] > 0)) continue;
      const double x = std::min(1., to_staying[n] / (faded_part * (to_staying[n] + to_cut[n])));
      for (double& weight : place.weights) weight *= x * x * (3 - 2 * x);
    }
  }

  /// A triangle of the body's skin at which a neighbour is; -1: none is known.
  int start_beside(const std::vector<int>& skin) const {
    for (const int t : skin)
      for (const int w : mesh_.triangle(t).vertex)
        if (triangle_[w] >= 0) return triangle_[w];
    return -1;
  }

  void locate(int v) {
    const auto [skin, left, right] = fan(v);
    const CutMesh::Vertex& vertex = mesh_.vertex(v);
    const Vec3 x = at(v) + offset(v) + ends_.at(at(v));
    if (vertex.kind == VertexKind::shared && angle(v, skin) > least_of_end) {  // an end: between the lips
      const Vec3 across = cuts_[vertex.cut]->path().at(vertex.s).across;
      std::vector<int> sides[2];
      for (const int t : skin) sides[dot(middle(t) - at(v), across) > 0].push_back(t);
      const double share = sides[0].empty() || sides[1].empty() ? 1 : 0.5;
      const bool beside_another = is_beside_another(v, skin);
      for (const int side : {0, 1})
        add(v, sides[side], skin_, share, x,
            beside_another ? to_middle(v, sides[side]) : (side ? aside : -aside) * across);
    } else if (vertex.kind != VertexKind::skin && !skin.empty()) {
      int start = start_of(v);
      if (start < 0) start = start_beside(skin);
      const int t = add(v, skin, skin_, 1, x, to_middle_of_skin(v, skin, inward(v, skin)), start);
      if (t >= 0) start_walls_below(v);
    } else if (!skin.empty()) {
      int start = -1;
      for (const int t : skin)
        for (const int w : mesh_.triangle(t).vertex)
          if (start < 0) start = start_of(w);
      add(v, skin, skin_, 1, x, from_lips(v, skin), start);
    } else {  // walls; the bottom is shared by both
      const double share = left.empty() || right.empty() ? 1 : 0.5;
      for (const auto& [side, triangles] : {std::pair(0, &left), std::pair(1, &right)})
        wall_[side][v] =
            add(v, *triangles, walls_, share, x, to_middle(v, *triangles), start_on_wall(side, *triangles));
    }
  }

  /// Whether the skin around the end of a cut has a lip of another cut, as where it ends just beyond that.
  bool is_beside_another(int v, const std::vector<int>& skin) const {
    return std::ranges::any_of(skin, [&](int t) {
      return std::ranges::any_of(mesh_.triangle(t).vertex, [&](int w) {
        return mesh_.vertex(w).kind != VertexKind::skin && mesh_.vertex(w).cut != mesh_.vertex(v).cut;
      });
    });
  }

  /// The walls below a lip are where its node is: not one that stays closed, which both walls have.
  void start_walls_below(int v) {
    const VertexPlace& place = places_.back();
    double most = 0;
    for (int i = 0; i < 3; ++i)
      if (place.weights[i] > most && !closed_[place.nodes[i]]) {
        most = place.weights[i];
        for (auto& walls : wall_) walls[v] = walls_.triangle_at(place.nodes[i]);
      }
  }

  /// A triangle of the body's walls at which a neighbour on the same wall is; -1: none is known.
  int start_on_wall(int side, const std::vector<int>& triangles) const {
    for (const int t : triangles)
      for (const int w : mesh_.triangle(t).vertex)
        if (wall_[side][w] >= 0) return wall_[side][w];
    return -1;
  }

  /// A triangle of the body's skin on the lip that a vertex is on, nearby; -1: none is known.
  int start_of(int v) const {
    const CutMesh::Vertex& vertex = mesh_.vertex(v);
    if (vertex.kind != VertexKind::left_lip && vertex.kind != VertexKind::right_lip) return -1;
    const double s = middle_of_own_lip(v);
    const int node = lips_[vertex.cut].node(s, vertex.kind == VertexKind::right_lip);
    return node < 0 ? -1 : skin_.triangle_at(node);
  }

  /// Where cuts cross a lip is divided: in the middle between the next vertices of the same lip that are next
  /// to the same skin, at which the path is there, mesh units. A lip that goes on in both directions is there
  /// itself.
  double middle_of_own_lip(int v) const {
    const CutMesh::Vertex& vertex = mesh_.vertex(v);
    double first = vertex.s, last = vertex.s;
    for (const int t : mesh_.fan(v))
      for (const int w : mesh_.triangle(t).vertex) {
        const CutMesh::Vertex& other = mesh_.vertex(w);
        if (mesh_.is_skin(t) && other.kind == vertex.kind && other.cut == vertex.cut &&
            scale_ * std::abs(other.s - vertex.s) < most_winding * norm(at(w) - at(v)))
          first = std::min(first, other.s), last = std::max(last, other.s);
      }
    if (first < vertex.s && last > vertex.s) return vertex.s;
    return (first + last) / 2;
  }

  /// Of a vertex of the skin: away from the lips next to it, if there are any.
  Vec3 from_lips(int v, const std::vector<int>& skin) const {
    Vec3 off, way;
    double lips = 0;
    for (const int t : skin)
      for (const int w : mesh_.triangle(t).vertex)
        if (mesh_.vertex(w).kind != VertexKind::skin) off += offset(w), way += inward(w, fan(w).skin), ++lips;
    return lips > 0 ? 1 / lips * off + to_middle_of_skin(v, skin, way) : Vec3{};
  }

  const std::vector<const Incision*>& cuts_;
  const CutMesh& mesh_;
  double scale_;
  const PartedSurface skin_;
  const std::vector<bool> closed_;  // by node of the body
  const PartedSurface walls_;
  std::vector<BodyLips> lips_;  // by cut
  const EndShift ends_;
  std::vector<int> triangle_;             // by vertex: of the body's skin, at which it is; -1: none
  std::array<std::vector<int>, 2> wall_;  // likewise of its walls, of the left and the right one
  std::vector<VertexPlace> places_;
};

}  // namespace

std::vector<VertexPlace> places_in(const Body& body, const std::vector<const Incision*>& cuts, double scale) {
  return Locator(body, cuts, scale).run();
}

}  // namespace cleft
