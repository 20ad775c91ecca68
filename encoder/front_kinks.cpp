#include "encoder/front_kinks.h"

#include <algorithm>
#include <cmath>

namespace cleft {

FrontKinks front_kinks(const FieldGeometry& geometry, const std::vector<double>& extent,
                       const std::vector<double>& times) {
  const TipPath& tip = geometry.tip;
  const std::size_t last = times.size() - 1;
  const bool joined_first = extent[4] != 0, joined_last = extent[5] != 0;
  FrontKinks kinks;
  const auto add = [&](double t, bool felt) {
    const auto after =
        static_cast<std::size_t>(std::lower_bound(times.begin(), times.end(), t) - times.begin());
    if (after == 0 || after > last) return;
    const std::size_t frame = t - times[after - 1] < times[after] - t ? after - 1 : after;
    if (frame == 0 || frame == last) return;
    kinks.own.push_back({static_cast<int>(frame), times[frame] / times.back()});
    if (felt) kinks.felt.push_back(kinks.own.back());
  };
  if (joined_first) add(tip.passes(extent[0]), true);
  if (joined_last) add(tip.passes(extent[1]), true);
  const double slack = 1e-9 * (geometry.domain[0].back - geometry.domain[0].front);
  const auto moves = [&](std::size_t i) { return tip.positions[i + 1] - tip.positions[i] > slack; };
  for (std::size_t i = 1; i + 1 < tip.times.size(); ++i)
    if (moves(i - 1) != moves(i))
      add(tip.times[i], !(joined_first && tip.positions[i] <= geometry.domain[0].front + slack) &&
                            !(joined_last && tip.positions[i] >= geometry.domain[0].back - slack));
  return kinks;
}

bool waits(const TipPath& tip) {
  constexpr double part = 0.1;
  const double begins = tip.passes(std::nextafter(tip.positions.front(), HUGE_VAL));
  return begins > tip.times.front() + part * (tip.times.back() - tip.times.front());
}

std::vector<TimeKink> kinks_of_all(const std::vector<FrontKinks>& of_breaks, std::size_t own,
                                   std::size_t frames) {
  constexpr int least = 4;  // steps from frame to frame
  std::vector<TimeKink> all;
  const auto take = [&](const std::vector<TimeKink>& some) {
    for (const TimeKink& one : some) {
      bool far = one.frame >= least && one.frame + least < static_cast<int>(frames);
      for (const TimeKink& other : all) far = far && std::abs(one.frame - other.frame) >= least;
      if (far) all.push_back(one);
    }
  };
  take(of_breaks[own].own);
  for (const FrontKinks& other : of_breaks) take(other.felt);
  std::sort(all.begin(), all.end(), [](const TimeKink& a, const TimeKink& b) { return a.frame < b.frame; });
  return all;
}

}  // namespace cleft
