#include "explorer/guard/guard_hold.h"

#include <algorithm>

namespace cleft {

namespace {

/// The part that a vertex keeps where that is reduced, and the least that is worth keeping.
constexpr double kept_at_once = 0.75, least_part = 0.05;
/// Each lowers what is not sound; more than this only where displacements are no numbers.
constexpr int most_rounds = 100;
/// The strain that reduced displacements add at most.
constexpr double most_strain = 0.25;

}  // namespace

GuardHold::GuardHold(const GuardSearch& search)
    : search_(search),
      linked_(search.vertex_.size()),
      held_(search.vertex_.size()),
      seen_(search.mesh_.triangles().size() + search.pairs_.size()) {
  const auto link = [this](int a, int b) {
    if (b < 0 || b == a) return;
    linked_[a].push_back(b), linked_[b].push_back(a);
  };
  for (std::size_t n = 0; n < linked_.size(); ++n) {
    link(static_cast<int>(n), search.leader_[n]);
    for (const GuardSearch::Part& p : search.tie_[n]) link(static_cast<int>(n), p.number);
  }
}

std::vector<int> GuardHold::hold(int one, const Passing& passing, Guard& guard) {
  passing_ = &passing, moments_ = &guard.moments();
  ++moment_, asked_.clear();
  std::vector<int> ones;
  if (!is_sound(one)) ones.push_back(one);
  for (int round = 0; round < most_rounds && !ones.empty(); ++round) {
    around_.clear(), ++round_;
    for (const int each : ones) add(each);
    for (const int each : ones) lower(each);
    spread();
    ones = around_;
    std::erase_if(ones, [this](int each) { return is_sound(each); });
  }
  around_.clear(), ++round_;
  for (const int n : asked_) {
    if (at(n).part == 1) continue;
    guard.hold(search_.vertex_[n], passing.cut,
               {passing.first, passing.last, at(n).part, std::min(passing.fade, passing.first),
                std::min(passing.fade, passing.end - passing.last)});
    add_around(n);
  }
  return around_;
}

/// Reduces the displacements of its corners, and of what these are tied to or joined with, until it is sound.
void GuardHold::lower(int one) {
  std::vector<int> lowered;
  for (const int v : search_.corners(one)) {
    const int n = search_.number_[v];
    if (n < 0) continue;
    lowered.push_back(n);
    lowered.insert(lowered.end(), linked_[n].begin(), linked_[n].end());
  }
  std::sort(lowered.begin(), lowered.end());
  lowered.erase(std::unique(lowered.begin(), lowered.end()), lowered.end());
  for (bool moves = true; moves && !is_sound(one);) {
    moves = false;
    for (const int n : lowered) {
      const double part = kept_at_once * at(n).least();
      moves = moves || part > 0;
      reduce(n, part < least_part ? 0 : part);
    }
  }
}

GuardHold::Held& GuardHold::at(int n) {
  Held& held = held_[n];
  if (held.moment == moment_) return held;
  const Vec3 own = passing_->displacement(search_.vertex_[n]);
  held = {moment_, own, norm(own), moments_->part(search_.vertex_[n], passing_->cut, passing_->s), 1};
  asked_.push_back(n);
  return held;
}

Vec3 GuardHold::now(int v) {
  const int n = search_.number_[v];
  if (n < 0) return {};
  const Held& held = at(n);
  return held.least() * held.own;
}

bool GuardHold::is_sound(int one) {
  const auto corner = search_.corners(one);
  if (one < 0) return !search_.is_passed(one, now(corner[0]), now(corner[1]));
  return search_.is_sound(one, {now(corner[0]), now(corner[1]), now(corner[2])});
}

void GuardHold::reduce(int n, double part) {
  at(n).part = part;
  queue_.emplace(-part, n);
  add_around(n);
}

void GuardHold::add_around(int n) {
  for (const int one : search_.around_[n]) add(one);
}

void GuardHold::add(int one) {
  const std::size_t place = one >= 0 ? static_cast<std::size_t>(one)
                                     : search_.mesh_.triangles().size() + static_cast<std::size_t>(-1 - one);
  if (std::exchange(seen_[place], round_) != round_) around_.push_back(one);
}

/// Neighbours follow. Those that are tied to each other or joined keep the same part: with another the middle
/// vertex of a sliver would leave its edge.
void GuardHold::spread() {
  while (!queue_.empty()) {
    const auto [negative, n] = queue_.top();
    queue_.pop();
    const Held from = at(n);
    if (-negative > from.part) continue;
    for (const auto& [next, length] : search_.next_[n]) {
      const double moves = std::max(from.length, at(next).length),
                   most = from.part + most_strain * length / moves;
      if (most < at(next).part) reduce(next, most);
    }
    for (const int other : linked_[n])
      if (from.part < at(other).part) reduce(other, from.part);
  }
}

}  // namespace cleft
