#include "explorer/wound/wounds.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "base/error.h"

namespace cleft {

Wound& Wounds::add(Wound wound) {
  relief_.push_back(relief_.empty() ? Relief() : relief_.back());
  Wound& added = wounds_.emplace_back(std::move(wound));
  for (std::size_t k = 0; k + 1 < wounds_.size(); ++k)
    for (const bool at_end : {false, true})
      if (added.opens_into(wounds_[k], at_end)) added.volume.opens_into(*wounds_[k].incision, at_end);
  return added;
}

std::vector<const Wound*> Wounds::first(std::size_t count) const {
  std::vector<const Wound*> result;
  for (std::size_t k = 0; k < count; ++k) result.push_back(&wounds_[k]);
  return result;
}

/// Of the blade's way through its cut.
double Wounds::part_made(const Blade& blade) const {
  const double reached = wounds_[blade.cut].reached();
  return blade.s < reached ? blade.s / reached : 1;
}

Relief::At Wounds::relief_at(const Blade& blade) const { return relief_[blade.cut].at(part_made(blade)); }

double Wounds::amplitude(std::size_t cut, double s, const Blade& blade) const {
  return relief_at(blade).amplitude(cut, s);
}

Vec3 Wounds::relieved(std::size_t cut, const ActiveVertex& at, int nearest, const Vec3& alone,
                      const Blade& blade) const {
  BesideCut beside(at, wounds_[cut]);
  beside.keep_with_own_piece(at, nearest, cut, first(size()), crossings_);
  return relief_at(blade).relieved(cut, beside, alone);
}

Vec3 Wounds::displacement_below(const Vec3& place, double depth, int nearest, std::span<const Side> sides,
                                const Blade& blade) const {
  // What the guard changes of the skin falls to nothing down to the bottom of the cut.
  const double deep = wounds_.front().field.shape().cut().depth;
  Vec3 sum = std::max(0., 1 - depth / deep) * changed_by_guard(nearest, blade);
  for (std::size_t k = 0; k <= blade.cut; ++k) {
    const Wound& wound = wounds_[k];
    const double s = k == blade.cut ? blade.s : wound.complete();
    std::array<Side, 2> beside{Side::both, Side::both};
    for (const bool at_end : {false, true})
      for (std::size_t j = 0; j < k; ++j)
        if (const auto& mouth = wound.volume.mouth(at_end); mouth && mouth->earlier == wounds_[j].incision)
          beside[at_end] = sides[j];
    auto at = wound.volume.locate_below(place, depth, nearest, sides[k], beside);
    // Ahead of the blade nothing has two sides yet, though the cell may have been split.
    if (at && !at->is_passed(s)) at = wound.volume.locate_below(place, depth, nearest, Side::both, beside);
    if (!at) continue;
    const double own_time = at->time_at(s, wound.field.shape().cut().length);
    sum += 1 / wound.scale() *
           relieved(k, *at, nearest,
                    at->in_mesh(wound.field.displacement(at->uvw, at->side, own_time, at->s)), blade);
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
                   t = at->time_at(s, wound.field.shape().cut().length);
      sum += 1 / wound.scale() *
             relieved(k, *at, v, at->in_mesh(wound.field.displacement(at->uvw, at->side_at(s), t, at->s)),
                      blade);
    }
    return sum;
  };
  const double part = guard_.moments().part(vertex, blade.cut, blade.s);
  if (part == 1 && !guard_.moves(vertex)) return {};
  return part * guard_.displacement(vertex, own) - own(vertex);
}

/// The amplitudes while the blade makes the newest of some cuts.
Relief Wounds::relief_while_cut(std::size_t newest) const {
  if (newest == 0) return {};
  if (relief_[newest].steps() > 1) return relief_[newest];  // a replay has found it
  try {
    return cleft::relief_while_cut(first(newest + 1));
  } catch (const InputError&) {  // the field does not tell the tension: displacements add
    return {};
  }
}

}  // namespace cleft
