#include "explorer/wound/guard_moments.h"

#include <limits>

namespace cleft {

void GuardMoments::hold(int vertex, std::size_t cut, const Moment& moment) {
  if (of_cut_.size() <= cut) of_cut_.resize(cut + 1);
  of_cut_[cut][vertex].push_back(moment);
  ++count_;
}

double GuardMoments::least(std::span<const Moment> moments, double s) {
  double least = 1;
  for (const Moment& m : moments) {
    const double far = s < m.first ? (m.first - s) / m.before : s > m.last ? (s - m.last) / m.after : 0;
    if (far < 1) least = std::min(least, m.part + (1 - m.part) * far);
  }
  return least;
}

double GuardMoments::part(int vertex, std::size_t cut, double s) const {
  if (cut >= of_cut_.size()) return 1;
  const auto found = of_cut_[cut].find(vertex);
  return found == of_cut_[cut].end() ? 1 : least(found->second, s);
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
