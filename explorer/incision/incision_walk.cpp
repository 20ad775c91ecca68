// How the path goes on: the decisions of the cut. The blade at s is the line through C(s) along N(s); where
// it pierces the surface is a curve that is followed from triangle to triangle of the tip's fan, by the exact
// sides on which the line passes the triangles' edges. Nothing is changed here.
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/text.h"
#include "explorer/incision/incision.h"
#include "explorer/incision/predicates.h"

namespace cleft {

namespace {

constexpr double tiny = 1e-9;  ///< relative to the length at hand: the same place
constexpr double near = 0.05;  ///< relative to an edge: an end of the path so near to a lip is on it

/// Whether the blade's line pierces a triangle that faces along N.
bool pierces(const CutMesh& mesh, int t, const Vec3& foot, const Vec3& head) {
  int sum = 0;
  for (int i = 0; i < 3; ++i) {
    const int side = line_beside_edge(foot, head, mesh.position(mesh.triangle(t).vertex[i]),
                                      mesh.position(mesh.triangle(t).vertex[(i + 1) % 3]));
    if (side < 0) return false;
    sum += side;
  }
  return sum > 0;
}

/// Where it does.
Vec3 piercing_point(const CutMesh& mesh, int t, const PathFrame& frame) {
  double part[3], sum = 0;
  for (int i = 0; i < 3; ++i) {
    const Vec3 a = mesh.position(mesh.triangle(t).vertex[(i + 1) % 3]) - frame.position,
               b = mesh.position(mesh.triangle(t).vertex[(i + 2) % 3]) - frame.position;
    part[i] = std::max(0.0, dot(frame.outward, cross(a, b)));
    sum += part[i];
  }
  Vec3 place;
  for (int i = 0; i < 3; ++i) place += (part[i] / sum) * mesh.position(mesh.triangle(t).vertex[i]);
  return place;
}

/// Height over longest edge, seen along `normal`: 0 for a degenerate triangle, negative for one turned over.
double quality(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& normal) {
  const double longest = std::max({squared_norm(b - a), squared_norm(c - b), squared_norm(a - c)});
  return dot(cross(b - a, c - a), normal) / longest;
}

/// Zero of a function that is at least 0 at lo and negative at hi: secant kept inside its bracket (Illinois).
template <class F>
double zero_between(double lo, double hi, const F& f) {
  double at_lo = f(lo), at_hi = f(hi);
  if (!(at_lo > 0)) return lo;
  if (!(at_hi < 0)) return hi;
  const double enough = 1e-13 * hi;
  double x = lo;
  for (int k = 0, last = 0; k < 60 && hi - lo > enough; ++k) {
    x = lo + at_lo * (hi - lo) / (at_lo - at_hi);
    const double y = f(x);
    if (y == 0) break;
    if (y > 0) {
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

double mean_spoke(const CutMesh& mesh, const std::vector<int>& fan, int v) {
  double sum = 0;
  for (const int t : fan)
    sum +=
        norm(mesh.position(mesh.triangle(t).vertex[(mesh.triangle(t).corner(v) + 1) % 3]) - mesh.position(v));
  return sum / static_cast<double>(fan.size());
}

int pierced(const CutMesh& mesh, const std::vector<int>& fan, const PathFrame& frame) {
  const Vec3 head = frame.position + frame.outward;
  for (const int t : fan)
    if (pierces(mesh, t, frame.position, head)) return t;
  return -1;
}

bool is_wall(const CutMesh& mesh, int t) { return t >= 0 && mesh.triangle(t).region != Region::skin; }

/// All vertices on the place of v, over the layers of the walls.
std::vector<int> on_the_same_place(const CutMesh& mesh, int v) {
  std::vector<int> found{v};
  for (std::size_t k = 0; k < found.size(); ++k)
    for (const int t : mesh.fan(found[k])) {
      const int twin = mesh.twin(t);
      if (twin < 0) continue;
      const int other = mesh.triangle(twin).vertex[CutMesh::twin_corner(mesh.triangle(t).corner(found[k]))];
      if (std::find(found.begin(), found.end(), other) == found.end()) found.push_back(other);
    }
  return found;
}

}  // namespace

std::optional<Incision::Step> Incision::start_on_face(double reach) const {
  std::optional<Step> best;
  const PathFrame frame = path_.at(0);
  const Vec3 head = frame.position + frame.outward;
  for (int t = 0; t < static_cast<int>(mesh_.triangles().size()); ++t) {
    if (is_wall(mesh_, t) || !pierces(mesh_, t, frame.position, head)) continue;
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
      if (is_wall(mesh_, t) || mesh_.triangle(t).neighbor[i] != CutMesh::boundary) continue;
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

Incision::Track Incision::entered(const std::vector<int>& fan, double size, double limit) const {
  // A little ahead of the tip the line is in the triangle that the path enters; how little, depends on how far
  // the path was drawn aside to a vertex.
  const double tip = chain_.back().s;
  double ahead = 0.1 * size;
  for (int k = 0; k < 44; ++k, ahead = k == 40 ? 0.15 * size : k > 40 ? 1.5 * ahead : ahead / 2) {
    const double s = std::min(tip + ahead, limit);
    const int triangle = pierced(mesh_, fan, path_.at(s));
    if (triangle >= 0) return {triangle, -1, s};
  }
  return {};
}

Incision::Track Incision::follow(int vertex, double limit) const {
  const std::vector<int> fan = mesh_.skin_fan(vertex);
  const double size = mean_spoke(mesh_, fan, vertex);
  Track track = entered(fan, size, limit);
  if (track.triangle < 0) return track;
  const double step = std::min(0.25 * size, path_.length() / 64);
  const int rounds = 4 * static_cast<int>(fan.size());
  for (int round = 0; track.s < limit;) {
    const double to = std::min(track.s + step, limit);
    const PathFrame frame = path_.at(to);
    const Vec3 head = frame.position + frame.outward;
    // Over which of its edges the line has gone first, if any.
    const CutMesh::Triangle& triangle = mesh_.triangle(track.triangle);
    int edge = -1;
    double first = to;
    for (int i = 0; i < 3; ++i) {
      const Vec3 &a = mesh_.position(triangle.vertex[i]), &b = mesh_.position(triangle.vertex[(i + 1) % 3]);
      if (line_beside_edge(frame.position, head, a, b) >= 0) continue;
      const double s = zero_between(track.s, to, [&](double x) {
        const PathFrame f = path_.at(x);
        return dot(f.outward, cross(a - f.position, b - f.position));
      });
      if (edge < 0 || s < first) first = s, edge = i;
    }
    if (edge < 0) {
      track.s = to;
      continue;
    }
    const int across = triangle.neighbor[edge];
    const bool spoke = edge != (triangle.corner(vertex) + 1) % 3;
    if (!spoke || across < 0 || is_wall(mesh_, across) || ++round > rounds) {
      track.edge = edge, track.s = first;
      return track;
    }
    track.triangle = across;
    track.s = first;
  }
  return track;
}

const Incision::Step& Incision::next_step() {
  if (next_) return *next_;
  if (state_.arrived && state_.from < 0) go_on_from_wound();
  const int tip = tip_vertex();
  const double s = chain_.back().s;
  const Track track = follow(tip, path_.length());
  if (track.triangle < 0) report_end();
  Step step = step_at(track);
  // A rest too short to be worth a vertex.
  const bool rest = track.edge < 0 && path_.length() - s < 0.003 * path_.length();
  if (rest) step.s = std::numeric_limits<double>::infinity();
  double within =
      step.s - s;  // the piece's length, halved as often as a vertex ahead draws it to itself again
  for (int k = 0; k < 40 && !rest && within > tiny * path_.length(); ++k) {
    const double error = chord_error(mesh_.position(tip), step.place, s, step.s);
    if (step.s - s > 1.25 * longest_step_)
      within = std::min(within, longest_step_);
    else if (too_soon_at_wound(step))
      within /= 2;
    else if (error > chord_tolerance_)
      within /= std::max(2.0, std::ceil(std::sqrt(error / chord_tolerance_)));
    else
      break;
    const double before = step.s;
    step = shorter(step, s + within);
    within = step.s < before ? step.s - s : within / 2;
  }
  next_ = step;
  return *next_;
}

Incision::Step Incision::shorter(const Step& step, double to) const {
  const Track track = follow(tip_vertex(), to);
  if (track.triangle < 0) return step;
  return step_at(track);
}

Incision::Step Incision::step_at(const Track& track) const {
  if (track.edge < 0)
    return placed(track.triangle, piercing_point(mesh_, track.triangle, path_.at(track.s)), track.s);
  const Step step = crossing(track);
  return snapped(step).value_or(step);
}

bool Incision::too_soon_at_wound(const Step& step) const {
  // A piece between two wounds, or behind one, needs a vertex that opens.
  const bool first = state_.from >= 0 || chain_.size() == state_.piece + 1;
  if (!first || (state_.from < 0 && state_.start == End::boundary)) return false;
  if (state_.from >= 0 && step.s == path_.length()) return true;
  if (step.kind == Step::vertex) return mesh_.on_wound(step.index);
  return step.kind == Step::edge && is_wall(mesh_, mesh_.triangle(step.triangle).neighbor[step.index]);
}

void Incision::go_on_from_wound() {
  const std::vector<int> places = on_the_same_place(mesh_, chain_.back().left);
  for (const double part : {0.1, 0.03, 0.3, 0.01, 0.003, 0.001})
    for (const int v : places) {
      if (mesh_.triangle(mesh_.vertex(v).triangle).region != Region::skin) continue;
      const std::vector<int> fan = mesh_.skin_fan(v);
      const double s = chain_.back().s + part * mean_spoke(mesh_, fan, v);
      if (s > path_.length() || pierced(mesh_, fan, path_.at(s)) < 0) continue;
      state_.from = v;
      return;
    }
  report_end();
}

Incision::Step Incision::crossing(const Track& track) const {
  const CutMesh::Triangle& t = mesh_.triangle(track.triangle);
  const int across = t.neighbor[track.edge];
  if (across == CutMesh::non_manifold) {
    throw InputError("the path meets an edge that more than two triangles share at arc length " +
                     shortest(track.s) + ", near " + place_of(mesh_.position(t.vertex[track.edge])) +
                     "; end it before, or repair the mesh there");
  }
  const Vec3 &a = mesh_.position(t.vertex[track.edge]), &b = mesh_.position(t.vertex[(track.edge + 1) % 3]);
  const PathFrame frame = path_.at(track.s);
  // Against the plane of the line that stands most upright on the edge.
  const Vec3 edge = b - a, upright = edge - dot(edge, frame.outward) * frame.outward;
  const double part = std::clamp(dot(frame.position - a, upright) / dot(edge, upright), 0.0, 1.0);
  return {Step::edge, track.triangle, track.edge, lerp(a, b, part), track.s};
}

std::optional<Incision::Step> Incision::snapped(const Step& crossing) const {
  const CutMesh::Triangle& t = mesh_.triangle(crossing.triangle);
  std::optional<Step> best;
  double least = options_.snap;
  for (const int v : {t.vertex[crossing.index], t.vertex[(crossing.index + 1) % 3]}) {
    const Vec3& position = mesh_.position(v);
    const double room = mesh_.room(v), to_crossing = norm(crossing.place - position);
    Step step{Step::vertex, -1, v, position, crossing.s};
    if (mesh_.vertex(v).kind != VertexKind::skin || (mesh_.on_boundary(v) && !may_move(v, crossing.place))) {
      // What cannot be moved draws the path to itself.
      if (to_crossing > least / 2 * room || !may_reach(v)) continue;
      least = 2 * to_crossing / room;
      best = step;
      continue;
    }
    if (mesh_.on_boundary(v)) {
      if (to_crossing > least * room) continue;
      least = to_crossing / room;
      step.place = to_crossing <= tiny * room ? position : crossing.place;
      best = step;
      continue;
    }
    PathFrame frame = path_.at(step.s);
    for (int k = 0; k < 3; ++k) {
      step.s += dot(position - frame.position, frame.along);
      frame = path_.at(step.s);
    }
    const double away = std::abs(dot(position - frame.position, frame.across)) / room;
    if (away > least || step.s - chain_.back().s < 0.1 * room ||
        step.s - path_.length() > options_.snap * room)
      continue;
    if (away > tiny) {
      const int triangle = pierced(mesh_, mesh_.skin_fan(v), frame);
      if (triangle < 0) continue;
      step.place = piercing_point(mesh_, triangle, frame);
      if (norm(step.place - position) > 1.5 * options_.snap * room) continue;
    }
    step.s = std::min(step.s, path_.length());
    least = away;
    best = step;
  }
  return best;
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
    return norm(cross(a, b)) <= tiny * norm(a) * norm(b);
  };
  return norm(step) <= tiny * norm(out) || (parallel(in, out) && parallel(step, out));
}

Incision::Step Incision::placed(int triangle, const Vec3& place, double s) const {
  const CutMesh::Triangle& t = mesh_.triangle(triangle);
  const bool end = chain_.empty() || s == path_.length();
  for (const int v : t.vertex) {
    const double room = mesh_.room(v), away = norm(place - mesh_.position(v));
    if (away <= tiny * room && may_reach(v)) return {Step::vertex, -1, v, mesh_.position(v), s};
    if (away <= options_.snap * room && may_move(v, place)) return {Step::vertex, -1, v, place, s};
    if (end && away <= options_.snap / 2 * room && may_reach(v))
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
    const bool may_bend = across >= 0 && !is_wall(mesh_, across);
    const bool border = across == CutMesh::boundary || is_wall(mesh_, across);
    const bool touches = border &&
                         away <= (end                           ? near
                                  : across == CutMesh::boundary ? tiny
                                                                : 0) &&
                         (chain_.empty() || i == (t.corner(tip_vertex()) + 1) % 3);
    if (!(may_bend && away <= options_.snap / 2) && !touches) continue;
    Vec3 on_edge = place;
    if (border) on_edge = lerp(a, b, std::clamp(dot(place - a, b - a) / squared_norm(b - a), 0.0, 1.0));
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

double Incision::chord_error(const Vec3& from, const Vec3& to, double s_from, double s_to) const {
  const Vec3 chord = to - from;
  double largest = 0;
  constexpr int samples = 8;
  for (int k = 1; k < samples; ++k) {
    const PathFrame frame = path_.at(s_from + (s_to - s_from) * k / samples);
    const Vec3 across = cross(frame.outward, chord);
    const double length = norm(across);
    if (length == 0) continue;
    const Vec3 way = frame.position - from;
    // Between the lines; and how far the blade is before the chord's beginning or behind its end.
    const Vec3 along = cross(across, frame.outward);
    const double part = dot(way, along) / dot(chord, along);
    const double outside = std::max({0.0, -part, part - 1}) * norm(chord);
    largest = std::max({largest, std::abs(dot(way, across)) / length, outside});
  }
  return largest;
}

double Incision::chord_error() const {
  double largest = 0;
  for (std::size_t i = 1; i < chain_.size(); ++i)
    if (chain_[i].s > chain_[i - 1].s)
      largest = std::max(largest, chord_error(mesh_.position(chain_[i - 1].left),
                                              mesh_.position(chain_[i].left), chain_[i - 1].s, chain_[i].s));
  return largest;
}

void Incision::report_end() const {
  throw InputError("the path leaves the surface near " + place_of(mesh_.position(tip_vertex())) +
                   ", at arc length " + shortest(chain_.back().s) +
                   ": its directions (nx, ny, nz) must point out of the surface there");
}

}  // namespace cleft
