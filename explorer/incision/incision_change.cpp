#include "explorer/incision/incision_change.h"

#include <algorithm>
#include <array>

#include "base/error.h"
#include "base/text.h"
#include "explorer/incision/mend_slivers.h"
#include "explorer/incision/refine.h"
#include "explorer/incision/triangle_quality.h"

namespace cleft {

namespace {

using Limits = IncisionTolerances;

/// The edge that the next segment will part: not sewn in yet, it looks like any other.
std::array<int, 2> pending_edge(const IncisionState& cut) {
  if (!cut.tip.pending) return {-1, -1};
  return {cut.chain[cut.tip.piece].left, cut.chain.back().left};
}

/// Below the first vertex of the piece between two wounds that the tip is in.
Column start_column(IncisionState& cut) {
  const Incision::ChainVertex& start = cut.chain[cut.tip.piece];
  if (cut.tip.start == PathEnd::wound)
    return wound_column(cut.mesh, start.left, cut.down(start.s), start.s, cut.number, cut.rows,
                        cut.tip.below);
  Column column = hang_column(cut.mesh, start.left, cut.down(start.s), start.s, cut.number, cut.rows);
  column.opens = cut.tip.start == PathEnd::boundary;
  return column;
}

/// The radius ratio below which a triangle has no area, in a mesh with the given one as its worst.
double least_with_area(double worst) {
  const double bisected = Limits::bisected_needle_part * worst;
  return std::min(Limits::no_area_part * worst, std::max(bisected * bisected, Limits::least_bisected_ratio));
}

}  // namespace

int realise(IncisionState& cut, const PathStep& step) {
  if (step.kind == PathStep::edge) {
    const CutMesh::Triangle& t = cut.mesh.triangle(step.triangle);
    const Vec3 a = cut.mesh.position(t.vertex[step.index]),
               ab = cut.mesh.position(t.vertex[(step.index + 1) % 3]) - a;
    const Vec3 foot = a + (dot(step.place - a, ab) / squared_norm(ab)) * ab;
    const int m = cut.mesh.split_edge(step.triangle, step.index, step.place);
    if (norm(step.place - foot) > Limits::bent_edge * norm(ab))
      cut.mesh.edit_vertex(m).original = foot;  // a bent edge
    return m;
  }
  if (step.kind == PathStep::face) return cut.mesh.split_face(step.triangle, step.place);
  if (!(cut.mesh.position(step.index) == step.place)) cut.mesh.move_vertex(step.index, step.place);
  return step.index;
}

void mend(IncisionState& cut, const CutMesh::Checkpoint& since) {
  const KeptEdge kept = pending_edge(cut);
  const double bend = cut.chord_tolerance / Limits::bend_parts;
  const auto slivers = [&] {
    std::vector<int> list = cut.mesh.changed_since(since);
    for (const auto& [t, tried] : cut.tip.poor) list.push_back(t);
    return list;
  };
  std::erase_if(cut.tip.poor, [&](const auto& left) {
    return left.second == Limits::tries || left.first >= static_cast<int>(cut.mesh.triangles().size());
  });
  mend_slivers(cut.mesh, slivers(),
               std::min(Limits::flat_target, Limits::flat_target_factor * cut.least_ratio), 0, kept);
  cut.bent |= mend_slivers(cut.mesh, slivers(), Limits::bent_target_factor * cut.least_ratio, bend, kept);
  cut.bent |= mend_needles(cut.mesh, cut.mesh.changed_since(since),
                           Limits::trial_target_factor * cut.least_ratio, bend, kept);
  for (auto& [t, tried] : cut.tip.poor) ++tried;
  const double least = least_with_area(std::min(Limits::fair_ratio, cut.worst_before));
  for (const int t : cut.mesh.changed_since(since)) {
    if (!cut.mesh.is_skin(t)) continue;
    const double ratio = radius_ratio(cut.mesh, t);
    if (ratio < cut.least_ratio) cut.tip.poor.emplace_back(t, 0);
    if (ratio < least)
      throw InputError("the path comes too close to a wound or an edge of the surface near " +
                       place_of(cut.mesh.position(cut.mesh.triangle(t).vertex[0])) + ", at arc length " +
                       shortest(cut.tip_s()) +
                       ", and would leave triangles without area; lead it across, or farther away");
  }
}

void grow(IncisionState& cut, int next, double s) {
  cut.tip.bisections = 0;
  const bool wound = cut.mesh.on_wound(next), boundary = !wound && cut.mesh.on_boundary(next);
  if (!wound) {
    CutMesh::Vertex& vertex = cut.mesh.edit_vertex(next);
    vertex.kind = VertexKind::shared;
    vertex.s = s;
    vertex.cut = cut.number;
  }
  if (cut.chain.empty()) {
    cut.tip.start = wound ? PathEnd::wound : boundary ? PathEnd::boundary : PathEnd::closed;
    cut.chain.push_back({next, next, s});
    return;
  }
  if (cut.tip.from >= 0) {  // on from a wound
    cut.chain.push_back({cut.tip.from, cut.tip.from, cut.chain.back().s});
    cut.tip.start = PathEnd::wound;
    cut.tip.piece = cut.chain.size() - 1;
    cut.tip.column.reset();
    cut.tip.arrived = false;
    cut.tip.from = -1;
  }
  const bool first = cut.chain.size() == cut.tip.piece + 1;
  if (first) {
    const CutMesh::Checkpoint without = cut.mesh.checkpoint();
    cut.tip.column = start_column(cut);
    if (!cut.tip.column->opens &&
        !boundary) {  // both ends are closed: the next segment will open this one too
      if (wound)
        throw InputError("the path leads from one wound straight into the next near " +
                         place_of(cut.mesh.position(next)) + ", at arc length " + shortest(s) +
                         ", and no piece between them can open; lead it across them, or away from there");
      cut.mesh.roll_back(without);
      cut.chain.push_back({next, next, s});
      cut.tip.pending = true;
      return;
    }
  }

  Sewing sewing(cut.mesh, cut.number);
  int first_sheet = -1;
  const std::size_t tip = cut.chain.size() - 1;
  if (cut.tip.pending) {
    const Column start = start_column(cut);
    cut.tip.column = hang_column(cut.mesh, cut.chain[tip].left, cut.down(cut.chain[tip].s), cut.chain[tip].s,
                                 cut.number, cut.rows);
    cut.tip.column->opens = true;
    sewing.add(start, *cut.tip.column);
    first_sheet = sewing.last_sheet();
  }
  Column column = wound ? wound_column(cut.mesh, next, cut.down(s), s, cut.number, cut.rows, {})
                        : hang_column(cut.mesh, next, cut.down(s), s, cut.number, cut.rows);
  if (boundary) column.opens = true;
  sewing.add(*cut.tip.column, column);
  if (first && cut.tip.start == PathEnd::boundary) sewing.open_at_boundary(true);
  if (boundary) sewing.open_at_boundary(false);
  if (wound) sewing.join_end();
  sewing.part_vertices();

  const auto set = [&](std::size_t i, const Sewing::Lips& lips) {
    cut.chain[i].left = lips.left, cut.chain[i].right = lips.right;
  };
  if (first_sheet >= 0) set(cut.tip.piece, sewing.lips_at_start(first_sheet));
  set(tip, sewing.lips_at_start(sewing.last_sheet()));
  const Sewing::Lips end = sewing.lips_at_end(sewing.last_sheet());
  cut.chain.push_back({end.left, end.right, s});
  cut.tip.pending = false;
  cut.tip.arrived = wound;
  cut.tip.left_mesh = boundary;
  cut.tip.below.assign(column.vertex.begin() + static_cast<std::ptrdiff_t>(column.first_new),
                       column.vertex.end());
  column.opens = true;  // the next segment will part it
  cut.tip.column = std::move(column);
}

bool made_room(IncisionState& cut, const PathStep& step) {
  // A piece much shorter than the triangle it is in would leave slivers: smaller triangles first.
  if (!step.inside || cut.tip.bisections == Limits::most_bisections_for_room) return false;
  const double most = Limits::room_for_piece * norm(step.place - cut.mesh.position(cut.tip_vertex()));
  const CutMesh::Checkpoint since = cut.mesh.checkpoint();
  const int across = step.kind == PathStep::edge ? cut.mesh.triangle(step.triangle).neighbor[step.index] : -1;
  bool made = longest_edge_length(cut.mesh, step.triangle) > most && bisect(cut.mesh, step.triangle);
  if (!made && across >= 0 && cut.mesh.triangle(across).region == Region::skin)
    made = longest_edge_length(cut.mesh, across) > most && bisect(cut.mesh, across);
  if (const auto kept = pending_edge(cut);
      made && kept[0] >= 0 && cut.mesh.triangle_with(kept[0], kept[1]) < 0) {
    cut.mesh.roll_back(since);
    return false;
  }
  if (made) mend(cut, since);
  cut.tip.bisections += made;
  return made;
}

void take(IncisionState& cut, const PathStep& step) {
  const CutMesh::Checkpoint since = cut.mesh.checkpoint();
  grow(cut, realise(cut, step), step.s);
  mend(cut, since);
  // A slit with its walls leaves the surface what it is; where wounds are tangled within a triangle's
  // breadth, sewing may not.
  if (cut.mesh.euler_change_since(since) != 0)
    throw InputError("the path meets too many wounds at once near " + place_of(step.place) +
                     ", at arc length " + shortest(step.s) + "; lead it around them");
}

}  // namespace cleft
