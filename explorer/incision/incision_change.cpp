// One step of the cut changes the mesh: a vertex of the path is made there, walls are sewn in below it, and
// slivers beside it are mended.
#include <algorithm>

#include "base/error.h"
#include "base/text.h"
#include "explorer/incision/incision.h"
#include "explorer/incision/refine.h"
#include "explorer/incision/triangle_quality.h"

namespace cleft {

namespace {

using Limits = IncisionTolerances;

}  // namespace

void Incision::take(const Step& step) {
  const CutMesh::Checkpoint since = mesh_.checkpoint();
  grow(realise(step), step.s);
  mend(since);
  // A slit with its walls leaves the surface what it is; where wounds are tangled within a triangle's
  // breadth, sewing may not.
  if (mesh_.euler_change_since(since) != 0)
    throw InputError("the path meets too many wounds at once near " + place_of(step.place) +
                     ", at arc length " + shortest(step.s) + "; lead it around them");
}

bool Incision::made_room(const Step& step) {
  // A piece much shorter than the triangle it is in would leave slivers: smaller triangles first.
  if (!step.inside) return false;
  const double most = Limits::room_for_piece * norm(step.place - mesh_.position(tip_vertex()));
  const CutMesh::Checkpoint since = mesh_.checkpoint();
  const int across = step.kind == Step::edge ? mesh_.triangle(step.triangle).neighbor[step.index] : -1;
  bool made = longest_edge_length(mesh_, step.triangle) > most && bisect(mesh_, step.triangle);
  if (!made && across >= 0 && mesh_.triangle(across).region == Region::skin)
    made = longest_edge_length(mesh_, across) > most && bisect(mesh_, across);
  if (const auto kept = pending_edge(); made && kept[0] >= 0 && mesh_.triangle_with(kept[0], kept[1]) < 0) {
    mesh_.roll_back(since);
    return false;
  }
  if (made) mend(since);
  return made;
}

/// The edge that the next segment will part: not sewn in yet, it looks like any other.
std::array<int, 2> Incision::pending_edge() const {
  if (!state_.pending) return {-1, -1};
  return {chain_[state_.piece].left, chain_.back().left};
}

void Incision::mend(const CutMesh::Checkpoint& since) {
  const KeptEdge kept = pending_edge();
  const double bend = chord_tolerance_ / Limits::bend_parts;
  const auto slivers = [&] {
    std::vector<int> list = mesh_.changed_since(since);
    for (const auto& [t, tried] : state_.poor) list.push_back(t);
    return list;
  };
  std::erase_if(state_.poor, [&](const auto& left) {
    return left.second == Limits::tries || left.first >= static_cast<int>(mesh_.triangles().size());
  });
  mend_slivers(mesh_, slivers(), std::min(Limits::flat_target, Limits::flat_target_factor * asked_), 0, kept);
  bent_ |= mend_slivers(mesh_, slivers(), Limits::bent_target_factor * asked_, bend, kept);
  bent_ |= mend_needles(mesh_, mesh_.changed_since(since), Limits::trial_target_factor * asked_, bend, kept);
  for (auto& [t, tried] : state_.poor) ++tried;
  const double least = Limits::no_area_part * std::min(Limits::fair_ratio, worst_before_);
  for (const int t : mesh_.changed_since(since)) {
    if (!mesh_.is_skin(t)) continue;
    const double ratio = radius_ratio(mesh_, t);
    if (ratio < asked_) state_.poor.emplace_back(t, 0);
    if (ratio < least)
      throw InputError("the path comes too close to a wound or an edge of the surface near " +
                       place_of(mesh_.position(mesh_.triangle(t).vertex[0])) + ", at arc length " +
                       shortest(tip()) +
                       ", and would leave triangles without area; lead it across, or farther away");
  }
}

int Incision::realise(const Step& step) {
  if (step.kind == Step::edge) {
    const CutMesh::Triangle& t = mesh_.triangle(step.triangle);
    const Vec3 a = mesh_.position(t.vertex[step.index]),
               ab = mesh_.position(t.vertex[(step.index + 1) % 3]) - a;
    const Vec3 foot = a + (dot(step.place - a, ab) / squared_norm(ab)) * ab;
    const int m = mesh_.split_edge(step.triangle, step.index, step.place);
    if (norm(step.place - foot) > Limits::bent_edge * norm(ab))
      mesh_.edit_vertex(m).original = foot;  // a bent edge
    return m;
  }
  if (step.kind == Step::face) return mesh_.split_face(step.triangle, step.place);
  if (!(mesh_.position(step.index) == step.place)) mesh_.move_vertex(step.index, step.place);
  return step.index;
}

void Incision::grow(int next, double s) {
  const bool wound = mesh_.on_wound(next), boundary = !wound && mesh_.on_boundary(next);
  if (!wound) {
    CutMesh::Vertex& vertex = mesh_.edit_vertex(next);
    vertex.kind = VertexKind::shared;
    vertex.s = s;
    vertex.cut = cut_;
  }
  if (chain_.empty()) {
    state_.start = wound ? End::wound : boundary ? End::boundary : End::closed;
    chain_.push_back({next, next, s});
    return;
  }
  if (state_.from >= 0) {  // on from a wound
    chain_.push_back({state_.from, state_.from, chain_.back().s});
    state_.start = End::wound;
    state_.piece = chain_.size() - 1;
    state_.column.reset();
    state_.arrived = false;
    state_.from = -1;
  }
  const bool first = chain_.size() == state_.piece + 1;
  if (first) {
    const CutMesh::Checkpoint without = mesh_.checkpoint();
    state_.column = start_column();
    if (!state_.column->opens &&
        !boundary) {  // both ends are closed: the next segment will open this one too
      CLEFT_CHECK(wound, ==, false);
      mesh_.roll_back(without);
      chain_.push_back({next, next, s});
      state_.pending = true;
      return;
    }
  }

  Sewing sewing(mesh_, cut_);
  int first_sheet = -1;
  const std::size_t tip = chain_.size() - 1;
  if (state_.pending) {
    const Column start = start_column();
    state_.column = hang_column(mesh_, chain_[tip].left, down(chain_[tip].s), chain_[tip].s, cut_, rows_);
    state_.column->opens = true;
    sewing.add(start, *state_.column);
    first_sheet = sewing.last_sheet();
  }
  Column column = wound ? wound_column(mesh_, next, down(s), s, cut_, rows_, {})
                        : hang_column(mesh_, next, down(s), s, cut_, rows_);
  if (boundary) column.opens = true;
  sewing.add(*state_.column, column);
  if (first && state_.start == End::boundary) sewing.open_at_boundary(true);
  if (boundary) sewing.open_at_boundary(false);
  if (wound) sewing.join_end();
  sewing.part_vertices();

  const auto set = [this](std::size_t i, const Sewing::Lips& lips) {
    chain_[i].left = lips.left, chain_[i].right = lips.right;
  };
  if (first_sheet >= 0) set(state_.piece, sewing.lips_at_start(first_sheet));
  set(tip, sewing.lips_at_start(sewing.last_sheet()));
  const Sewing::Lips end = sewing.lips_at_end(sewing.last_sheet());
  chain_.push_back({end.left, end.right, s});
  state_.pending = false;
  state_.arrived = wound;
  state_.left_mesh = boundary;
  state_.below.assign(column.vertex.begin() + static_cast<std::ptrdiff_t>(column.first_new),
                      column.vertex.end());
  column.opens = true;  // the next segment will part it
  state_.column = std::move(column);
}

Column Incision::start_column() {
  const ChainVertex& start = chain_[state_.piece];
  if (state_.start == End::wound)
    return wound_column(mesh_, start.left, down(start.s), start.s, cut_, rows_, state_.below);
  Column column = hang_column(mesh_, start.left, down(start.s), start.s, cut_, rows_);
  column.opens = state_.start == End::boundary;
  return column;
}

}  // namespace cleft
