#include "encoder/samples.h"

#include <algorithm>
#include <cmath>

namespace cleft {

std::vector<Sample> samples_of(const Snapshot& snapshot) {
  double half_width = 0;
  for (const Vec3& p : snapshot.points) half_width = std::max(half_width, std::abs(p.y));
  const double on_plane = 1e-9 * half_width;
  std::vector<Sample> samples;
  samples.reserve(snapshot.points.size());
  for (Vec3 p : snapshot.points) {
    if (std::abs(p.y) <= on_plane) p.y = 0;
    samples.push_back({p, side_of(p.y)});
  }
  for (const auto& [left, right] : snapshot.pairs) {
    samples[left].side = Side::left;
    samples[right].side = Side::right;
  }
  return samples;
}

std::vector<Sample> samples_in_field(const SnapshotReader& reader) {
  if (!reader.snapshot().has_own_coordinates()) return samples_of(reader.snapshot());
  Snapshot moved = reader.snapshot();
  moved.points = reader.coordinates();
  return samples_of(moved);
}

}  // namespace cleft
