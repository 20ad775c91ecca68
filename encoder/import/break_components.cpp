#include "encoder/import/break_components.h"

#include <algorithm>
#include <limits>
#include <map>
#include <set>

namespace cleft {

namespace {

using GroupPair = std::array<std::size_t, 2>;

class Components {
 public:
  Components(const SourceMesh& mesh, const Groups& groups, const Partings& partings, std::int32_t frames)
      : mesh_(mesh), groups_(groups), group_of_(mesh.points.size(), none) {
    for (std::size_t g = 0; g < groups.size(); ++g)
      for (const std::int32_t node : groups[g]) group_of_[node] = static_cast<std::int32_t>(g);
    count_parts(partings, frames);
    join_neighbours();
  }

  std::vector<BreakComponent> found() {
    std::map<std::int32_t, BreakComponent> by_root;
    for (std::size_t g = 0; g < groups_.size(); ++g)
      if (parts_[g] == 2) by_root[sets_.root(static_cast<std::int32_t>(g))].groups.push_back(g);
    for (auto& [root, component] : by_root) {
      std::set<std::size_t> ends;
      for (const std::size_t g : component.groups)
        for (const std::size_t other : beside_[g])
          if (parts_[other] > 2) ends.insert(other);
      component.junctions.assign(ends.begin(), ends.end());
      component.groups.insert(component.groups.end(), ends.begin(), ends.end());
      std::sort(component.groups.begin(), component.groups.end());
    }
    std::vector<BreakComponent> list;
    for (auto& [root, component] : by_root) list.push_back(std::move(component));
    return with_islands_joined(std::move(list));
  }

 private:
  static constexpr std::int32_t none = -1;

  /// The parts of the body that meet at a group, and for each node the number of its part there.
  void count_parts(const Partings& partings, std::int32_t frames) {
    Sets same(mesh_.points.size());
    for (std::size_t p = 0; p < partings.pairs.size(); ++p)
      if (partings.first_frame[p] >= frames) same.join(partings.pairs[p][0], partings.pairs[p][1]);
    part_of_.assign(mesh_.points.size(), 0);
    for (const auto& group : groups_) {
      std::set<std::int32_t> roots;
      for (const std::int32_t node : group) roots.insert(part_of_[node] = same.root(node));
      parts_.push_back(roots.size());
    }
  }

  void join_neighbours() {
    std::map<GroupPair, std::array<std::int32_t, 2>> first_side;  // the sides of both groups in a cell
    std::set<GroupPair> seams, neighbours;
    for (std::size_t c = 0; c < mesh_.cell_types.size(); ++c) {
      std::vector<std::int64_t> nodes;
      for (auto i = mesh_.cell_offsets[c]; i < mesh_.cell_offsets[c + 1]; ++i)
        if (group_of_[mesh_.connectivity[i]] != none) nodes.push_back(mesh_.connectivity[i]);
      for (const std::int64_t a : nodes)
        for (const std::int64_t b : nodes) {
          const GroupPair pair{static_cast<std::size_t>(group_of_[a]),
                               static_cast<std::size_t>(group_of_[b])};
          if (pair[0] >= pair[1]) continue;
          const bool seam = parts_[pair[0]] < 2 || parts_[pair[1]] < 2;
          const auto side = [&](std::int64_t n) { return seam ? static_cast<std::int32_t>(n) : part_of_[n]; };
          const std::array<std::int32_t, 2> sides{side(a), side(b)};
          const auto [at, is_new] = first_side.try_emplace(pair, sides);
          if (!is_new && at->second[0] != sides[0] && at->second[1] != sides[1])
            (seam ? seams : neighbours).insert(pair);
        }
    }
    beside_.resize(groups_.size());
    for (const auto& [a, b] : neighbours) {
      beside_[a].push_back(b), beside_[b].push_back(a);
      if (parts_[a] == 2 && parts_[b] == 2)
        sets_.join(static_cast<std::int32_t>(a), static_cast<std::int32_t>(b));
    }
    // A single closed place between two that part.
    std::map<std::size_t, std::size_t> first_beside;
    for (const auto& [a, b] : seams)
      for (const auto& [closed, open] : {GroupPair{a, b}, GroupPair{b, a}})
        if (parts_[closed] == 1 && parts_[open] == 2) {
          const auto [at, is_new] = first_beside.try_emplace(closed, open);
          if (!is_new) sets_.join(static_cast<std::int32_t>(at->second), static_cast<std::int32_t>(open));
        }
  }

  Vec3 place_of(std::size_t group) const { return mesh_.points[groups_[group].front()]; }

  std::vector<BreakComponent> with_islands_joined(std::vector<BreakComponent> list) const {
    constexpr std::size_t fewest = 3;
    const auto is_island = [&](const BreakComponent& one) { return one.groups.size() < fewest; };
    if (std::all_of(list.begin(), list.end(), is_island)) return list;
    std::vector<BreakComponent> large;
    for (const BreakComponent& one : list)
      if (!is_island(one)) large.push_back(one);
    for (const BreakComponent& one : list) {
      if (!is_island(one)) continue;
      std::size_t nearest = 0;
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < large.size(); ++i)
        for (const std::size_t g : large[i].groups)
          if (const double off = norm(place_of(g) - place_of(one.groups.front())); off < least)
            least = off, nearest = i;
      auto& groups = large[nearest].groups;
      groups.insert(groups.end(), one.groups.begin(), one.groups.end());
      std::sort(groups.begin(), groups.end());
      groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
    }
    return large;
  }

  const SourceMesh& mesh_;
  const Groups& groups_;
  std::vector<std::int32_t> group_of_, part_of_;
  std::vector<std::size_t> parts_;  // of each group: parts of the body that meet there; 1: a seam
  std::vector<std::vector<std::size_t>> beside_;
  Sets sets_{groups_.size()};
};

}  // namespace

std::vector<BreakComponent> break_components(const SourceMesh& mesh, const Groups& groups,
                                             const Partings& partings, std::int32_t frames) {
  return Components(mesh, groups, partings, frames).found();
}

}  // namespace cleft
