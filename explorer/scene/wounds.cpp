#include "explorer/scene/wounds.h"

#include <algorithm>

#include "base/error.h"

namespace cleft {

namespace {
constexpr int relief_pieces = 48;  // of the last cut's way, between which the relief is linear
}

Wounds::Wounds(std::vector<Cut> cuts, double scale) : cuts_(std::move(cuts)) {
  std::vector<std::unique_ptr<IncisionVolume>> volumes;
  std::vector<CutInTension> in_tension;
  for (const Cut& cut : cuts_) {
    replays_.emplace_back(cut.field, *cut.incision, scale);
    volumes.push_back(std::make_unique<IncisionVolume>(*cut.incision, cut.field.shape(), scale));
    in_tension.push_back({cut.incision, &cut.field, volumes.back().get()});
  }
  if (cuts_.size() == 1) return;
  for (std::size_t k = 0; k + 1 < cuts_.size(); ++k) {
    std::vector<Vec3> moved(vertex_count());
    replays_[k].positions(replays_[k].path_length(), moved);
    std::vector<Vec3>& displacements = complete_.emplace_back();
    for (const ActiveVertex& a : replays_[k].active()) {
      const auto v = static_cast<std::size_t>(a.vertex);
      displacements.push_back(moved[v] - rest()[v]);
    }
  }
  for (int i = 0; i <= relief_pieces; ++i) {
    blades_.push_back(replays_.back().path_length() * i / relief_pieces);
    relief_.push_back(mutual_relief(in_tension, blades_.back()));
  }
}

std::size_t Wounds::active() const {
  std::size_t count = 0;
  for (const Replay& replay : replays_) count += replay.active().size();
  return count;
}

double Wounds::amplitude(std::size_t cut, double s, double blade) const {
  const double at = std::clamp(blade / blades_.back(), 0., 1.) * relief_pieces;
  const auto i = std::min(static_cast<std::size_t>(at), blades_.size() - 2);
  const double part = at - static_cast<double>(i);
  return (1 - part) * relief_[i][cut].at(s) + part * relief_[i + 1][cut].at(s);
}

void Wounds::positions(double s, std::span<Vec3> out) const {
  replays_.back().positions(s, out);
  if (cuts_.size() == 1) return;
  const std::size_t last = cuts_.size() - 1;
  for (const ActiveVertex& a : replays_.back().active()) {
    const auto v = static_cast<std::size_t>(a.vertex);
    out[v] = rest()[v] + amplitude(last, a.s, s) * (out[v] - rest()[v]);
  }
  for (std::size_t k = 0; k < last; ++k)
    for (std::size_t i = 0; i < complete_[k].size(); ++i) {
      const ActiveVertex& a = replays_[k].active()[i];
      out[static_cast<std::size_t>(a.vertex)] += amplitude(k, a.s, s) * complete_[k][i];
    }
}

}  // namespace cleft
