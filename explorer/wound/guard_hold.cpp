// Displacements that are reduced for a moment, around triangles that are not sound while the blade passes.
#include <algorithm>
#include <queue>
#include <unordered_map>

#include "explorer/wound/guard_search.h"

namespace cleft {

namespace {

/// The part that a vertex keeps from one round to the next, and the least that is worth keeping.
constexpr double kept_a_round = 0.75, least_part = 0.05;
/// Of the parts of those that are tied: less is rounding.
constexpr double least_change = 1e-6;
/// Each lowers what offends; more than this only where displacements are no numbers.
constexpr int most_rounds = 100;
/// The strain that reduced displacements add at most.
constexpr double most_strain = 0.25;

struct Held {
  Vec3 own;         // its displacement
  double before;    // the part of it that other moments leave
  double part = 1;  // and this one, which rises from vertex to vertex whatever others do: they end elsewhere
  double least() const { return std::min(before, part); }
};

}  // namespace

std::vector<int> GuardSearch::hold_for_a_moment(std::vector<int> ones, const Passing& passing,
                                                Guard& guard) const {
  std::unordered_map<int, Held> held;
  const auto at = [&](int n) -> Held& {
    const auto [place, is_new] = held.try_emplace(n);
    if (is_new)
      place->second = {passing.displacement(vertex_[n]),
                       guard.moments().part(vertex_[n], passing.cut, passing.s)};
    return place->second;
  };
  const auto now = [&](int v) {
    if (number_[v] < 0) return Vec3{};
    const Held& h = at(number_[v]);
    return h.least() * h.own;
  };
  const auto is_sound_now = [&](int one) {
    const auto corner = corners(one);
    return one < 0 ? !is_passed(pairs_[-1 - one], now(corner[0]), now(corner[1]))
                   : is_sound(one, {now(corner[0]), now(corner[1]), now(corner[2])});
  };
  std::priority_queue<std::pair<double, int>> queue;  // the least part first
  std::vector<int> around;                            // those whose displacements have changed
  const auto reduce = [&](int n, double part) {
    at(n).part = part;
    queue.emplace(-part, n);
    around.insert(around.end(), around_[n].begin(), around_[n].end());
  };
  // Neighbours follow, and what these are tied to or joined with.
  const auto spread = [&] {
    while (!queue.empty()) {
      const auto [negative, n] = queue.top();
      queue.pop();
      const Held from = at(n);
      if (-negative > from.part) continue;
      for (const int next : next_[n]) {
        const double moves = std::max(norm(from.own), norm(at(next).own)),
                     length = norm(mesh_.position(vertex_[n]) - mesh_.position(vertex_[next])),
                     most = from.part + most_strain * length / moves;
        if (most < at(next).part) reduce(next, most);
      }
      if (leader_[n] >= 0 && from.part < at(leader_[n]).part) reduce(leader_[n], from.part);
      for (const Part& p : tie_[n])
        if (p.number >= 0 && from.part < at(p.number).part) reduce(p.number, from.part);
    }
  };
  // Those that are tied to others or joined with one stay so; neighbours of those that move less for it
  // follow.
  const auto keep_tied = [&] {
    std::vector<int> tied;
    for (const auto& [n, h] : held)
      if (leader_[n] >= 0 || !tie_[n].empty()) tied.push_back(n);
    for (const int n : tied) {
      double part = 0;
      if (leader_[n] >= 0)
        part = at(leader_[n]).part;
      else
        for (const Part& p : tie_[n]) part += p.part * (p.number < 0 ? 1 : at(p.number).part);
      if (part < at(n).part - least_change) reduce(n, part);
      if (part == at(n).part) continue;
      at(n).part = part;
      around.insert(around.end(), around_[n].begin(), around_[n].end());
    }
  };
  std::erase_if(ones, is_sound_now);
  for (int round = 0; round < most_rounds && !ones.empty(); ++round) {
    around.clear();
    std::vector<int> lowered;  // and what these are tied to or joined with
    for (const int one : ones)
      for (const int v : corners(one)) {
        const int n = number_[v];
        if (n < 0) continue;
        lowered.push_back(n);
        if (leader_[n] >= 0) lowered.push_back(leader_[n]);
        for (const Part& p : tie_[n])
          if (p.number >= 0) lowered.push_back(p.number);
      }
    std::sort(lowered.begin(), lowered.end());
    lowered.erase(std::unique(lowered.begin(), lowered.end()), lowered.end());
    for (const int n : lowered) {
      const double part = kept_a_round * at(n).least();
      reduce(n, part < least_part ? 0 : part);
    }
    do {
      spread();
      keep_tied();
    } while (!queue.empty());
    ones.insert(ones.end(), around.begin(), around.end());
    std::sort(ones.begin(), ones.end());
    ones.erase(std::unique(ones.begin(), ones.end()), ones.end());
    std::erase_if(ones, is_sound_now);
  }
  std::vector<int> touched;
  for (const auto& [n, h] : held) {
    if (h.part == 1) continue;
    guard.hold(vertex_[n], passing.cut,
               {passing.first, passing.last, h.part, std::min(passing.fade, passing.first),
                std::min(passing.fade, passing.end - passing.last)});
    touched.insert(touched.end(), around_[n].begin(), around_[n].end());
  }
  std::sort(touched.begin(), touched.end());
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  return touched;
}

}  // namespace cleft
