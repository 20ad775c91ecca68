// Displacements that are reduced for good, where triangles or lips are not sound.
#include <algorithm>
#include <array>
#include <limits>
#include <queue>

#include "explorer/guard/guard_search.h"

namespace cleft {

namespace {

/// The part of its displacement that a vertex keeps from one round to the next, the least part that is worth
/// keeping, and rounds.
constexpr double kept_a_round = 0.75, least_factor = 0.05;
constexpr int rounds = 60, last_rounds = 6;
/// The strain that reduced displacements add at most. With little, lips are held back far beyond a triangle
/// next to the end of a cut; with much, what is next to such triangles may have to be reduced as well.
constexpr std::array strains{1., 0.5, 0.25};

}  // namespace

/// Displacements are reduced where triangles offend, until none does: with the strain with which that takes
/// least.
void GuardSearch::reduce() {
  if (offending_.empty()) return;
  largest_.assign(vertex_.size(), 0);
  for (std::size_t n = 0; n < vertex_.size(); ++n)
    for (std::size_t k = 0; k < times(); ++k)
      largest_[n] = std::max(largest_[n], norm(with(static_cast<int>(n), k)));
  const std::vector<double> begin = factor_;
  const std::vector<int> offended = offending_, all = all_numbers();
  std::vector<double> best;
  double least = std::numeric_limits<double>::infinity();
  for (const double strain : strains) {
    factor_ = begin, offending_ = offended;
    renew(all);
    reduce(strain);
    if (const double taken = taken_for_good(); !(taken >= least)) best = factor_, least = taken;
  }
  factor_ = best, offending_.clear();
  renew(all);
  check_all();
}

/// The same with at most this strain.
void GuardSearch::reduce(double strain) {
  for (int round = 0; round < rounds && !offending_.empty(); ++round) {
    std::vector<int> reduced;
    for (const int one : offending_)
      for (const int v : corners(one))
        if (number_[v] >= 0) reduced.push_back(number_[v]);
    std::sort(reduced.begin(), reduced.end());
    reduced.erase(std::unique(reduced.begin(), reduced.end()), reduced.end());
    for (const int n : reduced)
      factor_[n] = factor_[n] * kept_a_round < least_factor ? 0 : factor_[n] * kept_a_round;
    const std::vector<int> changed = even_out(std::move(reduced), strain);
    renew(changed);
    check(changed);
    for (const int n : changed) doubtful_.insert(doubtful_.end(), around_[n].begin(), around_[n].end());
  }
  const std::vector<int> all = all_numbers();
  for (int round = 1; round <= last_rounds && !offending_.empty(); ++round) {
    for (double& factor : factor_) factor *= round < last_rounds ? 0.5 : 0;
    renew(all);
    check(all);
  }
}

/// What it takes of displacements with the cuts complete: the sum of squares, mesh units.
double GuardSearch::taken_for_good() const {
  double sum = 0;
  for (std::size_t n = 0; n < vertex_.size(); ++n)
    for (std::size_t k = 0; k < times(); ++k)
      if (lasting_[k]) sum += squared_norm(with_[n * times() + k] - own_[n * times() + k]);
  return sum;
}

/// From those that were reduced on, so that displacements change by little from vertex to vertex. Returns
/// all that have changed.
std::vector<int> GuardSearch::even_out(std::vector<int> reduced, double strain) {
  std::priority_queue<std::pair<double, int>> queue;  // the least factor first
  for (const int n : reduced) queue.emplace(-factor_[n], n);
  while (!queue.empty()) {
    const auto [negative, n] = queue.top();
    queue.pop();
    if (-negative > factor_[n]) continue;
    for (const auto& [next, length] : next_[n]) {
      const double moves = std::max(largest_[n], largest_[next]), most = factor_[n] + strain * length / moves;
      if (!(most < factor_[next])) continue;
      factor_[next] = most;
      reduced.push_back(next);
      queue.emplace(-most, next);
    }
  }
  std::sort(reduced.begin(), reduced.end());
  reduced.erase(std::unique(reduced.begin(), reduced.end()), reduced.end());
  return reduced;
}

}  // namespace cleft
