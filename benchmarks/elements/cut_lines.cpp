#include "benchmarks/elements/cut_lines.h"

#include <algorithm>
#include <cmath>

namespace cleft::elements {

namespace {

/// Continues the lines to `to` by the fewest elements that are at most `step` long at first.
void add_growing(std::vector<double>& lines, double to, double step, double growth) {
  const double from = lines.back();
  std::vector<double> sums = {0};
  do sums.push_back(sums.back() * growth + 1);
  while (sums.back() < std::abs(to - from) / step - 1e-9);
  for (std::size_t k = 1; k < sums.size(); ++k) lines.push_back(from + (to - from) * sums[k] / sums.back());
}

/// Lengths of `count` elements, of which the first and last (or the last alone) are `ratio` times shorter
/// than their neighbours, and so on; as long in sum as `length` and the given part of each outermost one.
std::vector<double> lengths(int count, double ratio, bool both, double length, double part) {
  std::vector<double> found(count);
  double sum = 0;
  for (int k = 0; k < count; ++k) {
    const int from_end = both ? std::min(k, count - 1 - k) : count - 1 - k;
    sum += found[k] = std::pow(ratio, from_end);
  }
  const double scale = length / (sum - part * (found.back() + (both ? found.front() : 0)));
  for (double& one : found) one *= scale;
  return found;
}

}  // namespace

CutLines cut_lines(const Parameters& p, const Division& d) {
  CutLines lines;
  const auto along = lengths(d.along, d.towards_fronts, true, p.cut.length, d.end);
  const auto down = lengths(d.down, d.towards_fronts, false, p.cut.depth, d.bottom);
  std::vector<double> outer = {p.cut.length / 2 + d.end * along.back()};
  add_growing(outer, p.patch.length / 2, along.back(), d.growth);
  for (std::size_t k = outer.size(); k-- > 1;) lines.u.push_back(-outer[k]);
  lines.first = static_cast<int>(lines.u.size());
  lines.u.push_back(-outer[0]);
  for (int k = 0; k + 1 < d.along; ++k) lines.u.push_back(lines.u.back() + along[k]);
  lines.last = static_cast<int>(lines.u.size());
  lines.u.insert(lines.u.end(), outer.begin(), outer.end());

  std::vector<double> across = {0};
  add_growing(across, p.patch.width / 2, along.back(), d.growth);
  for (std::size_t k = across.size(); k-- > 1;) lines.v.push_back(-across[k]);
  lines.plane = static_cast<int>(lines.v.size());
  lines.v.insert(lines.v.end(), across.begin(), across.end());

  lines.w = {0};
  for (int k = 0; k < d.down; ++k) lines.w.push_back(lines.w.back() - down[k]);
  lines.bottom = d.down;
  add_growing(lines.w, -p.patch.height, down.back(), d.growth);
  return lines;
}

}  // namespace cleft::elements
