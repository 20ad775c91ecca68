#include "explorer/guard/guard_moments.h"

#include <limits>

namespace cleft {

void GuardMoments::hold(int vertex, std::size_t cut, const Moment& moment) {
  if (of_cut_.size() <= cut) of_cut_.resize(cut + 1);
  std::vector<Moment>& all = of_cut_[cut][vertex];
  if (std::any_of(all.begin(), all.end(), [&](const Moment& m) { return m.covers(moment); })) return;
  count_ -= std::erase_if(all, [&](const Moment& m) { return moment.covers(m); });
  all.push_back(moment);
  ++count_;
}

double GuardMoments::Moment::at(double s) const {
  const double far = s < first ? (first - s) / before : s > last ? (s - last) / after : 0;
  return far < 1 ? part + (1 - part) * far : 1;
}

/// Both are linear between the places at which either turns.
bool GuardMoments::Moment::covers(const Moment& other) const {
  if (part > other.part || first - before > other.first - other.before ||
      last + after < other.last + other.after)
    return false;
  for (const double s : {first, last, other.first, other.last})
    if (at(s) > other.at(s)) return false;
  return true;
}

double GuardMoments::least(std::span<const Moment> moments, double s) {
  double least = 1;
  for (const Moment& m : moments) least = std::min(least, m.at(s));
  return least;
}

double GuardMoments::part(int vertex, std::size_t cut, double s) const {
  if (cut >= of_cut_.size()) return 1;
  const auto found = of_cut_[cut].find(vertex);
  return found == of_cut_[cut].end() ? 1 : least(found->second, s);
}

void GuardMoments::add_turns(int vertex, std::size_t cut, std::vector<double>& turns) const {
  if (cut >= of_cut_.size()) return;
  const auto found = of_cut_[cut].find(vertex);
  if (found == of_cut_[cut].end()) return;
  for (const Moment& m : found->second)
    turns.insert(turns.end(), {m.first - m.before, m.first, m.last, m.last + m.after});
}

void GuardMoments::sort() {
  held_.assign(of_cut_.size(), {});
  moments_.clear();
  for (std::size_t cut = 0; cut < of_cut_.size(); ++cut) {
    for (const auto& [vertex, moments] : of_cut_[cut]) {
      Held held{std::numeric_limits<double>::infinity(), 0, vertex, moments_.size(), moments.size()};
      for (const Moment& m : moments) {
        held.first = std::min(held.first, m.first - m.before);
        held.last = std::max(held.last, m.last + m.after);
      }
      held_[cut].push_back(held);
      moments_.insert(moments_.end(), moments.begin(), moments.end());
    }
    std::sort(held_[cut].begin(), held_[cut].end(),
              [](const Held& a, const Held& b) { return a.first < b.first; });
  }
}

std::vector<int> GuardMoments::vertices() const {
  std::vector<int> all;
  for (const auto& of_vertex : of_cut_)
    for (const auto& [vertex, moments] : of_vertex) all.push_back(vertex);
  return all;
}

void GuardMoments::apply(std::size_t cut, double s, const Vec3* rest, Vec3* positions) const {
  if (cut >= held_.size()) return;
  for (const Held& held : held_[cut]) {
    if (held.first > s) break;
    if (held.last < s) continue;
    const std::size_t v = static_cast<std::size_t>(held.vertex);
    const double part = least({&moments_[held.begin], held.count}, s);
    if (part < 1) positions[v] = rest[v] + part * (positions[v] - rest[v]);
  }
}

}  // namespace cleft
