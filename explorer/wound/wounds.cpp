#include "explorer/wound/wounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include "base/error.h"

namespace cleft {

namespace {
/// At how many positions of the blade in each cut the guard looks at the skin, and in how many pieces of it
/// the relief is linear there.
constexpr int looks = 48, relief_looks = 48;
/// Of its own flat patch a field that keeps less turns it over.
constexpr double least_area = 0.3, least_cosine = 0.1;
/// Of the area of a triangle in space and in the patch, the less over the larger, where they are compared.
constexpr double least_alike = 0.7;
/// Of a triangle's shape, which is 1 if its sides are equal; and of the cut's depth: as far is the tip felt.
constexpr double well_shaped = 0.4, tip_part = 0.5;
/// mm: neighbours that move apart by no more are never torn.
constexpr double least_jump = 0.05;
/// Of that: a field that moves its own lips into each other by more does so on any mesh.
constexpr double part_closed = 0.4;
}  // namespace

Wound& Wounds::add(Wound wound) {
  relief_.push_back(relief_.empty() ? Relief() : relief_.back());
  return wounds_.emplace_back(std::move(wound));
}

std::vector<const Wound*> Wounds::first(std::size_t count) const {
  std::vector<const Wound*> result;
  for (std::size_t k = 0; k < count; ++k) result.push_back(&wounds_[k]);
  return result;
}

Relief::At Wounds::relief_at(const Blade& blade) const {
  const Wound& newest = wounds_[blade.cut];
  return relief_[blade.cut].at(blade.s / (newest.incision->path().length() * newest.scale()));
}

double Wounds::amplitude(std::size_t cut, double s, const Blade& blade) const {
  return relief_at(blade).amplitude(cut, s);
}

Vec3 Wounds::displacement_below(const Vec3& place, double depth, int nearest, std::span<const Side> sides,
                                const Blade& blade) const {
  // What the guard changes of the skin falls to nothing down to the bottom of the cut.
  const double deep = wounds_.front().field.shape().cut().depth;
  Vec3 sum = std::max(0., 1 - depth / deep) * changed_by_guard(nearest, blade);
  for (std::size_t k = 0; k <= blade.cut; ++k) {
    const Wound& wound = wounds_[k];
    const double s = k == blade.cut ? blade.s : wound.complete();
    auto at = wound.volume.locate_below(place, depth, nearest, sides[k]);
    // Ahead of the blade nothing has two sides yet, though the cell may have been split.
    if (at && at->s >= s) at = wound.volume.locate_below(place, depth, nearest, Side::both);
    if (!at) continue;
    const double own_time = std::clamp(s + at->time_offset, 0., wound.field.shape().cut().length);
    sum += amplitude(k, at->s, blade) / wound.scale() *
           at->in_mesh(wound.field.displacement(at->uvw, at->side, own_time, at->s));
  }
  return sum;
}

/// What the guard adds to the displacement of a vertex.
Vec3 Wounds::changed_by_guard(int vertex, const Blade& blade) const {
  const auto own = [&](int v) {
    Vec3 sum;
    for (std::size_t k = 0; k <= blade.cut; ++k) {
      const Wound& wound = wounds_[k];
      const auto at = wound.volume.locate(v);
      if (!at) continue;
      const double s = k == blade.cut ? blade.s : wound.complete(),
                   t = std::clamp(s + at->time_offset, 0., wound.field.shape().cut().length);
      const Side side = at->on_cut && at->s >= s ? Side::both : at->side;
      sum += amplitude(k, at->s, blade) / wound.scale() *
             at->in_mesh(wound.field.displacement(at->uvw, side, t, at->s));
    }
    return sum;
  };
  return guard_.moves(vertex) ? guard_.displacement(vertex, own) - own(vertex) : Vec3{};
}

/// The amplitudes while the blade makes the newest of some cuts.
Relief Wounds::relief_while_cut(std::size_t newest, double length) const {
  if (newest == 0) return {};
  std::vector<std::vector<Amplitude>> steps;
  try {
    for (int i = 0; i <= relief_looks; ++i)
      steps.push_back(mutual_relief(first(newest + 1), length * i / relief_looks));
  } catch (const InputError&) {  // the field does not tell the tension: displacements add
    return {};
  }
  return Relief(steps);
}

void Wounds::find_guard(const std::function<std::vector<Moved>(const Blade&)>& moved) {
  std::vector<Blade> blades;
  GuardSearch search(wounds_.front().incision->mesh(), least_jump / wounds_.front().scale(),
                     {[&](int t, std::size_t time) { return turned_by_field(t, blades[time]); },
                      [this](int a, int b, double jump) { return stretched_by_field(a, b, jump); },
                      [&](int left, std::size_t time) { return closed_by_field(left, blades[time]); }});
  for (const Wound& wound : wounds_)
    for (const Incision::ChainVertex& c : wound.incision->chain())
      if (c.left != c.right) search.add_pair(c.left, c.right, wound.incision->path().at(c.s).across);
  std::vector<std::vector<Moved>> complete;
  std::vector<std::pair<int, Vec3>> sum;
  std::vector<int> place(wounds_.front().incision->mesh().vertices().size(), -1);  // in the sum
  const auto add = [&](const std::vector<Moved>& some, const Relief::At& now, std::size_t cut) {
    for (const auto& [v, s, d] : some) {
      const Vec3 scaled = now.amplitude(cut, s) * d;
      if (place[v] < 0)
        place[v] = static_cast<int>(sum.size()), sum.emplace_back(v, scaled);
      else
        sum[place[v]].second += scaled;
    }
  };
  for (std::size_t k = 0; k < size(); ++k) {
    const double length = wounds_[k].reached();
    const Relief relief = relief_while_cut(k, length);
    for (int i = 1; i <= looks; ++i) {
      const double part = static_cast<double>(i) / looks;
      blades.push_back({k, length * part});
      const Relief::At now = relief.at(part);
      std::vector<Moved> own = moved(blades.back());
      add(own, now, k);
      for (std::size_t j = 0; j < k; ++j) add(complete[j], now, j);
      for (const auto& [v, d] : sum) place[v] = -1;
      search.add(std::exchange(sum, {}));
      if (i == looks) complete.push_back(std::move(own));
    }
  }
  guard_ = search.find();
}

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
      const Side side = at->on_cut && at->s >= s ? Side::both : at->side;
      const double t = std::clamp(s + at->time_offset, 0., wound.field.shape().cut().length);
      const Derivatives d = wound.field.derivatives(at->uvw, side, t, at->s);
      const double area = cross(Vec3{1, 0, 0} + d.by_u, Vec3{0, 1, 0} + d.by_v).z;
      together += amplitude(k, at->s, blade) * (area - 1);
      if (std::min(area, together) < least_area) return true;
    }
  }
  return turned_between_corners(triangle, blade);
}

/// The same for a triangle next to the tip as it lies in the flat patch of the cut, moved by the field at its
/// corners: a fit oscillates at the tip while it passes, between corners whose derivatives show nothing. Of
/// well-shaped triangles only, and where the mesh lies in the patch as in space: slivers are the mesh's
/// fault.
bool Wounds::turned_between_corners(int triangle, const Blade& blade) const {
  const CutMesh& mesh = wounds_.front().incision->mesh();
  const auto& corners = mesh.triangle(triangle).vertex;
  const auto twice_area = [](const std::array<Vec3, 3>& p) { return cross(p[1] - p[0], p[2] - p[0]); };
  const Wound& wound = wounds_[blade.cut];
  std::array<Vec3, 3> space, rest, now;
  for (int i = 0; i < 3; ++i) {
    const auto at = wound.volume.locate(corners[i]);
    if (!at || !(std::abs(at->s - blade.s) < tip_part * wound.field.shape().cut().depth)) return false;
    const Side side = at->on_cut && at->s >= blade.s ? Side::both : at->side;
    const double t = std::clamp(blade.s + at->time_offset, 0., wound.field.shape().cut().length);
    space[i] = wound.scale() * mesh.position(corners[i]);
    rest[i] = {at->uvw.x, at->uvw.y, 0};
    now[i] = rest[i] + amplitude(blade.cut, at->s, blade) * at->weight *
                           wound.field.displacement(at->uvw, side, t, at->s);
  }
  const Vec3 before = twice_area(rest), after = twice_area(now);
  const double area = norm(before), area_now = norm(after), alike = area / norm(twice_area(space));
  const double sides =
      squared_norm(rest[1] - rest[0]) + squared_norm(rest[2] - rest[1]) + squared_norm(rest[0] - rest[2]);
  if (!(alike > least_alike && alike < 1 / least_alike) || 2 * std::sqrt(3.) * area < well_shaped * sides)
    return false;
  return area_now < least_area * area || dot(before, after) < least_cosine * area * area_now;
}

/// Whether two vertices that move apart by more than `jump`, mesh units, are nearer to each other in the flat
/// patches of all cuts: the fields stretch the skin between them.
bool Wounds::stretched_by_field(int a, int b, double jump) const {
  const auto apart = [](Side x, Side y) { return x != y && x != Side::both && y != Side::both; };
  bool moved = false;
  for (const Wound& wound : wounds_) {
    const auto from = wound.volume.locate(a), to = wound.volume.locate(b);
    if (!from || !to) continue;
    moved = true;
    if (apart(from->side, to->side) || !(norm(to->uvw - from->uvw) < jump * wound.scale())) return false;
  }
  return moved;
}

/// Whether the field of a cut moves its lips into each other.
bool Wounds::closed_by_field(int lip, const Blade& blade) const {
  for (std::size_t k = 0; k <= blade.cut; ++k) {
    const Wound& wound = wounds_[k];
    const double s = k == blade.cut ? blade.s : wound.complete();
    const auto at = wound.volume.locate(lip);
    if (!at || !at->on_cut || at->s >= s) continue;
    const double t = std::clamp(s + at->time_offset, 0., wound.field.shape().cut().length);
    const auto moved = [&](Side side) {
      return wound.field.displacement({at->uvw.x, 0, at->uvw.z}, side, t, at->s).y;
    };
    if (moved(Side::right) - moved(Side::left) < -least_jump * part_closed) return true;
  }
  return false;
}

}  // namespace cleft
