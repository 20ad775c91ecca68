#include "explorer/wound/touched_at.h"

#include <algorithm>

namespace cleft {

namespace {
/// Of a cut as long as the canonical one; and of a stretch, how near cuts touch.
constexpr int own_stretches = 30;
constexpr double touching = 0.25;
}  // namespace

double canonical_stretch(const Wound& wound) { return wound.field.shape().cut().length / own_stretches; }

double touching_within(const Wound& wound) { return touching * canonical_stretch(wound); }

std::vector<double> touched_at(const Wound& cut, const Wound& other) {
  constexpr int samples_a_stretch = 2, rounds = 20;
  const ScalpelPath &path = cut.incision->path(), &other_path = other.incision->path();
  const double length = cut.complete(), other_end = other.complete() / other.scale();
  const int samples = std::max(2, static_cast<int>(samples_a_stretch * length / canonical_stretch(cut)));
  const auto distance = [&](double s) {
    const Vec3 there = cut.scale() / other.scale() * path.at(s / cut.scale()).position;
    const double other_s = std::clamp(other_path.coordinates(there, 0, other_end).s, 0., other_end);
    return other.scale() * norm(other_path.at(other_s).position - there);
  };
  std::vector<double> found, distances;
  for (int i = 0; i <= samples; ++i) distances.push_back(distance(length * i / samples));
  for (int i = 0; i <= samples; ++i) {
    const bool nearest =
        (i == 0 || distances[i - 1] >= distances[i]) && (i == samples || distances[i + 1] > distances[i]);
    // Between samples it is nearer by no more than the way to them.
    if (!nearest || distances[i] > touching_within(cut) + length / samples) continue;
    double from = length * std::max(0, i - 1) / samples, to = length * std::min(samples, i + 1) / samples;
    for (int round = 0; round < rounds; ++round) {
      const double third = (to - from) / 3;
      if (distance(from + third) < distance(to - third))
        to -= third;
      else
        from += third;
    }
    if (distance((from + to) / 2) < touching_within(cut)) found.push_back((from + to) / 2);
  }
  return found;
}

}  // namespace cleft
