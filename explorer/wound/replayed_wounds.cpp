#include "explorer/wound/replayed_wounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cleft {

namespace {
/// mm: the vertices that the guard moves are never left out.
constexpr double never_left_out = std::numeric_limits<double>::infinity();
}  // namespace

ReplayedWounds::ReplayedWounds(std::vector<Wound> wounds) : begins_{0} {
  for (Wound& wound : wounds) {
    whole_.replays.emplace_back(add(std::move(wound)));
    begins_.push_back(begins_.back() + whole_.replays.back().path_length());
  }
  const std::vector<const Wound*> all = first(size());
  set_crossings(crossings_of(all));
  for (std::size_t k = 0; k < size(); ++k) {
    std::vector<BesideCut>& beside = whole_.beside.emplace_back();
    for (const ActiveVertex& a : active(k))
      beside.emplace_back(a, (*this)[k]).keep_with_own_piece(a, a.vertex, k, all, crossings());
  }
  std::vector<Vec3> moved(size() > 1 ? vertex_count() : 0);
  for (std::size_t k = 0; k + 1 < size(); ++k) {
    whole_.replays[k].positions((*this)[k].reached(), moved);
    std::vector<Vec3>& displacements = whole_.complete.emplace_back();
    for (const ActiveVertex& a : active(k)) {
      const std::size_t v = a.vertex;
      displacements.push_back(moved[v] - rest()[v]);
    }
    set_relief(k + 1, cleft::relief_while_cut(first(k + 2)));
  }
  std::vector<Vec3> now(vertex_count());
  std::vector<std::vector<int>> number(size(), std::vector<int>(vertex_count()));
  for (std::size_t k = 0; k < size(); ++k)
    for (std::size_t i = 0; i < active(k).size(); ++i) number[k][active(k)[i].vertex] = static_cast<int>(i);
  set_guard(found_guard(
      [&](const Blade& blade) {
        whole_.replays[blade.cut].active_positions(blade.s, now);
        std::vector<Moved> found;
        found.reserve(active(blade.cut).size());
        for (std::size_t i = 0; i < active(blade.cut).size(); ++i) {
          const int v = active(blade.cut)[i].vertex;
          found.push_back({v, whole_.beside[blade.cut][i], now[v] - rest()[v]});
        }
        return found;
      },
      [&](int vertex, const Blade& blade) {
        return whole_.replays[blade.cut].displacement(static_cast<std::size_t>(number[blade.cut][vertex]),
                                                      blade.s);
      },
      true));
  bound_vertices();
}

/// A cut moves a vertex by no more than the bound of its replay, times its largest amplitude there: alone
/// that of the first is 1, and then those of its relief, which are linear in between, and what lips lean.
void ReplayedWounds::bound_vertices() {
  bounds_.assign(vertex_count(), 0);
  for (std::size_t k = 0; k < size(); ++k) {
    // Of each later cut's relief the stations are others: they are linear between all of these.
    Amplitude largest;
    for (std::size_t later = std::max<std::size_t>(k, 1); later < size(); ++later)
      if (relief(later).steps() > 0) {
        const std::vector<double>& more = relief(later).amplitude(0, k).stations;
        largest.stations.insert(largest.stations.end(), more.begin(), more.end());
      }
    std::ranges::sort(largest.stations);
    const std::size_t stations = largest.stations.size();
    largest.values.assign(stations, k == 0 ? 1. : 0.);
    largest.leans = largest.shifts = std::vector<double>(stations, 0.);
    for (std::size_t later = std::max<std::size_t>(k, 1); later < size(); ++later)
      for (std::size_t step = 0; step < relief(later).steps(); ++step)
        for (std::size_t i = 0; i < stations; ++i) {
          const auto enlarge = [&, i](const Amplitude& amplitude) {
            const Amplitude::At there = amplitude(largest.stations[i]);
            largest.values[i] = std::max(largest.values[i], there.value);
            largest.leans[i] = std::max(largest.leans[i], std::abs(there.lean));
            largest.shifts[i] = std::max(largest.shifts[i], std::abs(there.shift));
          };
          enlarge(relief(later).amplitude(step, k));
          for (const Amplitude& corners : relief(later).amplitude(step, k).of_corners) enlarge(corners);
        }
    const Replay& replay = whole_.replays[k];
    for (std::size_t i = 0; i < replay.active().size(); ++i) {
      const BesideCut& at = whole_.beside[k][i];
      Amplitude::At there{1, 0, 0};
      if (!largest.stations.empty()) {
        there = largest(at.s);
        if (at.corner > 0) {
          const Amplitude::At corner = largest(at.corner_s);
          there = {std::max(there.value, corner.value), std::max(there.lean, corner.lean),
                   std::max(there.shift, corner.shift)};
        }
      }
      // The norm of A I + l a^T, of perpendicular vectors whose lengths have the product 2 half.
      const double half = norm(at.across) * norm(there.added(at)) / 2;
      bounds_[replay.active()[i].vertex] += replay.bound(i) * (half + std::hypot(half, there.value));
    }
  }
  for (const int v : guard().vertices()) bounds_[v] = never_left_out;
  for (const int v : guard().moments().vertices()) bounds_[v] = never_left_out;
}

std::size_t ReplayedWounds::Level::active() const {
  std::size_t count = 0;
  for (const Replay& replay : replays) count += replay.active().size();
  return count;
}

std::size_t ReplayedWounds::Level::left_out() const {
  std::size_t count = 0;
  for (const Replay& replay : replays) count += replay.left_out();
  return count;
}

ReplayedWounds::Level ReplayedWounds::level(double detail) const {
  Level level;
  for (std::size_t k = 0; k < size(); ++k) {
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < active(k).size(); ++i) {
      const double bound = bounds_[active(k)[i].vertex];
      if (bound > detail)
        chosen.push_back(i);
      else
        level.error = std::max(level.error, bound);
    }
    level.replays.push_back(whole_.replays[k].of(chosen));
    std::vector<BesideCut>& beside = level.beside.emplace_back();
    for (const std::size_t i : chosen) beside.push_back(whole_.beside[k][i]);
    if (k + 1 == size()) break;
    std::vector<Vec3>& complete = level.complete.emplace_back();
    for (const std::size_t i : chosen) complete.push_back(whole_.complete[k][i]);
  }
  return level;
}

Wounds::Blade ReplayedWounds::blade(double t) const {
  std::size_t cut = 0;
  while (cut + 1 < size() && t > begins_[cut + 1]) ++cut;
  return {cut, std::clamp(t - begins_[cut], 0., path_length(cut))};
}

void ReplayedWounds::positions(double t, const Level& level, std::span<Vec3> out) const {
  const Blade now = blade(t);
  superpose(now, level, out);
  guard().apply(now.cut, now.s, rest().data(), out.data());
}

void ReplayedWounds::superpose(const Blade& now, const Level& level, std::span<Vec3> out) const {
  const Replay& cutting = level.replays[now.cut];
  cutting.positions(std::min(now.s, (*this)[now.cut].reached()), out);
  if (now.cut == 0) return;
  const Relief::At relief = relief_at(now);
  auto at = level.beside[now.cut].begin();
  for (const ActiveVertex& a : cutting.active()) {
    const std::size_t v = a.vertex;
    out[v] = rest()[v] + relief.relieved(now.cut, *at++, out[v] - rest()[v]);
  }
  for (std::size_t k = 0; k < now.cut; ++k)
    for (std::size_t i = 0; i < level.complete[k].size(); ++i) {
      const ActiveVertex& a = level.replays[k].active()[i];
      out[a.vertex] += relief.relieved(k, level.beside[k][i], level.complete[k][i]);
    }
}

}  // namespace cleft
