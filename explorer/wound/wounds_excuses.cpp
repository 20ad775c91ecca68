// What the fields do themselves, in their own flat patches: that is no fault of the mesh.
#include <algorithm>
#include <array>
#include <cmath>

#include "explorer/wound/wounds.h"

namespace cleft {

namespace {
/// Of its own flat patch a field that keeps less turns it over.
constexpr double least_area = 0.3;
/// Likewise of a triangle as it lies in the patch, as much as is called turned over on a mesh.
constexpr double least_triangle = 0.2;
/// Of the area of a triangle in space and in the patch, the less over the larger, where they are compared.
constexpr double least_alike = 0.7;
/// Of a triangle's shape, which is 1 if its sides are equal; and of the cut's depth: as far is the tip felt.
constexpr double well_shaped = 0.4, tip_part = 0.5;
/// Lengths in the patch and in space that are about the same.
constexpr double about = 1.25;
/// Of an edge's length in space, its length in a patch: where it is more, the patch is drawn apart there.
constexpr double most_drawn = 2;
/// Of that: a field that moves its own lips into each other by more does so on any mesh.
constexpr double part_closed = 0.4;
}  // namespace

/// Whether the fields turn their own flat patches over at a triangle's corner, or nearly so: each of them, or
/// what they change of the area together.
bool Wounds::turned_by_field(int triangle, const Blade& blade) const {
  for (const int v : wounds_.front().incision->mesh().triangle(triangle).vertex) {
    double together = 1;
    for (std::size_t k = 0; k <= blade.cut; ++k) {
      const Wound& wound = wounds_[k];
      const double s = k == blade.cut ? blade.s : wound.complete();
      const auto at = wound.volume.locate(v);
      if (!at) continue;
      const Side side = at->side_at(s);
      const double t = at->time_at(s, wound.field.shape().cut().length);
      const Derivatives d = wound.field.derivatives(at->uvw, side, t, at->s);
      const double area = cross(Vec3{1, 0, 0} + d.by_u, Vec3{0, 1, 0} + d.by_v).z;
      together += amplitude(k, at->s, blade) * (area - 1);
      if (std::min(area, together) < least_area) return true;
    }
  }
  return turned_between_corners(triangle, blade);
}

/// The same for a triangle next to the tip as it lies in the flat patch of the cut, moved by the field at its
/// corners: a fit oscillates at the tip while it passes, between corners whose derivatives show nothing.
/// Where the mesh lies in the patch as in space. Slivers are the mesh's fault.
bool Wounds::turned_between_corners(int triangle, const Blade& blade) const {
  const CutMesh& mesh = wounds_.front().incision->mesh();
  const auto& corners = mesh.triangle(triangle).vertex;
  const auto twice_area = [](const std::array<Vec3, 3>& p) { return cross(p[1] - p[0], p[2] - p[0]); };
  const Wound& wound = wounds_[blade.cut];
  std::array<Vec3, 3> space, rest, moved;
  double part = 1;  // the least: that displacements are held back from corner to corner is not the field's
  for (int i = 0; i < 3; ++i) {
    const auto at = wound.volume.locate(corners[i]);
    if (!at || !(std::abs(at->s - blade.s) < tip_part * wound.field.shape().cut().depth)) return false;
    const Side side = at->side_at(blade.s);
    const double t = at->time_at(blade.s, wound.field.shape().cut().length);
    space[i] = wound.scale() * mesh.position(corners[i]);
    rest[i] = {at->s, at->uvw.y, 0};
    ActiveVertex flat = *at;
    flat.along = {1, 0, 0}, flat.across = {0, 1, 0}, flat.outward = {0, 0, 1};
    moved[i] =
        relieved(blade.cut, flat, corners[i], wound.field.displacement(at->uvw, side, t, at->s), blade);
    part = std::min(part, at->weight);
  }
  std::array<Vec3, 3> now = rest;
  for (int i = 0; i < 3; ++i) now[i] += part * moved[i];
  const Vec3 before = twice_area(rest), after = twice_area(now);
  const double area = norm(before), area_now = norm(after), alike = area / norm(twice_area(space));
  const double sides =
      squared_norm(rest[1] - rest[0]) + squared_norm(rest[2] - rest[1]) + squared_norm(rest[0] - rest[2]);
  if (!(alike > least_alike && alike < 1 / least_alike)) return false;
  if (2 * std::sqrt(3.) * area < well_shaped * sides) return false;
  return area_now < least_triangle * area || dot(before, after) < 0;
}

/// Whether two vertices that move apart by more than `jump`, mesh units, are nearer to each other in the flat
/// patches of all cuts: the fields stretch the skin between them, and not that the patches are drawn apart.
bool Wounds::stretched_by_field(int a, int b, double jump) const {
  const CutMesh& mesh = wounds_.front().incision->mesh();
  const double length = norm(mesh.position(b) - mesh.position(a));
  const auto apart = [](Side x, Side y) { return x != y && x != Side::both && y != Side::both; };
  bool moved = false;
  for (const Wound& wound : wounds_) {
    const auto from = wound.volume.locate(a), to = wound.volume.locate(b);
    if (!from || !to) continue;
    moved = true;
    // By s and not by u: between the halves of a path longer than the canonical cut u does not change.
    const Vec3 between{to->s - from->s, to->uvw.y - from->uvw.y, to->uvw.z - from->uvw.z};
    if (apart(from->side, to->side) || !(norm(between) < about * jump * wound.scale())) return false;
    if (norm(between) > most_drawn * wound.scale() * length) return false;
  }
  return moved;
}

/// Whether the field of the only cut moves two vertices apart by about as much as `jump`, mesh units, once
/// the cut is complete, where they are about as near to each other in its flat patch as in space.
bool Wounds::drawn_apart_by_field(int a, int b, double jump) const {
  if (wounds_.size() != 1) return false;
  const Wound& wound = wounds_.front();
  std::array<Vec3, 2> rest, moved;
  for (int i = 0; i < 2; ++i) {
    const auto at = wound.volume.locate(i == 0 ? a : b);
    if (!at) return false;
    const double s = wound.complete(), t = at->time_at(s, wound.field.shape().cut().length);
    rest[i] = {at->s, at->uvw.y, at->uvw.z};
    moved[i] = wound.field.displacement(at->uvw, at->side_at(s), t, at->s);
  }
  const CutMesh& mesh = wound.incision->mesh();
  const double length = wound.scale() * norm(mesh.position(b) - mesh.position(a));
  return norm(rest[1] - rest[0]) < about * length && about * norm(moved[1] - moved[0]) > jump * wound.scale();
}

/// Whether the field of a cut moves its lips into each other.
bool Wounds::closed_by_field(int lip, const Blade& blade) const {
  for (std::size_t k = 0; k <= blade.cut; ++k) {
    const Wound& wound = wounds_[k];
    const double s = k == blade.cut ? blade.s : wound.complete();
    const auto at = wound.volume.locate(lip);
    if (!at || !at->on_cut || !at->is_passed(s)) continue;
    const double t = at->time_at(s, wound.field.shape().cut().length);
    const auto moved = [&](Side side) {
      return wound.field.displacement({at->uvw.x, 0, at->uvw.z}, side, t, at->s).y;
    };
    if (moved(Side::right) - moved(Side::left) < -GuardSearch::least_jump_mm * part_closed) return true;
  }
  return false;
}

}  // namespace cleft
