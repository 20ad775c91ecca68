#include "tradeoff/rivals/nearest.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/parallel.h"

namespace cleft {

std::vector<int> nearest_kept(const std::vector<Sample>& samples, const std::vector<int>& kept) {
  std::array<double, 3> low, extent;
  for (int axis = 0; axis < 3; ++axis) {
    const auto [least, greatest] =
        std::minmax_element(samples.begin(), samples.end(),
                            [=](const Sample& a, const Sample& b) { return a.uvw[axis] < b.uvw[axis]; });
    low[axis] = least->uvw[axis], extent[axis] = greatest->uvw[axis] - low[axis];
  }
  // Boxes of about one node kept.
  const double volume = std::max(1e-300, extent[0] * extent[1] * extent[2]);
  const double edge = std::cbrt(volume / static_cast<double>(kept.size()));
  std::array<int, 3> boxes;
  for (int axis = 0; axis < 3; ++axis) boxes[axis] = 1 + static_cast<int>(extent[axis] / edge);
  const auto box_of = [&](const Vec3& p) {
    std::array<int, 3> box;
    for (int axis = 0; axis < 3; ++axis)
      box[axis] = std::clamp(static_cast<int>((p[axis] - low[axis]) / edge), 0, boxes[axis] - 1);
    return box;
  };
  const auto index = [&](int i, int j, int k) {
    return (static_cast<std::size_t>(i) * static_cast<std::size_t>(boxes[1]) + static_cast<std::size_t>(j)) *
               static_cast<std::size_t>(boxes[2]) +
           static_cast<std::size_t>(k);
  };
  std::vector<std::vector<int>> in_box(index(boxes[0] - 1, boxes[1] - 1, boxes[2] - 1) + 1);
  for (const int node : kept) {
    const auto [i, j, k] = box_of(samples[node].uvw);
    in_box[index(i, j, k)].push_back(node);
  }
  const int most = std::max({boxes[0], boxes[1], boxes[2]});

  std::vector<int> nearest(samples.size());
  parallel_for(static_cast<int>(samples.size()), [&](int n) {
    const Sample& sample = samples[n];
    const auto [i, j, k] = box_of(sample.uvw);
    double least = std::numeric_limits<double>::infinity();
    // Shells of boxes: points beyond shell r are farther than r edges.
    for (int r = 0; r <= most && least > (r - 1) * edge * std::max(0, r - 1) * edge; ++r)
      for (int a = std::max(0, i - r); a <= std::min(boxes[0] - 1, i + r); ++a)
        for (int b = std::max(0, j - r); b <= std::min(boxes[1] - 1, j + r); ++b)
          for (int c = std::max(0, k - r); c <= std::min(boxes[2] - 1, k + r); ++c) {
            if (std::max({std::abs(a - i), std::abs(b - j), std::abs(c - k)}) != r) continue;
            for (const int node : in_box[index(a, b, c)]) {
              const Sample& other = samples[node];
              const bool across =
                  sample.side != Side::both && other.side != Side::both && sample.side != other.side;
              const double distance = squared_norm(other.uvw - sample.uvw);
              if (!across && distance < least) least = distance, nearest[n] = node;
            }
          }
  });
  return nearest;
}

}  // namespace cleft
