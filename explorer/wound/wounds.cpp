#include "explorer/wound/wounds.h"

#include <algorithm>

#include "base/error.h"

namespace cleft {

namespace {
constexpr int relief_pieces = 48;  // of a cut's way, between which the relief is linear
}

Wounds::Wounds(std::vector<Cut> cuts, double scale) : cuts_(std::move(cuts)), scale_(scale), begins_{0} {
  for (const Cut& cut : cuts_) {
    whole_.replays.emplace_back(cut.field, *cut.incision, scale);
    volumes_.push_back(std::make_unique<IncisionVolume>(*cut.incision, cut.field.shape(), scale));
    in_tension_.push_back({cut.incision, &cut.field, volumes_.back().get()});
    begins_.push_back(begins_.back() + whole_.replays.back().path_length());
  }
  relief_.resize(cuts_.size());
  std::vector<Vec3> moved(cuts_.size() > 1 ? vertex_count() : 0);
  for (std::size_t k = 0; k + 1 < cuts_.size(); ++k) {
    whole_.replays[k].positions(path_length(k), moved);
    std::vector<Vec3>& displacements = whole_.complete.emplace_back();
    for (const ActiveVertex& a : active(k)) {
      const std::size_t v = a.vertex;
      displacements.push_back(moved[v] - rest()[v]);
    }
    const std::vector<CutInTension> until(in_tension_.begin(),
                                          in_tension_.begin() + static_cast<std::ptrdiff_t>(k + 2));
    for (int i = 0; i <= relief_pieces; ++i)
      relief_[k + 1].push_back(mutual_relief(until, path_length(k + 1) * i / relief_pieces));
  }
  bound_vertices();
}

/// A cut moves a vertex by no more than the bound of its replay, times its largest amplitude there: alone
/// that of the first is 1, and then those of relief_, which are linear in between.
void Wounds::bound_vertices() {
  bounds_.assign(vertex_count(), 0);
  for (std::size_t k = 0; k < cuts_.size(); ++k) {
    Amplitude largest;
    for (std::size_t later = std::max<std::size_t>(k, 1); later < cuts_.size(); ++later)
      for (const std::vector<Amplitude>& at_once : relief_[later]) {
        const Amplitude& one = at_once[k];
        if (largest.values.empty())
          largest = {one.stations, std::vector(one.values.size(), k == 0 ? 1. : 0.)};
        for (std::size_t i = 0; i < one.values.size(); ++i)
          largest.values[i] = std::max(largest.values[i], one.values[i]);
      }
    const Replay& replay = whole_.replays[k];
    for (std::size_t i = 0; i < replay.active().size(); ++i) {
      const ActiveVertex& a = replay.active()[i];
      bounds_[a.vertex] += replay.bound(i) * (largest.values.empty() ? 1 : largest.at(a.s));
    }
  }
}

std::size_t Wounds::Level::active() const {
  std::size_t count = 0;
  for (const Replay& replay : replays) count += replay.active().size();
  return count;
}

std::size_t Wounds::Level::left_out() const {
  std::size_t count = 0;
  for (const Replay& replay : replays) count += replay.left_out();
  return count;
}

Wounds::Level Wounds::level(double detail) const {
  Level level;
  for (std::size_t k = 0; k < cuts_.size(); ++k) {
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < active(k).size(); ++i) {
      const double bound = bounds_[active(k)[i].vertex];
      if (bound > detail)
        chosen.push_back(i);
      else
        level.error = std::max(level.error, bound);
    }
    level.replays.push_back(whole_.replays[k].of(chosen));
    if (k + 1 == cuts_.size()) break;
    std::vector<Vec3>& complete = level.complete.emplace_back();
    for (const std::size_t i : chosen) complete.push_back(whole_.complete[k][i]);
  }
  return level;
}

Wounds::Blade Wounds::blade(double t) const {
  std::size_t cut = 0;
  while (cut + 1 < cuts_.size() && t > begins_[cut + 1]) ++cut;
  return {cut, std::clamp(t - begins_[cut], 0., path_length(cut))};
}

double Wounds::amplitude(std::size_t cut, double s, const Blade& blade) const {
  const auto& relief = relief_[blade.cut];
  if (relief.empty()) return 1;
  const double at = blade.s / path_length(blade.cut) * relief_pieces;
  const auto i = std::min(static_cast<std::size_t>(at), relief.size() - 2);
  const double part = at - static_cast<double>(i);
  return (1 - part) * relief[i][cut].at(s) + part * relief[i + 1][cut].at(s);
}

void Wounds::positions(double t, const Level& level, std::span<Vec3> out) const {
  const Blade now = blade(t);
  const Replay& cutting = level.replays[now.cut];
  cutting.positions(now.s, out);
  if (now.cut == 0) return;
  for (const ActiveVertex& a : cutting.active()) {
    const std::size_t v = a.vertex;
    out[v] = rest()[v] + amplitude(now.cut, a.s, now) * (out[v] - rest()[v]);
  }
  for (std::size_t k = 0; k < now.cut; ++k)
    for (std::size_t i = 0; i < level.complete[k].size(); ++i) {
      const ActiveVertex& a = level.replays[k].active()[i];
      out[a.vertex] += amplitude(k, a.s, now) * level.complete[k][i];
    }
}

Vec3 Wounds::displacement_below(const Vec3& place, double depth, int nearest, std::span<const Side> sides,
                                double t) const {
  const Blade now = blade(t);
  Vec3 sum;
  for (std::size_t k = 0; k <= now.cut; ++k) {
    const double s = k == now.cut ? now.s : path_length(k);
    auto at = volumes_[k]->locate_below(place, depth, nearest, sides[k]);
    // Ahead of the blade nothing has two sides yet, though the cell may have been split.
    if (at && at->s >= s) at = volumes_[k]->locate_below(place, depth, nearest, Side::both);
    if (!at) continue;
    const VaryingField& field = cuts_[k].field;
    const double own_time = std::clamp(s + at->time_offset, 0., field.shape().cut().length);
    sum += amplitude(k, at->s, now) / scale_ *
           at->in_mesh(field.displacement(at->uvw, at->side, own_time, at->s));
  }
  return sum;
}

}  // namespace cleft
