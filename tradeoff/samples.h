// Openings at places along the cut and over time, the same ones whatever the mesh.
#pragma once

#include <algorithm>
#include <vector>

#include "base/vec3.h"

namespace cleft {

using Samples = std::vector<Vec3>;

/// at(s, t) over a cut of this length, mm.
template <class At>
Samples sampled(double length, const At& at) {
  constexpr int grid = 96;
  Samples samples;
  for (int j = 1; j <= grid; ++j)
    for (int i = 1; i < grid; ++i) samples.push_back(at(length * i / grid, length * j / grid));
  return samples;
}

inline Samples difference(const Samples& a, const Samples& b) {
  Samples d(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) d[i] = a[i] - b[i];
  return d;
}

/// The largest norm.
inline double size_of(const Samples& samples) {
  double most = 0;
  for (const Vec3& x : samples) most = std::max(most, norm(x));
  return most;
}

}  // namespace cleft
