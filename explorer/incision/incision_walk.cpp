// How the path goes on: the decisions of the cut, all of them made from the blade's coordinates (s, v, w) of
// points. Nothing is changed here.
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/text.h"
#include "explorer/incision/incision.h"

namespace cleft {

namespace {

constexpr double tiny = 1e-9;  ///< relative to the length at hand: the same place

/// The one decision about sides: whether the path passes between a (right of it, or on it) and b (left of
/// it).
bool passes_between(const PathCoordinates& a, const PathCoordinates& b) { return a.v <= 0 && b.v >= 0; }

/// Where the line C(s) + w N(s) pierces a triangle that faces along N, if it does.
std::optional<Vec3> pierce(const CutMesh& mesh, int t, const PathFrame& frame, double* height) {
  double a[3], b[3], w[3];
  for (int i = 0; i < 3; ++i) {
    const Vec3 d = mesh.position(mesh.triangle(t).vertex[i]) - frame.position;
    a[i] = dot(d, frame.along), b[i] = dot(d, frame.across), w[i] = dot(d, frame.outward);
  }
  const double twice_area = (a[1] - a[0]) * (b[2] - b[0]) - (a[2] - a[0]) * (b[1] - b[0]);
  if (!(twice_area > 0)) return std::nullopt;
  Vec3 place;
  *height = 0;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const double part = (a[j] * b[k] - a[k] * b[j]) / twice_area;
    if (part < -tiny) return std::nullopt;
    place += part * mesh.position(mesh.triangle(t).vertex[i]);
    *height += part * w[i];
  }
  return place;
}

/// Height over longest edge, seen along `normal`: 0 for a degenerate triangle, negative for one turned over.
double quality(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& normal) {
  const double longest = std::max({squared_norm(b - a), squared_norm(c - b), squared_norm(a - c)});
  return dot(cross(b - a, c - a), normal) / longest;
}

/// Zero of an increasing-through-zero function on [lo, hi]: secant kept inside its bracket (Illinois).
template <class F>
double zero_between(double lo, double hi, double at_lo, double at_hi, const F& f) {
  if (at_lo == 0) return lo;
  if (at_hi == 0) return hi;
  double x = lo;
  for (int k = 0, last = 0; k < 60 && hi - lo > 1e-15; ++k) {
    x = lo - at_lo * (hi - lo) / (at_hi - at_lo);
    const double y = f(x);
    if (y == 0) break;
    if ((y < 0) == (at_lo < 0)) {
      lo = x, at_lo = y;
      if (last == -1) at_hi /= 2;
      last = -1;
    } else {
      hi = x, at_hi = y;
      if (last == 1) at_lo /= 2;
      last = 1;
    }
  }
  return x;
}

}  // namespace

PathCoordinates Incision::beside(const Vec3& x) const {
  const double reach = 3 * norm(x - mesh_.position(tip_vertex()));
  return path_.coordinates(x, chain_.back().s - reach, chain_.back().s + reach);
}

std::optional<Incision::Step> Incision::start_on_face(double reach) const {
  std::optional<Step> best;
  const PathFrame frame = path_.at(0);
  for (int t = 0; t < static_cast<int>(mesh_.triangles().size()); ++t) {
    double height;
    const auto place = pierce(mesh_, t, frame, &height);
    if (!place || std::abs(height) > reach) continue;
    reach = std::abs(height);
    best = Step{Step::face, t, 0, *place, 0};
  }
  if (best) best = placed(best->triangle, best->place, 0);
  return best;
}

std::optional<Incision::Step> Incision::start_on_boundary(double reach) const {
  std::optional<Step> best;
  for (int t = 0; t < static_cast<int>(mesh_.triangles().size()); ++t)
    for (int i = 0; i < 3; ++i) {
      if (mesh_.triangle(t).neighbor[i] != CutMesh::boundary) continue;
      const Vec3 &a = mesh_.position(mesh_.triangle(t).vertex[i]),
                 &b = mesh_.position(mesh_.triangle(t).vertex[(i + 1) % 3]);
      const PathCoordinates at_a = path_.coordinates(a), at_b = path_.coordinates(b);
      // The path comes in where the boundary, followed with the surface on its left, passes from left to
      // right.
      if (!passes_between(at_b, at_a)) continue;
      const double part =
          zero_between(0, 1, at_a.v, at_b.v, [&](double x) { return path_.coordinates(lerp(a, b, x)).v; });
      const Vec3 place = lerp(a, b, part);
      const PathCoordinates at = path_.coordinates(place);
      if (std::abs(at.w) > reach || at.s < 0 || at.s >= path_.length() || (best && best->s <= at.s)) continue;
      best = Step{Step::edge, t, i, place, at.s};
    }
  if (best) best = placed(best->triangle, best->place, best->s);
  return best;
}

const Incision::Step& Incision::next_step() {
  if (next_) return *next_;
  const double s = chain_.back().s;
  auto step = exit_of_fan(1, true);
  if (!step) step = Step{Step::face, -1, 0, {}, std::numeric_limits<double>::infinity()};
  for (int k = 0; k < 20; ++k) {
    double to;
    if (step->s - s > 1.25 * longest_step_)
      to = s + longest_step_;
    else if (chord_error(step->place) > chord_tolerance_)
      to = (s + step->s) / 2;
    else
      break;
    if (const auto nearer = inside_fan(tip_vertex(), to)) {
      step = placed(nearer->triangle, nearer->place, to);
      continue;
    }
    // The path has left the fan before: over an edge on the way to a near vertex, or twice over a single
    // edge, which shows on smaller pieces of the edges.
    const auto earlier = exit_of_fan(16, false);
    if (!earlier || earlier->s >= step->s) break;
    step = earlier;
  }
  next_ = step;
  return *next_;
}

std::optional<Incision::Step> Incision::exit_of_fan(int pieces, bool snap) const {
  std::optional<Step> best;
  const double tip = chain_.back().s;
  for (const int t : mesh_.skin_fan(tip_vertex())) {
    const int i = (mesh_.triangle(t).corner(tip_vertex()) + 1) % 3;
    const Vec3 &a = mesh_.position(mesh_.triangle(t).vertex[i]),
               &b = mesh_.position(mesh_.triangle(t).vertex[(i + 1) % 3]);
    const auto on_edge = [&](double part) { return beside(lerp(a, b, part)); };
    PathCoordinates end = beside(a);
    for (int piece = 0; piece < pieces; ++piece) {
      double from = double(piece) / pieces, to = double(piece + 1) / pieces;
      PathCoordinates at_from = end, at_to = end = piece + 1 == pieces ? beside(b) : on_edge(to);
      if (at_from.s <= tip && at_to.s <= tip) continue;
      if (at_from.s < tip || at_to.s < tip) {  // only the part that lies ahead
        const double cut = zero_between(from, to, at_from.s - tip, at_to.s - tip,
                                        [&](double part) { return on_edge(part).s - tip; });
        at_from.s < tip ? (from = cut, at_from = on_edge(cut)) : (to = cut, at_to = on_edge(cut));
      }
      if (!passes_between(at_from, at_to)) continue;
      const double part = zero_between(from, to, at_from.v, at_to.v, [&](double x) { return on_edge(x).v; });
      const Vec3 place = lerp(a, b, part);
      const double s = beside(place).s;
      if (s <= tip + tiny * path_.length() || (best && best->s <= s)) continue;
      best = Step{Step::edge, t, i, place, s};
    }
  }
  if (!best) return best;
  const int across = mesh_.triangle(best->triangle).neighbor[best->index];
  if (across == CutMesh::non_manifold) mesh_.skin_fan(mesh_.triangle(best->triangle).vertex[best->index]);
  if (across == CutMesh::non_manifold || (across >= 0 && mesh_.triangle(across).region != Region::skin))
    throw InputError("the path meets " +
                     std::string(across >= 0 ? "its own cut" : "an edge that more than two triangles share") +
                     " at arc length " + shortest(best->s) + "; end it before");
  const auto vertex = snap ? snapped(*best) : std::nullopt;
  return vertex ? vertex : best;
}

std::optional<Incision::Step> Incision::snapped(const Step& crossing) const {
  const CutMesh::Triangle& t = mesh_.triangle(crossing.triangle);
  std::optional<Step> best;
  double least = options_.snap;
  for (const int v : {t.vertex[crossing.index], t.vertex[(crossing.index + 1) % 3]}) {
    if (mesh_.vertex(v).kind != VertexKind::skin) continue;
    const PathCoordinates at = beside(mesh_.position(v));
    const double away = std::abs(at.v) / mesh_.room(v);
    if (at.s <= chain_.back().s || away > least) continue;
    Step step{Step::vertex, -1, v, mesh_.position(v), at.s};
    if (away > tiny) {
      if (mesh_.on_boundary(v)) {
        step.place = crossing.place, step.s = crossing.s;
        if (norm(step.place - mesh_.position(v)) > options_.snap * mesh_.room(v)) continue;
      } else {
        const auto place = inside_fan(v, at.s);
        step.place = place ? place->place : mesh_.position(v) - at.v * path_.at(at.s).across;
      }
      if (!may_move(v, step.place)) continue;
    }
    least = away;
    best = step;
  }
  return best;
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
    return norm(cross(a, b)) <= tiny * norm(a) * norm(b);
  };
  return norm(step) <= tiny * norm(out) || (parallel(in, out) && parallel(step, out));
}

std::optional<Incision::Step> Incision::inside_fan(int v, double s) const {
  const PathFrame frame = path_.at(s);
  const double here = dot(mesh_.position(v) - frame.position, frame.outward);
  std::optional<Step> best;
  double least = std::numeric_limits<double>::infinity();
  for (const int t : mesh_.skin_fan(v)) {
    double height;
    const auto place = pierce(mesh_, t, frame, &height);
    if (!place || std::abs(height - here) >= least) continue;
    least = std::abs(height - here);
    best = Step{Step::face, t, 0, *place, s};
  }
  return best;
}

Incision::Step Incision::on_chord(const Step& next, double s) const {
  const int tip = tip_vertex();
  const bool to_vertex = next.kind == Step::vertex;
  const Vec3& to = to_vertex ? mesh_.position(next.index) : next.place;
  const int triangle = to_vertex ? mesh_.triangle_with(tip, next.index) : next.triangle;
  return placed(triangle, lerp(mesh_.position(tip), to, (s - chain_.back().s) / (next.s - chain_.back().s)),
                s);
}

Incision::Step Incision::placed(int triangle, const Vec3& place, double s) const {
  const CutMesh::Triangle& t = mesh_.triangle(triangle);
  for (const int v : t.vertex)
    if (norm(place - mesh_.position(v)) <= options_.snap * mesh_.room(v) && may_move(v, place)) {
      const bool same = norm(place - mesh_.position(v)) <= tiny * mesh_.room(v);
      return {Step::vertex, -1, v, same ? mesh_.position(v) : place, s};
    }
  // A new vertex inside the triangle, or where it is close to an edge, one of that edge, bent to go through
  // it: whichever leaves the better triangles.
  Step best{Step::face, triangle, 0, place, s};
  Vec3 p[3];
  for (int i = 0; i < 3; ++i) p[i] = mesh_.position(t.vertex[i]);
  const Vec3 n = normalized(cross(p[1] - p[0], p[2] - p[0]));
  double least =
      std::min({quality(p[0], p[1], place, n), quality(p[1], p[2], place, n), quality(p[2], p[0], place, n)});
  for (int i = 0; i < 3; ++i) {
    const Vec3 &a = p[i], &b = p[(i + 1) % 3], &c = p[(i + 2) % 3];
    const double away = norm(cross(place - a, b - a)) / squared_norm(b - a);
    const int across = t.neighbor[i];
    const bool may_bend = across >= 0 && mesh_.triangle(across).region == Region::skin;
    if (!(may_bend && away <= options_.snap / 2) && !(across == CutMesh::boundary && away <= tiny)) continue;
    double worst = std::min(quality(a, place, c, n), quality(place, b, c, n));
    if (may_bend) {
      const CutMesh::Triangle& other = mesh_.triangle(across);
      const Vec3& d = mesh_.position(other.vertex[(other.corner(t.vertex[i]) + 1) % 3]);
      const Vec3 m = normalized(cross(a - b, d - b));
      worst = std::min({worst, quality(b, place, d, m), quality(place, a, d, m)});
    }
    if (worst <= least) continue;
    least = worst;
    best = {Step::edge, triangle, i, place, s};
  }
  return best;
}

double Incision::chord_error(const Vec3& to) const {
  const Vec3& from = mesh_.position(tip_vertex());
  double largest = 0;
  constexpr int samples = 8;
  for (int k = 1; k < samples; ++k)
    largest = std::max(largest, std::abs(beside(lerp(from, to, double(k) / samples)).v));
  return largest;
}

}  // namespace cleft
