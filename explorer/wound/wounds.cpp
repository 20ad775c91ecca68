#include "explorer/wound/wounds.h"

#include <algorithm>

namespace cleft {

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
  Vec3 sum;
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

}  // namespace cleft
