#include "tradeoff/replays/uncut_skin.h"

#include <map>

namespace cleft {

UncutSkin uncut_skin(const Snapshot& s) {
  std::map<int, int> left_of, vertex_of;
  for (const auto& [left, right] : s.pairs) left_of[right] = left;
  UncutSkin skin;
  for (const auto& triangle : s.skin()) {
    std::array<int, 3> corners;
    for (int c = 0; c < 3; ++c) {
      int node = triangle[c];
      while (left_of.contains(node)) node = left_of[node];
      const auto [vertex, fresh] = vertex_of.insert({node, static_cast<int>(skin.mesh.points.size())});
      if (fresh) {
        skin.mesh.points.push_back(s.points[node]);
        skin.node_of.push_back(node);
      }
      corners[c] = vertex->second;
    }
    skin.mesh.triangles.push_back(corners);
  }
  return skin;
}

}  // namespace cleft
