// Where the path's vertices come to stand: its start, and which vertex, edge or face takes a place of the
// path so that the triangles around it keep their shape. Nothing is changed here.
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/text.h"
#include "explorer/incision/blade.h"
#include "explorer/incision/incision.h"

namespace cleft {

namespace {

using Limits = IncisionTolerances;

/// Height over longest edge, seen along `normal`: 0 for a degenerate triangle, negative for one turned over.
double quality(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& normal) {
  const double longest = std::max({squared_norm(b - a), squared_norm(c - b), squared_norm(a - c)});
  return dot(cross(b - a, c - a), normal) / longest;
}

Vec3 unit_normal(const CutMesh& mesh, int t) {
  const auto& v = mesh.triangle(t).vertex;
  return normalized(
      cross(mesh.position(v[1]) - mesh.position(v[0]), mesh.position(v[2]) - mesh.position(v[0])));
}

/// How far from one face a step along the other leads, over its length.
double fold(const Vec3& normal, const Vec3& other) {
  return dot(normal, other) > 0 ? norm(cross(normal, other)) : 1;
}

/// The worst quality of the skin's triangles around v, were it at `place`.
double quality_around(const CutMesh& mesh, int v, const Vec3& place) {
  double worst = 1;
  for (const int t : mesh.skin_fan(v)) {
    const auto& corners = mesh.triangle(t).vertex;
    const int i = mesh.triangle(t).corner(v);
    const Vec3 &a = mesh.position(corners[(i + 1) % 3]), &b = mesh.position(corners[(i + 2) % 3]);
    const Vec3 n = normalized(cross(a - mesh.position(v), b - mesh.position(v)));
    worst = std::min(worst, quality(place, a, b, n));
  }
  return worst;
}

}  // namespace

Incision::Step Incision::find_start() const {
  const double reach = path_.length() / Limits::start_height_parts;
  if (const auto start = start_on_face(reach)) return *start;
  if (const auto start = start_on_boundary(reach)) return *start;
  const Vec3 c = path_.at(0).position;
  double least = std::numeric_limits<double>::infinity();
  for (const CutMesh::Vertex& v : mesh_.vertices()) least = std::min(least, norm(v.position - c));
  throw InputError("the path never touches the mesh: it begins at " + place_of(c) + ", " + shortest(least) +
                   " from the nearest vertex. It must lie within " + shortest(reach) +
                   " of a surface that faces along its directions (nx, ny, nz), in the mesh's own " +
                   "units: divide a path in mm by the mm per unit given as --scale");
}

std::optional<Incision::Step> Incision::start_on_face(double reach) const {
  std::optional<Step> best;
  const PathFrame frame = path_.at(0);
  for (int t = 0; t < static_cast<int>(mesh_.triangles().size()); ++t) {
    if (mesh_.is_wall(t) || !pierces(mesh_, t, frame)) continue;
    const Vec3 place = piercing_point(mesh_, t, frame);
    const double height = std::abs(dot(place - frame.position, frame.outward));
    if (height > reach) continue;
    reach = height;
    best = Step{Step::face, t, 0, place, 0};
  }
  if (best) best = placed(best->triangle, best->place, 0);
  return best;
}

std::optional<Incision::Step> Incision::start_on_boundary(double reach) const {
  std::optional<Step> best;
  for (int t = 0; t < static_cast<int>(mesh_.triangles().size()); ++t)
    for (int i = 0; i < 3; ++i) {
      if (mesh_.is_wall(t) || mesh_.triangle(t).neighbor[i] != CutMesh::boundary) continue;
      const Vec3 &a = mesh_.position(mesh_.triangle(t).vertex[i]),
                 &b = mesh_.position(mesh_.triangle(t).vertex[(i + 1) % 3]);
      // The path comes in where the boundary, followed with the surface on its left, passes from left to
      // right.
      if (path_.coordinates(a).v < 0 || path_.coordinates(b).v > 0) continue;
      const double part = zero_between(0, 1, [&](double x) { return path_.coordinates(lerp(a, b, x)).v; });
      const Vec3 place = lerp(a, b, part);
      const PathCoordinates at = path_.coordinates(place);
      if (std::abs(at.w) > reach || at.s < 0 || at.s >= path_.length() || (best && best->s <= at.s)) continue;
      best = Step{Step::edge, t, i, place, at.s};
    }
  if (best) best = placed(best->triangle, best->place, best->s);
  return best;
}

/// At a vertex of the edge that is crossed, which the path passes so closely, no later than at `to` but where
/// it is near.
std::optional<Incision::Step> Incision::snapped(const Step& crossing, double to) const {
  const CutMesh::Triangle& t = mesh_.triangle(crossing.triangle);
  std::optional<Step> best;
  double least = options_.snap;
  for (const int v : {t.vertex[crossing.index], t.vertex[(crossing.index + 1) % 3]}) {
    const Vec3& position = mesh_.position(v);
    const double room = room_of(v), to_crossing = norm(crossing.place - position);
    Step step{Step::vertex, -1, v, position, crossing.s};
    if (const auto exit = exit_at(v, crossing.s)) return exit;
    if (mesh_.vertex(v).kind != VertexKind::skin || (mesh_.on_boundary(v) && !may_move(v, crossing.place))) {
      // What cannot be moved draws the path to itself.
      if (to_crossing > least / Limits::path_snap_parts * room || !may_reach(v) ||
          drawn_along_edge(v, crossing.s))
        continue;
      // No third wound can be sewn in there; nearer, it would leave needles beside the place.
      if (to_crossing > asked_ * room && wounds_cross_at(v)) continue;
      least = Limits::path_snap_parts * to_crossing / room;
      if (mesh_.on_wound(v))  // not to turn back from there
        step.s = std::clamp(beside(position, crossing.s), crossing.s, path_.length());
      best = step;
      continue;
    }
    if (mesh_.on_boundary(v)) {
      if (to_crossing > least * room) continue;
      least = to_crossing / room;
      step.place = to_crossing <= Limits::same_place * room ? position : crossing.place;
      best = step;
      continue;
    }
    step.s = beside(position, crossing.s);
    const PathFrame frame = path_.at(step.s);
    const double away = std::abs(dot(position - frame.position, frame.across)) / room;
    if (away > least || step.s - chain_.back().s < Limits::least_advance * room ||
        step.s - crossing.s > longest_step_ || step.s - path_.length() > options_.snap * room ||
        (step.s > to && to_crossing > options_.snap * room))
      continue;
    if (away > Limits::same_place) {
      const int triangle = pierced(mesh_, mesh_.skin_fan(v), frame);
      if (triangle >= 0) step.place = piercing_point(mesh_, triangle, frame);
      // On the outline of what the blade sees it passes the vertex by, which then draws the path to itself.
      if (triangle < 0 ? away * room > chord_tolerance_ / Limits::bend_parts
                       : norm(step.place - position) > Limits::farther_snap * options_.snap * room ||
                             !keeps_fold(v, step.place, triangle))
        continue;
    }
    step.s = std::min(step.s, path_.length());
    least = away;
    best = step;
  }
  return best;
}

/// Where, near s, the path passes a place.
double Incision::beside(const Vec3& place, double s) const {
  for (int k = 0; k < Limits::newton_steps; ++k) {
    const PathFrame frame = path_.at(s);
    s += dot(place - frame.position, frame.along);
  }
  return s;
}

/// Whether the path, drawn to a vertex of a lip or of the outline, would run along it from there, so close
/// that no triangle fits between, while by itself it does not: one with the angle a has a radius ratio below
/// 2 a.
bool Incision::drawn_along_edge(int v, double s) const {
  const auto aside = [&](int w) {
    const PathFrame frame = path_.at(beside(mesh_.position(w), s));
    return dot(mesh_.position(w) - frame.position, frame.across);
  };
  const std::vector<int> fan = mesh_.skin_fan(v);
  const CutMesh::Triangle &first = mesh_.triangle(fan.front()), &last = mesh_.triangle(fan.back());
  const double drawn = aside(v);
  for (const int w : {first.vertex[(first.corner(v) + 1) % 3], last.vertex[(last.corner(v) + 2) % 3]}) {
    // The wedge's breadth at w, and how far the path comes nearer to or farther from the edge by itself.
    const double breadth = std::abs(aside(w)), by_itself = std::abs(aside(w) - drawn),
                 least = asked_ * norm(mesh_.position(w) - mesh_.position(v));
    if (breadth < least && by_itself >= std::max(least / 2, Limits::snapped_wedge * breadth)) return true;
  }
  return false;
}

/// How far a vertex may move, or draw the path to itself: not so far that a short path would lose its shape.
double Incision::room_of(int v) const { return std::min(mesh_.room(v), longest_step_); }

/// Whether a vertex may move to a place in one of its triangles: the faces around it then move by no more
/// than lips may stray.
bool Incision::keeps_fold(int v, const Vec3& place, int triangle) const {
  const Vec3 n = unit_normal(mesh_, triangle);
  double sharpest = 0;
  for (const int t : mesh_.skin_fan(v)) sharpest = std::max(sharpest, fold(n, unit_normal(mesh_, t)));
  return sharpest * norm(place - mesh_.position(v)) <= chord_tolerance_;
}

/// Where the path is about to leave the surface beside a vertex of its boundary, which may go there.
std::optional<Incision::Step> Incision::exit_at(int v, double s) const {
  if (chain_.empty() || !mesh_.on_boundary(v) || !may_reach(v)) return std::nullopt;
  const Vec3& position = mesh_.position(v);
  const std::vector<int> fan = mesh_.skin_fan(v);
  const auto spoke = [&](int t, int corner) {
    return mesh_.position(mesh_.triangle(t).vertex[(mesh_.triangle(t).corner(v) + corner) % 3]) - position;
  };
  const Vec3 onward = spoke(fan.front(), 1), outline = normalized(onward);
  Step step{Step::vertex, -1, v, position, s};
  for (int k = 0; k < Limits::newton_steps; ++k) {
    const PathFrame frame = path_.at(step.s);
    const double turn = dot(outline, frame.across);  // positive where the path leaves
    if (turn < Limits::exit_sine) return std::nullopt;
    step.place = position - (dot(position - frame.position, frame.across) / turn) * outline;
    step.s += dot(step.place - frame.position, frame.along);
  }
  const double way = norm(step.place - position), room = mesh_.room(v);
  if (way > options_.snap * std::min(norm(onward), norm(spoke(fan.back(), 2))) || step.s > path_.length() ||
      step.s - chain_.back().s < Limits::least_advance * room || !may_move(v, step.place))
    return std::nullopt;
  return quality_around(mesh_, v, step.place) >= Limits::exit_quality * quality_around(mesh_, v, position)
             ? std::optional(step)
             : std::nullopt;
}

bool Incision::may_reach(int v) const {
  if (chain_.empty()) return true;
  const int tip = tip_vertex();
  return v != tip && mesh_.triangle_with(tip, v) >= 0 && mesh_.triangle_with(v, tip) >= 0;
}

bool Incision::may_move(int v, const Vec3& place) const {
  if (mesh_.vertex(v).kind != VertexKind::skin) return false;
  if (!mesh_.on_boundary(v)) return true;
  // On a boundary only along it, where it is straight: the outline stays as it is.
  const auto fan = mesh_.skin_fan(v);
  const CutMesh::Triangle &first = mesh_.triangle(fan.front()), &last = mesh_.triangle(fan.back());
  const Vec3 out = mesh_.position(first.vertex[(first.corner(v) + 1) % 3]) - mesh_.position(v);
  const Vec3 in = mesh_.position(last.vertex[(last.corner(v) + 2) % 3]) - mesh_.position(v);
  const Vec3 step = place - mesh_.position(v);
  const auto parallel = [](const Vec3& a, const Vec3& b) {
    return norm(cross(a, b)) <= Limits::same_place * norm(a) * norm(b);
  };
  return norm(step) <= Limits::same_place * norm(out) || (parallel(in, out) && parallel(step, out));
}

/// Whether the path, drawn from its start to another place, would have to turn back at once.
bool Incision::begins_ahead(const Vec3& start, const Vec3& drawn_to) const {
  const Vec3 way = drawn_to - start;
  return chain_.empty() && dot(way, path_.at(0).along) > Limits::ahead_cosine * norm(way) &&
         norm(way) > Limits::same_place * path_.length();
}

std::vector<int> Incision::triangles_at(const Step& start) const {
  if (start.kind == Step::vertex) return mesh_.skin_fan(start.index);
  if (start.kind == Step::face) return {start.triangle};
  return {start.triangle, mesh_.triangle(start.triangle).neighbor[start.index]};
}

Incision::Step Incision::placed(int triangle, const Vec3& place, double s) const {
  const CutMesh::Triangle& t = mesh_.triangle(triangle);
  const bool end = chain_.empty() || s == path_.length();
  for (const int v : t.vertex) {
    const double room = room_of(v), away = norm(place - mesh_.position(v));
    if (away <= Limits::same_place * room && may_reach(v)) return {Step::vertex, -1, v, mesh_.position(v), s};
    const bool own = mesh_.vertex(v).parents[0] >= 0;  // made by cutting
    if (away <= (own ? Limits::farther_snap : 1) * options_.snap * room && may_move(v, place) &&
        keeps_fold(v, place, triangle))
      return {Step::vertex, -1, v, place, s};
    if (end && away <= options_.snap / Limits::path_snap_parts * room && may_reach(v) &&
        !begins_ahead(place, mesh_.position(v)))
      return {Step::vertex, -1, v, mesh_.position(v), s};
  }
  // A new vertex inside the triangle, or where it is close to an edge, one of that edge, bent to go through
  // it: whichever leaves the better triangles.
  Step best{Step::face, triangle, 0, place, s, true};
  Vec3 p[3];
  for (int i = 0; i < 3; ++i) p[i] = mesh_.position(t.vertex[i]);
  const Vec3 n = normalized(cross(p[1] - p[0], p[2] - p[0]));
  double least =
      std::min({quality(p[0], p[1], place, n), quality(p[1], p[2], place, n), quality(p[2], p[0], place, n)});
  for (int i = 0; i < 3; ++i) {
    const Vec3 &a = p[i], &b = p[(i + 1) % 3], &c = p[(i + 2) % 3];
    const double away = norm(cross(place - a, b - a)) / squared_norm(b - a);
    const int across = t.neighbor[i];
    const bool may_bend = across >= 0 && !mesh_.is_wall(across) &&
                          fold(n, unit_normal(mesh_, across)) * away * norm(b - a) <= chord_tolerance_;
    const bool border = across == CutMesh::boundary || mesh_.is_wall(across);
    const bool touches = border &&
                         away <= (end                           ? Limits::near_lip
                                  : across == CutMesh::boundary ? Limits::same_place
                                                                : 0) &&
                         (chain_.empty() || i == (t.corner(tip_vertex()) + 1) % 3);
    if (!(may_bend && away <= options_.snap / Limits::path_snap_parts) && !touches) continue;
    Vec3 on_edge = place;
    if (border) on_edge = lerp(a, b, std::clamp(dot(place - a, b - a) / squared_norm(b - a), 0.0, 1.0));
    if (border && begins_ahead(place, on_edge)) continue;
    double worst = std::min(quality(a, on_edge, c, n), quality(on_edge, b, c, n));
    if (may_bend) {
      const CutMesh::Triangle& other = mesh_.triangle(across);
      const Vec3& d = mesh_.position(other.vertex[(other.corner(t.vertex[i]) + 1) % 3]);
      const Vec3 m = normalized(cross(a - b, d - b));
      worst = std::min({worst, quality(b, place, d, m), quality(place, a, d, m)});
    }
    if (worst <= least) continue;
    least = worst;
    best = {Step::edge, triangle, i, on_edge, s, true};
  }
  return best;
}

}  // namespace cleft
