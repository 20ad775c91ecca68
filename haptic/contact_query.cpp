#include "haptic/contact_query.h"

#include <limits>

#include "haptic/voxel_visit.h"

namespace cleft {

namespace {
constexpr double folded = 0.25;   // of the sum of normals: walls that meet at less than 29 degrees
constexpr double overlap = 0.02;  // mm, of walls that overlap
}  // namespace

ContactReader::ContactReader(const ContactSurface& surface) : surface_(surface), cells_(surface.cells()) {
  for (auto& state : surface.readers_) {
    std::uint64_t expected = ContactSurface::unused;
    if (!state.compare_exchange_strong(expected, ContactSurface::idle)) continue;
    state_ = &state;
    return;
  }
  throw InputError("the surface has " + std::to_string(ContactSurface::most_readers) + " readers already");
}

ContactReader::~ContactReader() { state_->store(ContactSurface::unused, std::memory_order_release); }

void ContactReader::begin() {
  // A writer that sees `entering` waits the few nanoseconds until the version is set; one that has not seen
  // it has published its step before, and it is that step that is read.
  state_->store(ContactSurface::entering, std::memory_order_seq_cst);
  version_ = surface_.version_.load(std::memory_order_seq_cst);
  state_->store(ContactSurface::reading + version_, std::memory_order_release);
}

bool ContactReader::corners_of(int triangle, Corners& corners, ContactTriangle& t) const {
  const StoredTriangle& now = stored(triangle);
  if (!now.exists()) return false;
  t = now.triangle();
  for (int i = 0; i < 3; ++i) corners[i] = surface_.positions_[t.vertex[i]].at(version_);
  return true;
}

double ContactReader::firmness(int triangle, const Vec3& place) const {
  Corners c;
  ContactTriangle t;
  if (!surface_.firmness_differs_ || triangle < 0 || !corners_of(triangle, c, t)) return 1;
  const Vec3 normal = scaled_normal(c);
  double sum = 0, weights = 0;
  for (int i = 0; i < 3; ++i) {
    const double weight = std::max(0., dot(cross(c[(i + 1) % 3] - place, c[(i + 2) % 3] - place), normal));
    sum += weight * surface_.firmness_[t.vertex[i]].load(std::memory_order_relaxed);
    weights += weight;
  }
  return weights > 0 ? sum / weights : surface_.firmness_[t.vertex[0]].load(std::memory_order_relaxed);
}

void ContactReader::meet(const CellList& list, const Vec3& from, const Vec3& to, Facing facing,
                         SurfaceHit& best) const {
  const double rounding = StoredTriangle::of_rounding(from, to);
  const auto may_meet = [&](const StoredTriangle& t) { return !t.on_one_side(from, to, rounding); };
  each_of(list, may_meet, [&](int id, const ContactTriangle& t, const Corners& corners) {
    const Passage passage = pass_through(from, to, corners);
    if (!passage.passes || (best && passage.fraction >= best.fraction)) return;
    if (facing != Facing::any && passage.inward != (facing == Facing::front)) return;
    best = {id, passage.fraction, {}, passage.normal, t.wall};
  });
}

SurfaceHit ContactReader::first_contact(const Vec3& from, const Vec3& to, Facing facing) const {
  SurfaceHit best;
  int i[3];
  bool within = true;  // one voxel, as a tick's way mostly is
  for (int k = 0; k < 3; ++k) {
    i[k] = cells_.index(from[k], k);
    within = within && i[k] == cells_.index(to[k], k);
  }
  if (!within)
    walk(from, to, facing, best);
  else if (const CellList list = cells_.at(i[0], i[1], i[2]))
    meet(list, from, to, facing, best);
  if (best) {
    best.position = lerp(from, to, best.fraction);
    best.normal = normalized(best.normal);
  }
  return best;
}

/// Voxel after voxel along the segment (Amanatides and Woo 1987).
void ContactReader::walk(const Vec3& from, const Vec3& to, Facing facing, SurfaceHit& best) const {
  const Vec3 along = to - from;
  const double cell = cells_.cell();
  double begin = 0, end = 1;
  for (int k = 0; k < 3; ++k) {
    const double low = cells_.low()[k] - from[k], high = low + cell * cells_.size(k);
    if (along[k] == 0) {
      if (low > 0 || high < 0) return;
      continue;
    }
    const double a = low / along[k], b = high / along[k];
    begin = std::max(begin, std::min(a, b));
    end = std::min(end, std::max(a, b));
  }
  if (begin > end) return;
  int at[3], step[3], last[3];
  double next[3], stride[3];
  for (int k = 0; k < 3; ++k) {
    at[k] = cells_.index(from[k] + begin * along[k], k);
    last[k] = cells_.index(from[k] + end * along[k], k);
    step[k] = along[k] > 0 ? 1 : -1;
    const double wall = cells_.low()[k] + cell * (at[k] + (along[k] > 0 ? 1 : 0)) - from[k];
    next[k] = along[k] == 0 ? std::numeric_limits<double>::infinity() : wall / along[k];
    stride[k] = along[k] == 0 ? 0 : cell / std::abs(along[k]);
  }
  for (;;) {
    const int axis = next[0] < next[1] ? (next[0] < next[2] ? 0 : 2) : next[1] < next[2] ? 1 : 2;
    if (const CellList list = cells_.at(at[0], at[1], at[2])) meet(list, from, to, facing, best);
    if ((best && best.fraction <= next[axis]) || next[axis] > end) break;
    if (at[0] == last[0] && at[1] == last[1] && at[2] == last[2]) break;
    at[axis] += step[axis];
    if (at[axis] < 0 || at[axis] >= cells_.size(axis)) break;
    next[axis] += stride[axis];
  }
}

/// Whether a wall that x is before is met together with the back of another: a field that hardly opens a cut
/// may move its walls through each other by micrometres, and no tissue is as thin as that.
bool ContactReader::through_each_other(const Vec3& x, const Vec3& on_wall) const {
  const Vec3 way = on_wall - x;
  const double distance = norm(way);
  if (!(distance > overlap)) return false;
  const Vec3 from = on_wall - overlap / distance * way, to = on_wall + overlap / distance * way;
  const SurfaceHit back = first_contact(from, to, Facing::back);
  return back && back.wall;
}

NearestPoint ContactReader::nearest(const Vec3& x, double radius) const {
  NearestPoint best;
  double least = radius * radius;
  Vec3 normal, into;  // summed over the triangles that share the nearest point; of one that x is behind
  double weights = 0;
  bool only_walls = true;
  int sharing[24], shared = 0;
  const double tie = 1e-9 * cells_.cell();
  const auto near = [&](const StoredTriangle& t) {
    return t.least_squared_distance(x) <= least * (1 + 1e-9);
  };
  visit_voxels(x, radius, [&](const CellList& list) {
    each_of(list, near, [&](int id, const ContactTriangle& t, const Corners& c) {
      if (least_squared_distance(x, c) > least * (1 + 1e-9)) return;
      const ClosestPoint p = closest_point(x, c);
      const double square = squared_norm(x - p.position);
      if (square > least && !(best && squared_norm(p.position - best.position) <= tie * tie)) return;
      if (square > radius * radius) return;
      if (!best || squared_norm(p.position - best.position) > tie * tie) {
        shared = 0, normal = into = {};
        weights = 0, only_walls = true;
      }
      if (square <= least || !best) {
        least = std::min(least, square);
        best.triangle = id, best.position = p.position, best.wall = t.wall;
      }
      bool known = false;
      for (int k = 0; k < shared; ++k) known = known || sharing[k] == id;
      if (known) return;
      if (shared < 24) sharing[shared++] = id;
      double weight = 1;
      if (p.feature == ClosestPoint::vertex) {
        const Vec3 a = c[(p.corner + 1) % 3] - c[p.corner], b = c[(p.corner + 2) % 3] - c[p.corner];
        weight = std::atan2(norm(cross(a, b)), dot(a, b));
      }
      const Vec3 own = normalized(scaled_normal(c));
      normal += weight * own;
      weights += weight;
      only_walls = only_walls && t.wall;
      if (into == Vec3{} || dot(own, x - p.position) < 0) into = own;
    });
    return std::sqrt(least);
  });
  if (!best) return best;
  // The walls of a closed or nearly closed cut coincide, and the normals of their sum may have any direction:
  // next to them, below them and ahead of them is tissue. In a gap so narrow a point is nearest to a wall,
  // never to where walls meet.
  const bool along_fold = norm(normal) < (only_walls && shared > 1 ? folded : 1e-6) * weights;
  const bool before = dot(x - best.position, normal) >= 0;
  const bool tissue = along_fold || !before || (only_walls && through_each_other(x, best.position));
  best.normal = normalized(along_fold ? into : normal);
  best.distance = tissue ? -std::sqrt(least) : std::sqrt(least);
  return best;
}

}  // namespace cleft
