#include "explorer/incision/incision_places.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "explorer/incision/blade.h"
#include "explorer/incision/incision_walk.h"

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

/// How far a vertex may move, or the path be snapped to it: not so far that a short path would lose its
/// shape.
double room_of(const IncisionState& cut, int v) { return std::min(cut.mesh.room(v), cut.longest_piece); }

/// Whether the path can go straight from the tip to a vertex: along an edge of the skin.
bool may_reach(const IncisionState& cut, int v) {
  if (cut.chain.empty()) return true;
  const int tip = cut.tip_vertex();
  return v != tip && cut.mesh.triangle_with(tip, v) >= 0 && cut.mesh.triangle_with(v, tip) >= 0;
}

/// Whether a vertex may be moved to a place.
bool may_move(const IncisionState& cut, int v, const Vec3& place) {
  if (cut.mesh.vertex(v).kind != VertexKind::skin) return false;
  if (!cut.mesh.on_boundary(v)) return true;
  // On a boundary only along it, where it is straight: the outline stays as it is.
  const auto fan = cut.mesh.skin_fan(v);
  const CutMesh::Triangle &first = cut.mesh.triangle(fan.front()), &last = cut.mesh.triangle(fan.back());
  const Vec3 out = cut.mesh.position(first.vertex[(first.corner(v) + 1) % 3]) - cut.mesh.position(v);
  const Vec3 in = cut.mesh.position(last.vertex[(last.corner(v) + 2) % 3]) - cut.mesh.position(v);
  const Vec3 step = place - cut.mesh.position(v);
  const auto parallel = [](const Vec3& a, const Vec3& b) {
    return norm(cross(a, b)) <= Limits::same_place * norm(a) * norm(b);
  };
  return norm(step) <= Limits::same_place * norm(out) || (parallel(in, out) && parallel(step, out));
}

/// Where, near s, the path passes a place.
double beside(const IncisionState& cut, const Vec3& place, double s) {
  for (int k = 0; k < Limits::newton_steps; ++k) {
    const PathFrame frame = cut.path.at(s);
    s += dot(place - frame.position, frame.along);
  }
  return s;
}

/// Whether the path, snapped to a vertex of a lip or of the outline, would run along that edge, so close that
/// no triangle fits between (one with the angle a has a radius ratio below 2 a), while without snapping it
/// would not.
bool snapped_along_edge(const IncisionState& cut, int v, double s) {
  const auto aside = [&](int w) {
    const PathFrame frame = cut.path.at(beside(cut, cut.mesh.position(w), s));
    return dot(cut.mesh.position(w) - frame.position, frame.across);
  };
  const std::vector<int> fan = cut.mesh.skin_fan(v);
  const CutMesh::Triangle &first = cut.mesh.triangle(fan.front()), &last = cut.mesh.triangle(fan.back());
  const double at_vertex = aside(v);
  for (const int w : {first.vertex[(first.corner(v) + 1) % 3], last.vertex[(last.corner(v) + 2) % 3]}) {
    // The wedge's breadth at w, and how far the path comes nearer to or farther from the edge by itself.
    const double breadth = std::abs(aside(w)), by_itself = std::abs(aside(w) - at_vertex),
                 least = cut.least_ratio * norm(cut.mesh.position(w) - cut.mesh.position(v));
    if (breadth < least && by_itself >= std::max(least / 2, Limits::snapped_wedge * breadth)) return true;
  }
  return false;
}

/// Whether a vertex may move to a place in one of its triangles: the faces around it then move by no more
/// than lips may stray.
bool keeps_fold(const IncisionState& cut, int v, const Vec3& place, int triangle) {
  const Vec3 n = unit_normal(cut.mesh, triangle);
  double sharpest = 0;
  for (const int t : cut.mesh.skin_fan(v)) sharpest = std::max(sharpest, fold(n, unit_normal(cut.mesh, t)));
  return sharpest * norm(place - cut.mesh.position(v)) <= cut.chord_tolerance;
}

/// Where the path is about to leave the surface beside a vertex of its boundary, which may go there.
std::optional<PathStep> exit_at(const IncisionState& cut, int v, double s) {
  if (cut.chain.empty() || !cut.mesh.on_boundary(v) || !may_reach(cut, v)) return std::nullopt;
  const Vec3& position = cut.mesh.position(v);
  const std::vector<int> fan = cut.mesh.skin_fan(v);
  const auto spoke = [&](int t, int corner) {
    return cut.mesh.position(cut.mesh.triangle(t).vertex[(cut.mesh.triangle(t).corner(v) + corner) % 3]) -
           position;
  };
  const Vec3 onward = spoke(fan.front(), 1), outline = normalized(onward);
  PathStep step{PathStep::vertex, -1, v, position, s};
  for (int k = 0; k < Limits::newton_steps; ++k) {
    const PathFrame frame = cut.path.at(step.s);
    const double turn = dot(outline, frame.across);  // positive where the path leaves
    if (turn < Limits::exit_sine) return std::nullopt;
    step.place = position - (dot(position - frame.position, frame.across) / turn) * outline;
    step.s += dot(step.place - frame.position, frame.along);
  }
  const double way = norm(step.place - position), room = cut.mesh.room(v);
  if (way > cut.snap * std::min(norm(onward), norm(spoke(fan.back(), 2))) || step.s > cut.path.length() ||
      step.s - cut.chain.back().s < Limits::least_advance * room || !may_move(cut, v, step.place))
    return std::nullopt;
  return quality_around(cut.mesh, v, step.place) >=
                 Limits::exit_quality * quality_around(cut.mesh, v, position)
             ? std::optional(step)
             : std::nullopt;
}

/// Whether the path, snapped from its start to another place, would have to turn back at once. `size` is of
/// the triangles there.
bool begins_ahead(const IncisionState& cut, const Vec3& start, const Vec3& snapped_to, double size) {
  const Vec3 way = snapped_to - start;
  return cut.chain.empty() && dot(way, cut.path.at(0).along) > Limits::ahead_cosine * norm(way) &&
         norm(way) > std::max(Limits::same_place * cut.path.length(), Limits::same_start * size);
}

}  // namespace

std::optional<PathStep> snapped(const IncisionState& cut, const PathStep& crossing, double to) {
  const CutMesh::Triangle& t = cut.mesh.triangle(crossing.triangle);
  std::optional<PathStep> best;
  double least = cut.snap;
  for (const int v : {t.vertex[crossing.index], t.vertex[(crossing.index + 1) % 3]}) {
    const Vec3& position = cut.mesh.position(v);
    const double room = room_of(cut, v), to_crossing = norm(crossing.place - position);
    PathStep step{PathStep::vertex, -1, v, position, crossing.s};
    if (const auto exit = exit_at(cut, v, crossing.s)) return exit;
    if (cut.mesh.vertex(v).kind != VertexKind::skin ||
        (cut.mesh.on_boundary(v) && !may_move(cut, v, crossing.place))) {
      // The path is snapped to what cannot be moved.
      if (to_crossing > least / Limits::path_snap_parts * room || !may_reach(cut, v) ||
          snapped_along_edge(cut, v, crossing.s))
        continue;
      // No third wound can be sewn in there; nearer, it would leave needles beside the place.
      if (to_crossing > cut.least_ratio * room && wounds_cross_at(cut, v)) continue;
      least = Limits::path_snap_parts * to_crossing / room;
      if (cut.mesh.on_wound(v))  // not to turn back from there
        step.s = std::clamp(beside(cut, position, crossing.s), crossing.s, cut.path.length());
      best = step;
      continue;
    }
    if (cut.mesh.on_boundary(v)) {
      if (to_crossing > least * room) continue;
      least = to_crossing / room;
      step.place = to_crossing <= Limits::same_place * room ? position : crossing.place;
      best = step;
      continue;
    }
    step.s = beside(cut, position, crossing.s);
    const PathFrame frame = cut.path.at(step.s);
    const double away = std::abs(dot(position - frame.position, frame.across)) / room;
    if (away > least || step.s - cut.chain.back().s < Limits::least_advance * room ||
        step.s - crossing.s > cut.longest_piece || step.s - cut.path.length() > cut.snap * room ||
        (step.s > to && to_crossing > cut.snap * room))
      continue;
    if (away > Limits::same_place) {
      const int triangle = pierced(cut.mesh, cut.mesh.skin_fan(v), frame);
      if (triangle >= 0) step.place = piercing_point(cut.mesh, triangle, frame);
      // On the outline of what the blade sees it passes the vertex by, and the path is snapped to the vertex.
      if (triangle < 0 ? away * room > cut.chord_tolerance / Limits::bend_parts
                       : norm(step.place - position) > Limits::farther_snap * cut.snap * room ||
                             !keeps_fold(cut, v, step.place, triangle))
        continue;
    }
    step.s = std::min(step.s, cut.path.length());
    least = away;
    best = step;
  }
  return best;
}

PathStep placed(const IncisionState& cut, int triangle, const Vec3& place, double s) {
  const CutMesh::Triangle& t = cut.mesh.triangle(triangle);
  const bool end = cut.chain.empty() || s == cut.path.length();
  for (const int v : t.vertex) {
    const double room = room_of(cut, v), away = norm(place - cut.mesh.position(v));
    if (away <= Limits::same_place * room && may_reach(cut, v))
      return {PathStep::vertex, -1, v, cut.mesh.position(v), s};
    const bool own = cut.mesh.vertex(v).parents[0] >= 0;  // made by cutting
    if (away <= (own ? Limits::farther_snap : 1) * cut.snap * room && may_move(cut, v, place) &&
        keeps_fold(cut, v, place, triangle))
      return {PathStep::vertex, -1, v, place, s};
    if (end && away <= cut.snap / Limits::path_snap_parts * room && may_reach(cut, v) &&
        !begins_ahead(cut, place, cut.mesh.position(v), room))
      return {PathStep::vertex, -1, v, cut.mesh.position(v), s};
  }
  // A new vertex inside the triangle, or where it is close to an edge, one of that edge, bent to go through
  // it: whichever leaves the better triangles.
  PathStep best{PathStep::face, triangle, 0, place, s, true};
  Vec3 p[3];
  for (int i = 0; i < 3; ++i) p[i] = cut.mesh.position(t.vertex[i]);
  const Vec3 n = normalized(cross(p[1] - p[0], p[2] - p[0]));
  double least =
      std::min({quality(p[0], p[1], place, n), quality(p[1], p[2], place, n), quality(p[2], p[0], place, n)});
  for (int i = 0; i < 3; ++i) {
    const Vec3 &a = p[i], &b = p[(i + 1) % 3], &c = p[(i + 2) % 3];
    const double away = norm(cross(place - a, b - a)) / squared_norm(b - a);
    const int across = t.neighbor[i];
    const bool may_bend = across >= 0 && !cut.mesh.is_wall(across) &&
                          fold(n, unit_normal(cut.mesh, across)) * away * norm(b - a) <= cut.chord_tolerance;
    const bool border = across == CutMesh::boundary || cut.mesh.is_wall(across);
    const bool touches = border &&
                         away <= (end                           ? Limits::near_lip
                                  : across == CutMesh::boundary ? Limits::same_place
                                                                : 0) &&
                         (cut.chain.empty() || i == (t.corner(cut.tip_vertex()) + 1) % 3);
    if (!(may_bend && away <= cut.snap / Limits::path_snap_parts) && !touches) continue;
    Vec3 on_edge = place;
    if (border) on_edge = lerp(a, b, std::clamp(dot(place - a, b - a) / squared_norm(b - a), 0.0, 1.0));
    if (border && begins_ahead(cut, place, on_edge, norm(b - a))) continue;
    double worst = std::min(quality(a, on_edge, c, n), quality(on_edge, b, c, n));
    if (may_bend) {
      const CutMesh::Triangle& other = cut.mesh.triangle(across);
      const Vec3& d = cut.mesh.position(other.vertex[(other.corner(t.vertex[i]) + 1) % 3]);
      const Vec3 m = normalized(cross(a - b, d - b));
      worst = std::min({worst, quality(b, place, d, m), quality(place, a, d, m)});
    }
    if (worst <= least) continue;
    least = worst;
    best = {PathStep::edge, triangle, i, on_edge, s, true};
  }
  return best;
}

}  // namespace cleft
