// How the path goes on: the decisions of the cut. Where the blade's line pierces the surface is a curve that
// is followed from triangle to triangle of the tip's fan, by the exact sides on which the line passes the
// triangles' edges. Nothing is changed here.
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/text.h"
#include "explorer/incision/blade.h"
#include "explorer/incision/incision.h"
#include "explorer/incision/predicates.h"

namespace cleft {

namespace {

using Limits = IncisionTolerances;

double mean_spoke(const CutMesh& mesh, const std::vector<int>& fan, int v) {
  double sum = 0;
  for (const int t : fan)
    sum +=
        norm(mesh.position(mesh.triangle(t).vertex[(mesh.triangle(t).corner(v) + 1) % 3]) - mesh.position(v));
  return sum / static_cast<double>(fan.size());
}

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

Incision::Track Incision::entered(const std::vector<int>& fan, double size, double limit) const {
  // A little ahead of the tip the line is in the triangle that the path enters; how little, depends on how
  // far the path was drawn aside to a vertex.
  const double tip = chain_.back().s;
  constexpr int halvings = Limits::entry_halvings;
  double ahead = Limits::entry_step * size;
  for (int k = 0; k < Limits::entry_attempts; ++k) {
    if (k > 0)
      ahead = k == halvings  ? Limits::entry_long_step * size
              : k > halvings ? Limits::entry_growth * ahead
                             : ahead / 2;
    const double s = std::min(tip + ahead, limit);
    const int triangle = pierced(mesh_, fan, path_.at(s));
    if (triangle >= 0) return {triangle, -1, s};
  }
  return {};
}

/// That the path enters from the tip; -1: none.
int Incision::triangle_ahead() const {
  const std::vector<int> fan = mesh_.skin_fan(tip_vertex());
  return entered(fan, mean_spoke(mesh_, fan, tip_vertex()), path_.length()).triangle;
}

Incision::Track Incision::follow(int vertex, double limit) const {
  const std::vector<int> fan = mesh_.skin_fan(vertex);
  const double size = mean_spoke(mesh_, fan, vertex);
  Track track = entered(fan, size, limit);
  if (track.triangle < 0) return track;
  const double step = std::min(Limits::follow_step * size, path_.length() / Limits::follow_parts);
  const int rounds = Limits::turns_around_fan * static_cast<int>(fan.size());
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
    if (!spoke || across < 0 || mesh_.is_wall(across) || ++round > rounds) {
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
  const double s = chain_.back().s,
               too_short = Limits::shortest_rest * path_.length();  // a rest not worth a vertex
  if (state_.arrived && state_.from < 0 && !go_on_from_wound()) {
    if (path_.length() - s >= too_short) report_end();
    next_ = Step{Step::vertex, -1, -1, {}, std::numeric_limits<double>::infinity()};
    return *next_;
  }
  const int tip = tip_vertex();
  const Track track = follow(tip, path_.length());
  if (track.triangle < 0) report_end();
  Step step = step_at(track);
  const bool rest = track.edge < 0 && path_.length() - s < too_short;
  if (rest) step.s = std::numeric_limits<double>::infinity();
  double within =
      step.s - s;  // the piece's length, halved as often as a vertex ahead draws it to itself again
  for (int k = 0; k < Limits::piece_halvings && !rest && within > Limits::same_place * path_.length(); ++k) {
    const double error = chord_error(mesh_.position(tip), step.place, s, step.s);
    if (step.s - s > Limits::longer_piece * longest_step_)
      within = std::min(within, longest_step_);
    else if (too_soon_at_wound(step))
      within /= 2;
    else if (error > chord_tolerance_)
      within /= std::max(2.0, std::ceil(std::sqrt(error / chord_tolerance_)));
    else
      break;
    const double before = step.s;
    step = shorter(step, s + within);
    within = step.s < before ? std::min(within, step.s - s) : within / 2;
  }
  next_ = step;
  return *next_;
}

Incision::Step Incision::shorter(const Step& step, double to) const {
  const Track track = follow(tip_vertex(), to);
  if (track.triangle < 0) return step;
  const Step next = step_at(track);
  if (track.edge < 0 || next.kind != Step::vertex || next.s <= to) return next;
  // Behind the edge the path bends before it comes to the vertex: no straight piece leads there.
  const Step plain = crossing(track);
  return snapped(plain, to).value_or(plain);
}

Incision::Step Incision::step_at(const Track& track) const {
  if (track.edge < 0)
    return placed(track.triangle, piercing_point(mesh_, track.triangle, path_.at(track.s)), track.s);
  const Step step = crossing(track);
  return snapped(step, std::numeric_limits<double>::infinity()).value_or(step);
}

bool Incision::too_soon_at_wound(const Step& step) const {
  // A piece between two wounds, or behind one, needs a vertex that opens.
  const bool first = state_.from >= 0 || chain_.size() == state_.piece + 1;
  if (!first || (state_.from < 0 && state_.start == End::boundary)) return false;
  if (state_.from >= 0 && step.s == path_.length()) return true;
  if (step.kind == Step::vertex) return mesh_.on_wound(step.index);
  return step.kind == Step::edge && mesh_.is_wall(mesh_.triangle(step.triangle).neighbor[step.index]);
}

bool Incision::wounds_cross_at(int v) const {
  const std::vector<int> places = on_the_same_place(mesh_, v);
  return std::count_if(places.begin(), places.end(), [&](int place) {
           return mesh_.is_skin(mesh_.vertex(place).triangle);
         }) >= Limits::corners_where_wounds_cross;
}

bool Incision::go_on_from_wound() {
  const std::vector<int> places = on_the_same_place(mesh_, chain_.back().left);
  for (const double part : Limits::steps_over_wound)
    for (const int v : places) {
      if (mesh_.triangle(mesh_.vertex(v).triangle).region != Region::skin) continue;
      const std::vector<int> fan = mesh_.skin_fan(v);
      const double s = chain_.back().s + part * mean_spoke(mesh_, fan, v);
      if (s > path_.length() || pierced(mesh_, fan, path_.at(s)) < 0) continue;
      state_.from = v;
      return true;
    }
  return false;
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

double Incision::chord_error(const Vec3& from, const Vec3& to, double s_from, double s_to) const {
  const Vec3 chord = to - from;
  double largest = 0;
  constexpr int samples = Limits::chord_samples;
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
