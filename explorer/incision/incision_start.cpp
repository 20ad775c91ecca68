#include "explorer/incision/incision_start.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/nearest_weights.h"
#include "base/text.h"
#include "explorer/incision/blade.h"
#include "explorer/incision/incision_places.h"
#include "explorer/incision/incision_walk.h"

namespace cleft {

namespace {

/// The skin's triangle at the opposite lip of a wound, and its edge there; -1: there is none.
std::array<int, 2> across_wound(const CutMesh& mesh, int t, int edge) {
  const int wall = mesh.triangle(t).neighbor[edge], twin = mesh.twin(wall);
  const int there = CutMesh::twin_edge(mesh.triangle(wall).corner(mesh.triangle(t).vertex[(edge + 1) % 3]));
  const int opposite = mesh.triangle(twin).neighbor[there];
  if (!mesh.is_skin(opposite)) return {-1, -1};
  return {opposite, mesh.triangle(opposite).corner(mesh.triangle(twin).vertex[(there + 1) % 3])};
}

/// The place nearest to C(0) where the blade pierces the skin.
std::optional<PathStep> start_on_face(const IncisionState& cut, double reach) {
  std::optional<PathStep> best;
  const PathFrame frame = cut.path.at(0);
  for (int t = 0; t < static_cast<int>(cut.mesh.triangles().size()); ++t) {
    if (cut.mesh.is_wall(t) || !pierces(cut.mesh, t, frame)) continue;
    const Vec3 place = piercing_point(cut.mesh, t, frame);
    const double height = std::abs(dot(place - frame.position, frame.outward));
    if (height > reach) continue;
    reach = height;
    best = PathStep{PathStep::face, t, 0, place, 0};
  }
  if (best) best = placed(cut, best->triangle, best->place, 0);
  return best;
}

/// Where the path first comes in over the boundary.
std::optional<PathStep> start_on_boundary(const IncisionState& cut, double reach) {
  std::optional<PathStep> best;
  for (int t = 0; t < static_cast<int>(cut.mesh.triangles().size()); ++t)
    for (int i = 0; i < 3; ++i) {
      if (cut.mesh.is_wall(t) || cut.mesh.triangle(t).neighbor[i] != CutMesh::boundary) continue;
      const Vec3 &a = cut.mesh.position(cut.mesh.triangle(t).vertex[i]),
                 &b = cut.mesh.position(cut.mesh.triangle(t).vertex[(i + 1) % 3]);
      // The path comes in where the boundary, followed with the surface on its left, passes from left to
      // right.
      if (cut.path.coordinates(a).v < 0 || cut.path.coordinates(b).v > 0) continue;
      const double part = zero_between(0, 1, [&](double x) { return cut.path.coordinates(lerp(a, b, x)).v; });
      const Vec3 place = lerp(a, b, part);
      const PathCoordinates at = cut.path.coordinates(place);
      if (std::abs(at.w) > reach || at.s < 0 || at.s >= cut.path.length() || (best && best->s <= at.s))
        continue;
      best = PathStep{PathStep::edge, t, i, place, at.s};
    }
  if (best) best = placed(cut, best->triangle, best->place, best->s);
  return best;
}

/// Where the start is on a wound, it is on the lip that the path leads away from.
PathStep on_its_lip(const IncisionState& cut, PathStep start) {
  if (start.kind == PathStep::vertex && cut.mesh.on_wound(start.index)) {
    const int v = lip_ahead(cut, start.index, start.s, cut.path.length());
    if (v >= 0) start.index = v;
  }
  if (start.kind != PathStep::edge) return start;
  const CutMesh::Triangle& t = cut.mesh.triangle(start.triangle);
  if (!cut.mesh.is_wall(t.neighbor[start.index])) return start;
  const auto [opposite, edge] = across_wound(cut.mesh, start.triangle, start.index);
  if (opposite < 0) return start;
  const double size =
      norm(cut.mesh.position(t.vertex[(start.index + 1) % 3]) - cut.mesh.position(t.vertex[start.index]));
  for (const double part : IncisionTolerances::steps_over_wound) {
    const PathFrame frame = cut.path.at(start.s + part * size);
    if (pierces(cut.mesh, start.triangle, frame)) return start;
    if (!pierces(cut.mesh, opposite, frame)) continue;
    start.triangle = opposite, start.index = edge;
    return start;
  }
  return start;
}

/// Whether the skin nearest to the start, if it is within reach, faces against the path's directions.
bool faces_away(const IncisionState& cut, double reach) {
  const PathFrame start = cut.path.at(0);
  double least = reach;
  bool away = false;
  for (int t = 0; t < static_cast<int>(cut.mesh.triangles().size()); ++t) {
    if (!cut.mesh.is_skin(t)) continue;
    const auto& corners = cut.mesh.triangle(t).vertex;
    const Vec3 a = cut.mesh.position(corners[0]), b = cut.mesh.position(corners[1]),
               c = cut.mesh.position(corners[2]);
    const std::array<double, 3> weight = nearest_weights(start.position, a, b, c);
    const double apart = norm(weight[0] * a + weight[1] * b + weight[2] * c - start.position);
    if (apart < least) least = apart, away = dot(cross(b - a, c - a), start.outward) < 0;
  }
  return away;
}

}  // namespace

PathStep find_start(const IncisionState& cut) {
  const double reach = cut.path.length() / IncisionTolerances::start_height_parts;
  if (const auto start = start_on_face(cut, reach)) return on_its_lip(cut, *start);
  if (const auto start = start_on_boundary(cut, reach)) return on_its_lip(cut, *start);
  const Vec3 c = cut.path.at(0).position;
  if (faces_away(cut, reach))
    throw InputError("the path begins at " + place_of(c) +
                     " on a surface that faces the other way: its directions (nx, ny, nz) must point out of "
                     "the surface; turn them round, or the triangles of the mesh");
  double least = std::numeric_limits<double>::infinity();
  for (const CutMesh::Vertex& v : cut.mesh.vertices()) least = std::min(least, norm(v.position - c));
  throw InputError("the path never touches the mesh: it begins at " + place_of(c) + ", " + shortest(least) +
                   " from the nearest vertex. It must lie within " + shortest(reach) +
                   " of a surface that faces along its directions (nx, ny, nz), in the mesh's own " +
                   "units: divide a path in mm by the mm per unit given as --scale");
}

std::vector<int> triangles_at(const IncisionState& cut, const PathStep& start) {
  if (start.kind == PathStep::vertex) return cut.mesh.skin_fan(start.index);
  if (start.kind == PathStep::face) return {start.triangle};
  return {start.triangle, cut.mesh.triangle(start.triangle).neighbor[start.index]};
}

/// At a vertex of the edge that is crossed, which the path passes so closely, no later than at `to` but where
/// it is near.
}  // namespace cleft
