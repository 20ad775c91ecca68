#include "explorer/body/edge_distances.h"

#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace cleft {

std::vector<double> edge_distances(const std::vector<Vec3>& points,
                                   const std::vector<std::array<int, 3>>& triangles,
                                   const std::vector<int>& from) {
  std::vector<std::vector<int>> around(points.size());
  for (const auto& t : triangles)
    for (int i = 0; i < 3; ++i)
      for (const int j : {1, 2}) around[t[i]].push_back(t[(i + j) % 3]);
  std::vector<double> distance(points.size(), std::numeric_limits<double>::infinity());
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (const int p : from)
    if (distance[p] > 0) distance[p] = 0, queue.emplace(0, p);
  while (!queue.empty()) {
    const auto [d, p] = queue.top();
    queue.pop();
    if (d > distance[p]) continue;
    for (const int q : around[p])
      if (const double next = d + norm(points[q] - points[p]); next < distance[q])
        distance[q] = next, queue.emplace(next, q);
  }
  return distance;
}

}  // namespace cleft
