#include "explorer/guard/guard.h"

#include <algorithm>
#include <tuple>

namespace cleft {

void Guard::replace(int vertex, std::span<const Share> shares, double change) {
  const std::size_t first = shares_.size();
  shares_.insert(shares_.end(), shares.begin(), shares.end());
  rows_.push_back({vertex, shares.size() == 1 && shares[0].vertex == vertex, first, shares_.size()});
  changes_.push_back({vertex, change});
}

void Guard::sort() {
  std::sort(rows_.begin(), rows_.end(), [](const Row& a, const Row& b) {
    return std::tie(a.of_itself, a.vertex) < std::tie(b.of_itself, b.vertex);
  });
  for (const Row& row : rows_) vertices_.push_back(row.vertex);
  for (const Share& share : shares_) vertices_.push_back(share.vertex);
  moments_.sort();
  std::sort(vertices_.begin(), vertices_.end());
  vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
}

const Guard::Row* Guard::row_of(int vertex) const {
  for (const bool of_itself : {false, true}) {
    const auto row = std::partition_point(rows_.begin(), rows_.end(), [&](const Row& r) {
      return std::tie(r.of_itself, r.vertex) < std::tie(of_itself, vertex);
    });
    if (row != rows_.end() && row->vertex == vertex && row->of_itself == of_itself) return &*row;
  }
  return nullptr;
}

void Guard::forget(int vertex) {
  if (!std::binary_search(vertices_.begin(), vertices_.end(), vertex)) return;
  std::erase_if(rows_, [&](const Row& row) {
    return row.vertex == vertex ||
           std::any_of(shares_.begin() + static_cast<std::ptrdiff_t>(row.first),
                       shares_.begin() + static_cast<std::ptrdiff_t>(row.last),
                       [vertex](const Share& share) { return share.vertex == vertex; });
  });
}

void Guard::apply(std::size_t cut, double s, const Vec3* rest, Vec3* positions) const {
  for (const Row& row : rows_) {
    Vec3 sum;
    for (std::size_t i = row.first; i < row.last; ++i) {
      const auto [v, part] = shares_[i];
      sum += part * (positions[v] - rest[v]);
    }
    positions[row.vertex] = rest[row.vertex] + sum;
  }
  moments_.apply(cut, s, rest, positions);
}

}  // namespace cleft
