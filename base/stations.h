// Values that are known at stations of a path, and linear between them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace cleft {

/// The stations next to a place, and the part of the way from one to the other, 0 to 1. Beyond the ends both
/// are the last one.
struct NextStations {
  std::size_t before, after;
  double part;
};

/// There must be a station; stations do not decrease.
inline NextStations between(const std::vector<double>& stations, double s) {
  const auto next =
      static_cast<std::size_t>(std::upper_bound(stations.begin(), stations.end(), s) - stations.begin());
  const std::size_t a = next == 0 ? 0 : next - 1, b = std::min(next, stations.size() - 1);
  return {a, b, a == b ? 0 : (s - stations[a]) / (stations[b] - stations[a])};
}

}  // namespace cleft
