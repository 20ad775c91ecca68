#include "encoder/front_centres.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace cleft {

FrontCentres::FrontCentres(const CellCentres& centres, const std::vector<Sample>& samples,
                           const std::vector<std::array<std::int32_t, 2>>& pairs) {
  std::unordered_map<std::int64_t, Eigen::Index> opposite;
  for (const auto& [left, right] : pairs) opposite[left] = right, opposite[right] = left;
  for (std::size_t c = 0; c < centres.samples.size(); ++c) {
    const std::size_t first = centres.first[c], end = centres.first[c + 1];
    const auto u = [&](std::size_t k) { return samples[centres.nodes[k]].uvw.x; };
    Cell cell{static_cast<Eigen::Index>(c),
              centres.samples[c].uvw.x,
              u(first),
              u(first),
              1 / static_cast<double>(end - first),
              {}};
    for (std::size_t k = first; k < end; ++k)
      cell.back = std::min(cell.back, u(k)), cell.front = std::max(cell.front, u(k));
    for (std::size_t k = first; k < end; ++k)
      if (const auto other = opposite.find(centres.nodes[k]); other != opposite.end())
        if (u(k) == cell.back || u(k) == cell.front)
          cell.lips.push_back({other->first, other->second, u(k) == cell.front});
    if (!cell.lips.empty()) cells_.push_back(std::move(cell));
  }
}

void FrontCentres::correct(Eigen::MatrixX3d& means, const Eigen::Ref<const Eigen::MatrixX3d>& d,
                           const std::array<double, 2>& fronts) const {
  const auto [start, tip] = fronts;
  for (const Cell& cell : cells_) {
    const bool begins = cell.back < start && start < cell.front, ends = cell.back < tip && tip < cell.front;
    if (begins == ends) continue;
    const double closed = begins ? cell.back : cell.front, open = begins ? cell.front : cell.back,
                 front = begins ? start : tip;
    const double linear = (cell.u - closed) / (open - closed),
                 root = std::sqrt(std::max(0., (cell.u - front) / (open - front)));
    for (const Lip& lip : cell.lips)
      if (lip.in_front == begins)
        means.row(cell.number) +=
            (root / linear - 1) * cell.share / 2 * (d.row(lip.node) - d.row(lip.opposite));
  }
}

}  // namespace cleft
