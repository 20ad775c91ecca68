#include "explorer/incision/path_trace.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "explorer/incision/incision_tolerances.h"

namespace cleft {

using Limits = IncisionTolerances;

int skin_across(const CutMesh& mesh, int t, int i) {
  const int other = mesh.triangle(t).neighbor[i];
  if (other < 0 || mesh.is_skin(other)) return other < 0 ? -1 : other;
  const int corner = mesh.triangle(other).corner(mesh.triangle(t).vertex[(i + 1) % 3]),
            twin = mesh.twin(other);
  const int beyond = mesh.triangle(twin).neighbor[CutMesh::twin_edge(corner)];
  return mesh.is_skin(beyond) ? beyond : -1;
}

bool PathTrace::follow(int t, double s, bool ahead) {
  std::unordered_map<int, double> passed;  // triangles, and s where the path has left them
  for (int from = -1; t >= 0;) {
    const std::optional<Exit> exit = pass(t, from, s, ahead);
    if (!exit) return from >= 0;
    s = exit->s;
    if (s < first_ || s > last_ || leads_over_path(*exit)) break;
    const auto [seen, is_new] = passed.try_emplace(t, s);
    if (!is_new && from >= 0 && std::abs(seen->second - s) < Limits::trace_window * exit->longest_edge) break;
    seen->second = s;
    from = t;
    t = skin_across(mesh_, t, exit->edge);
  }
  return true;
}

bool PathTrace::leads_over_path(const Exit& exit) const {
  if (exit.s >= 0 && exit.s <= path_.length()) return false;
  const double nearest = path_.coordinates(exit.place).s;
  return nearest > exit.longest_edge && nearest < path_.length() - exit.longest_edge;
}

/// Where the path leaves t, if it passes it and t does not turn away from the blade: by the edge that it
/// did not enter by. Where it passes a vertex both edges are at the same s but for rounding, and s could
/// not tell them apart.
std::optional<PathTrace::Exit> PathTrace::pass(int t, int from, double s, bool ahead) {
  const auto& v = mesh_.triangle(t).vertex;
  const Vec3 p[3] = {mesh_.position(v[0]), mesh_.position(v[1]), mesh_.position(v[2])};
  const double longest =
      std::sqrt(std::max({squared_norm(p[1] - p[0]), squared_norm(p[2] - p[1]), squared_norm(p[0] - p[2])}));
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
  const bool known = from < 0 && !pieces.empty();  // the second of two ways from the same triangle
  if (length > 0 && !known)
    pieces.push_back({(at[0] + at[1]) / 2, length, (height[0] + height[1]) / 2, normalized(normal)});
  for (const Corner& c : corner) corners.push_back(c);
  passed_.insert(t);
  int out = (at[1] > at[0]) == ahead ? 1 : 0;
  if (from >= 0 && skin_across(mesh_, t, crossing[out]) == from) out = 1 - out;
  return Exit{crossing[out], at[out], longest, place[out]};
}

/// A corner of the triangles before is the same in this one: on which side it is, is decided once.
PathTrace::Corner PathTrace::corner_at(int vertex, double s, double reach) const {
  const std::size_t oldest = corners.size() - std::min(corners.size(), Limits::trace_memory);
  for (std::size_t i = corners.size(); i-- > oldest;)
    if (corners[i].vertex == vertex && std::abs(corners[i].at.s - s) <= reach) return corners[i];
  return {vertex, path_.coordinates(mesh_.position(vertex), s - reach, s + reach)};
}

/// The triangle that the blade's line at the place passes, by the edges over which it lies; from t on, a few
/// triangles far.
int PathTrace::under(int t, const PathFrame& place) const {
  for (int k = 0; k < Limits::cover_steps; ++k) {
    const auto& v = mesh_.triangle(t).vertex;
    int over = -1;
    double farthest = 0;
    for (int i = 0; i < 3; ++i) {
      const Vec3 a = mesh_.position(v[i]), edge = mesh_.position(v[(i + 1) % 3]) - a;
      const double beyond = dot(cross(place.position - a, edge), place.outward) / norm(edge);
      if (beyond > farthest) farthest = beyond, over = i;
    }
    const int next = over < 0 ? -1 : skin_across(mesh_, t, over);
    if (next < 0) return t;
    t = next;
  }
  return t;
}

void PathTrace::cover(int t) {
  for (int k = 0; k <= Limits::cover_places; ++k) {
    const double s = path_.length() * k / Limits::cover_places;
    t = under(t, path_.at(s));
    if (!passed_.insert(t).second) continue;
    for (const int v : mesh_.triangle(t).vertex) {
      const double reach = path_.length() / Limits::cover_places;
      corners.push_back({v, path_.coordinates(mesh_.position(v), s - reach, s + reach)});
    }
  }
}

}  // namespace cleft
