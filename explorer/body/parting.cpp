#include "explorer/body/parting.h"

#include <algorithm>
#include <utility>

#include "base/error.h"

namespace cleft {

Parting::Parting(const SurfaceMesh& mesh, int layers, std::function<int(int, int)> node,
                 std::function<int(int, int)> copy)
    : mesh_(mesh),
      layers_(layers),
      node_(std::move(node)),
      copy_(std::move(copy)),
      around_(mesh.points.size()) {
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t)
    for (const int p : mesh.triangles[t]) around_[p].push_back(t);
}

Parting::Fan& Parting::fan_of(int point) {
  if (const auto known = fans_.find(point); known != fans_.end()) return known->second;
  std::map<int, int> by_first;  // the triangle whose clockwise edge leads to a neighbour
  std::map<int, int> second_of;
  std::set<int> seconds;
  for (const int t : around_[point]) {
    const auto& c = mesh_.triangles[t];
    const int i = static_cast<int>(std::find(c.begin(), c.end(), point) - c.begin());
    by_first[c[(i + 1) % 3]] = t;
    second_of[t] = c[(i + 2) % 3];
    seconds.insert(c[(i + 2) % 3]);
  }
  Fan fan;
  int first = by_first.begin()->first;
  for (const auto& [neighbor, t] : by_first)
    if (!seconds.contains(neighbor)) first = neighbor, fan.closed = false;
  for (int at = first; by_first.contains(at) && fan.triangles.size() < by_first.size();
       at = second_of[by_first[at]]) {
    fan.triangles.push_back(by_first[at]);
    fan.ahead.push_back(at);
  }
  CLEFT_CHECK(fan.triangles.size(), ==, around_[point].size());
  fan.opened.resize(layers_);
  for (int k = 0; k < layers_; ++k) fan.copies.emplace_back(fan.triangles.size(), node_(point, k));
  return fans_.emplace(point, std::move(fan)).first->second;
}

std::vector<Parting::Pair> Parting::open(const Visit& visit) {
  Fan& fan = fan_of(visit.point);
  const int count = static_cast<int>(fan.triangles.size());
  // The triangles at the left of the cut, where v < 0, next to its edges.
  const auto is_left = [&](int i) {
    const int clockwise = fan.ahead[i], counter = i + 1 < count ? fan.ahead[i + 1]
                                                  : fan.closed  ? fan.ahead[0]
                                                                : -2;
    return counter == visit.to || clockwise == visit.from;
  };
  std::vector<Pair> pairs;
  std::map<std::pair<int, int>, int> above;  // part and its former node of the skin: its node now
  for (int k = 0; k < std::min(visit.layers, layers_); ++k) {
    for (const int end : {visit.from, visit.to})
      if (end >= 0) fan.opened[k].insert(end);
    // Parts of the fan between opened edges.
    std::vector<int> part(count, 0);
    int parts = 0;
    for (int i = 0; i < count; ++i) {
      if (i == 0 || fan.opened[k].contains(fan.ahead[i])) ++parts;
      part[i] = parts - 1;
    }
    if (fan.closed && parts > 1 && !fan.opened[k].contains(fan.ahead[0]))
      for (int& number : part)
        if (number == parts - 1) number = 0;
    // Parts that had one node: the left one keeps it.
    std::map<int, std::vector<int>> of_node;
    for (int i = 0; i < count; ++i) {
      auto& list = of_node[fan.copies[k][i]];
      if (std::find(list.begin(), list.end(), part[i]) == list.end()) list.push_back(part[i]);
    }
    for (auto& [node, list] : of_node) {
      if (list.size() < 2) continue;
      const auto left = [&](int number) {
        for (int i = 0; i < count; ++i)
          if (part[i] == number && fan.copies[k][i] == node && is_left(i)) return true;
        return false;
      };
      std::stable_partition(list.begin(), list.end(), left);
      const bool reversed = !left(list.front());
      for (std::size_t n = 1; n < list.size(); ++n) {
        int skin = -1;
        if (k > 0)
          for (int i = 0; i < count; ++i)
            if (part[i] == list[n] && fan.copies[k][i] == node) skin = fan.copies[0][i];
        const int copy = copy_(node, skin);
        for (int i = 0; i < count; ++i)
          if (part[i] == list[n] && fan.copies[k][i] == node) fan.copies[k][i] = copy;
        pairs.push_back({node, copy, k, reversed});
      }
    }
  }
  return pairs;
}

int Parting::node(int triangle, int corner, int layer) const {
  const int point = mesh_.triangles[triangle][corner];
  const auto fan = fans_.find(point);
  if (fan == fans_.end()) return node_(point, layer);
  const auto at = std::find(fan->second.triangles.begin(), fan->second.triangles.end(), triangle);
  return fan->second.copies[layer][at - fan->second.triangles.begin()];
}

}  // namespace cleft
