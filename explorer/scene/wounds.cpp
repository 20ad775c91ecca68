#include "explorer/scene/wounds.h"

#include <algorithm>

#include "base/error.h"

namespace cleft {

namespace {
constexpr int relief_pieces = 48;  // of a cut's way, between which the relief is linear
}

Wounds::Wounds(std::vector<Cut> cuts, double scale, double detail)
    : cuts_(std::move(cuts)), scale_(scale), begins_{0} {
  for (const Cut& cut : cuts_) {
    replays_.emplace_back(cut.field, *cut.incision, scale, detail);
    volumes_.push_back(std::make_unique<IncisionVolume>(*cut.incision, cut.field.shape(), scale));
    in_tension_.push_back({cut.incision, &cut.field, volumes_.back().get()});
    begins_.push_back(begins_.back() + replays_.back().path_length());
  }
  relief_.resize(cuts_.size());
  std::vector<Vec3> moved(cuts_.size() > 1 ? vertex_count() : 0);
  for (std::size_t k = 0; k + 1 < cuts_.size(); ++k) {
    replays_[k].positions(replays_[k].path_length(), moved);
    std::vector<Vec3>& displacements = complete_.emplace_back();
    for (const ActiveVertex& a : replays_[k].active()) {
      const auto v = static_cast<std::size_t>(a.vertex);
      displacements.push_back(moved[v] - rest()[v]);
    }
    const std::vector<CutInTension> until(in_tension_.begin(),
                                          in_tension_.begin() + static_cast<std::ptrdiff_t>(k + 2));
    for (int i = 0; i <= relief_pieces; ++i)
      relief_[k + 1].push_back(mutual_relief(until, replays_[k + 1].path_length() * i / relief_pieces));
  }
}

std::size_t Wounds::active() const {
  std::size_t count = 0;
  for (const Replay& replay : replays_) count += replay.active().size();
  return count;
}

std::size_t Wounds::left_out() const {
  std::size_t count = 0;
  for (const Replay& replay : replays_) count += replay.left_out();
  return count;
}

Wounds::Blade Wounds::blade(double t) const {
  std::size_t cut = 0;
  while (cut + 1 < cuts_.size() && t > begins_[cut + 1]) ++cut;
  return {cut, std::clamp(t - begins_[cut], 0., replays_[cut].path_length())};
}

double Wounds::amplitude(std::size_t cut, double s, const Blade& blade) const {
  const auto& relief = relief_[blade.cut];
  if (relief.empty()) return 1;
  const double at = blade.s / replays_[blade.cut].path_length() * relief_pieces;
  const auto i = std::min(static_cast<std::size_t>(at), relief.size() - 2);
  const double part = at - static_cast<double>(i);
  return (1 - part) * relief[i][cut].at(s) + part * relief[i + 1][cut].at(s);
}

void Wounds::positions(double t, std::span<Vec3> out) const {
  const Blade now = blade(t);
  const Replay& cutting = replays_[now.cut];
  cutting.positions(now.s, out);
  if (now.cut == 0) return;
  for (const ActiveVertex& a : cutting.active()) {
    const auto v = static_cast<std::size_t>(a.vertex);
    out[v] = rest()[v] + amplitude(now.cut, a.s, now) * (out[v] - rest()[v]);
  }
  for (std::size_t k = 0; k < now.cut; ++k)
    for (std::size_t i = 0; i < complete_[k].size(); ++i) {
      const ActiveVertex& a = replays_[k].active()[i];
      out[static_cast<std::size_t>(a.vertex)] += amplitude(k, a.s, now) * complete_[k][i];
    }
}

Vec3 Wounds::displacement_below(const Vec3& place, double depth, int nearest, std::span<const Side> sides,
                                double t) const {
  const Blade now = blade(t);
  Vec3 sum;
  for (std::size_t k = 0; k <= now.cut; ++k) {
    const double s = k == now.cut ? now.s : replays_[k].path_length();
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
