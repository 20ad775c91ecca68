#include "explorer/incision/incision_walk.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/text.h"
#include "explorer/incision/blade.h"
#include "explorer/incision/incision_places.h"
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

/// Where the blade's line is after a while: in a triangle of the tip's fan, or crossing its edge.
struct Track {
  int triangle = -1;  ///< -1: the line does not go on over the surface
  int edge = -1;      ///< -1: it has reached the given s
  double s = 0;
};

/// The triangle of a fan that the line is in just behind the tip.
Track entered(const IncisionState& cut, const std::vector<int>& fan, double size, double limit) {
  // A little ahead of the tip the line is in the triangle that the path enters; how little, depends on
  // how far away from the tip the path is that was snapped to it.
  const double tip = cut.chain.back().s;
  constexpr int halvings = Limits::entry_halvings;
  double ahead = Limits::entry_step * size;
  for (int k = 0; k < Limits::entry_attempts; ++k) {
    if (k > 0)
      ahead = k == halvings  ? Limits::entry_long_step * size
              : k > halvings ? Limits::entry_growth * ahead
                             : ahead / 2;
    const double s = std::min(tip + ahead, limit);
    const int triangle = pierced(cut.mesh, fan, cut.path.at(s));
    if (triangle >= 0) return {triangle, -1, s};
  }
  return {};
}

/// From a vertex on through its fan, to the edge by which the line leaves the fan or to `limit`: where the
/// line pierces the surface is a curve that is followed by the exact sides on which it passes the triangles'
/// edges.
Track follow(const IncisionState& cut, int vertex, double limit) {
  const std::vector<int> fan = cut.mesh.skin_fan(vertex);
  const double size = mean_spoke(cut.mesh, fan, vertex);
  Track track = entered(cut, fan, size, limit);
  if (track.triangle < 0) return track;
  const double step = std::min(Limits::follow_step * size, cut.path.length() / Limits::follow_parts);
  const int rounds = Limits::turns_around_fan * static_cast<int>(fan.size());
  for (int round = 0; track.s < limit;) {
    const double to = std::min(track.s + step, limit);
    const PathFrame frame = cut.path.at(to);
    const Vec3 head = frame.position + frame.outward;
    // Over which of its edges the line has gone first, if any.
    const CutMesh::Triangle& triangle = cut.mesh.triangle(track.triangle);
    int edge = -1;
    double first = to;
    for (int i = 0; i < 3; ++i) {
      const Vec3 &a = cut.mesh.position(triangle.vertex[i]),
                 &b = cut.mesh.position(triangle.vertex[(i + 1) % 3]);
      if (side_of_line(frame.position, head, a, b) >= 0) continue;
      const double s = zero_between(track.s, to, [&](double x) {
        const PathFrame f = cut.path.at(x);
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
    if (!spoke || across < 0 || cut.mesh.is_wall(across) || ++round > rounds) {
      track.edge = edge, track.s = first;
      return track;
    }
    track.triangle = across;
    track.s = first;
  }
  return track;
}

PathStep crossing(const IncisionState& cut, const Track& track) {
  const CutMesh::Triangle& t = cut.mesh.triangle(track.triangle);
  const int across = t.neighbor[track.edge];
  if (across == CutMesh::non_manifold) {
    throw InputError("the path meets an edge that more than two triangles share at arc length " +
                     shortest(track.s) + ", near " + place_of(cut.mesh.position(t.vertex[track.edge])) +
                     "; end it before, or repair the mesh there");
  }
  const Vec3 &a = cut.mesh.position(t.vertex[track.edge]),
             &b = cut.mesh.position(t.vertex[(track.edge + 1) % 3]);
  const PathFrame frame = cut.path.at(track.s);
  // Against the plane of the line that stands most upright on the edge.
  const Vec3 edge = b - a, upright = edge - dot(edge, frame.outward) * frame.outward;
  const double part = std::clamp(dot(frame.position - a, upright) / dot(edge, upright), 0.0, 1.0);
  return {PathStep::edge, track.triangle, track.edge, lerp(a, b, part), track.s};
}

PathStep step_at(const IncisionState& cut, const Track& track) {
  if (track.edge < 0)
    return placed(cut, track.triangle, piercing_point(cut.mesh, track.triangle, cut.path.at(track.s)),
                  track.s);
  const PathStep step = crossing(cut, track);
  return snapped(cut, step, std::numeric_limits<double>::infinity()).value_or(step);
}

/// How far the piece between two places strays from the blade.
double chord_error(const IncisionState& cut, const Vec3& from, const Vec3& to, double s_from, double s_to) {
  const Vec3 chord = to - from;
  double largest = 0;
  constexpr int samples = Limits::chord_samples;
  for (int k = 1; k < samples; ++k) {
    const PathFrame frame = cut.path.at(s_from + (s_to - s_from) * k / samples);
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

bool too_soon_at_wound(const IncisionState& cut, const PathStep& step) {
  // A piece between two wounds, or behind one, needs a vertex that opens.
  const bool first = cut.tip.from >= 0 || cut.chain.size() == cut.tip.piece + 1;
  if (!first || (cut.tip.from < 0 && cut.tip.start == PathEnd::boundary)) return false;
  if (cut.tip.from >= 0 && step.s == cut.path.length()) return true;
  if (step.kind == PathStep::vertex) return cut.mesh.on_wound(step.index);
  return step.kind == PathStep::edge &&
         cut.mesh.is_wall(cut.mesh.triangle(step.triangle).neighbor[step.index]);
}

bool go_on_from_wound(IncisionState& cut) {
  cut.tip.from = lip_ahead(cut, cut.chain.back().left, cut.chain.back().s, cut.path.length());
  return cut.tip.from >= 0;
}

[[noreturn]] void report_end(const IncisionState& cut) {
  throw InputError("the path leaves the surface near " + place_of(cut.mesh.position(cut.tip_vertex())) +
                   ", at arc length " + shortest(cut.chain.back().s) +
                   ": its directions (nx, ny, nz) must point out of the surface there");
}

}  // namespace

int lip_ahead(const IncisionState& cut, int wound_vertex, double s, double limit) {
  const std::vector<int> places = on_the_same_place(cut.mesh, wound_vertex);
  for (const double part : Limits::steps_over_wound)
    for (const int v : places) {
      if (cut.mesh.triangle(cut.mesh.vertex(v).triangle).region != Region::skin) continue;
      const std::vector<int> fan = cut.mesh.skin_fan(v);
      const double ahead = s + part * mean_spoke(cut.mesh, fan, v);
      if (ahead <= limit && pierced(cut.mesh, fan, cut.path.at(ahead)) >= 0) return v;
    }
  return -1;
}

int triangle_ahead(const IncisionState& cut) {
  constexpr double beyond_end = std::numeric_limits<double>::infinity();
  const bool in_wound = cut.tip.arrived && cut.tip.from < 0;
  const int tip = in_wound ? lip_ahead(cut, cut.tip_vertex(), cut.tip_s(), beyond_end) : cut.tip_vertex();
  if (tip < 0) return -1;
  const std::vector<int> fan = cut.mesh.skin_fan(tip);
  return entered(cut, fan, mean_spoke(cut.mesh, fan, tip), beyond_end).triangle;
}

const PathStep& next_step(IncisionState& cut) {
  if (cut.next) return *cut.next;
  const double s = cut.chain.back().s,
               too_short = Limits::shortest_rest * cut.path.length();  // a rest not worth a vertex
  if (cut.tip.arrived && cut.tip.from < 0 && !go_on_from_wound(cut)) {
    if (cut.path.length() - s >= too_short) report_end(cut);
    cut.next = PathStep{PathStep::vertex, -1, -1, {}, std::numeric_limits<double>::infinity()};
    return *cut.next;
  }
  const int tip = cut.tip_vertex();
  const Track track = follow(cut, tip, cut.path.length());
  if (track.triangle < 0) report_end(cut);
  PathStep step = step_at(cut, track);
  const bool rest = track.edge < 0 && cut.path.length() - s < too_short;
  if (rest) step.s = std::numeric_limits<double>::infinity();
  double within =
      step.s - s;  // the piece's length, halved as often as a vertex ahead draws it to itself again
  for (int k = 0; k < Limits::piece_halvings && !rest && within > Limits::same_place * cut.path.length();
       ++k) {
    const double error = chord_error(cut, cut.mesh.position(tip), step.place, s, step.s);
    if (step.s - s > Limits::longer_piece * cut.longest_piece)
      within = std::min(within, cut.longest_piece);
    else if (too_soon_at_wound(cut, step))
      within /= 2;
    else if (error > cut.chord_tolerance)
      within /= std::max(2.0, std::ceil(std::sqrt(error / cut.chord_tolerance)));
    else
      break;
    const double before = step.s;
    step = shorter(cut, step, s + within);
    within = step.s < before ? std::min(within, step.s - s) : within / 2;
  }
  cut.next = step;
  return *cut.next;
}

PathStep shorter(const IncisionState& cut, const PathStep& step, double to) {
  const Track track = follow(cut, cut.tip_vertex(), to);
  if (track.triangle < 0) return step;
  const PathStep next = step_at(cut, track);
  if (track.edge < 0 || next.kind != PathStep::vertex || next.s <= to) return next;
  // Behind the edge the path bends before it comes to the vertex: no straight piece leads there.
  const PathStep plain = crossing(cut, track);
  return snapped(cut, plain, to).value_or(plain);
}

bool wounds_cross_at(const IncisionState& cut, int v) {
  const std::vector<int> places = on_the_same_place(cut.mesh, v);
  return std::count_if(places.begin(), places.end(), [&](int place) {
           return cut.mesh.is_skin(cut.mesh.vertex(place).triangle);
         }) >= Limits::corners_where_wounds_cross;
}

double chord_error(const IncisionState& cut) {
  double largest = 0;
  for (std::size_t i = 1; i < cut.chain.size(); ++i)
    if (cut.chain[i].s > cut.chain[i - 1].s)
      largest = std::max(
          largest, chord_error(cut, cut.mesh.position(cut.chain[i - 1].left),
                               cut.mesh.position(cut.chain[i].left), cut.chain[i - 1].s, cut.chain[i].s));
  return largest;
}

}  // namespace cleft
