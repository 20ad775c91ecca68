#include "haptic/contact_cells.h"

#include <bit>

#include "base/error.h"

namespace cleft {

namespace {
constexpr std::size_t lists_a_chunk = 4096, ids_a_chunk = 65536;
constexpr double most_blocks = 1 << 23;
}  // namespace

ContactCells::ContactCells(const Vec3& low, const Vec3& high, double cell) : low_(low), cell_(cell) {
  const auto blocks = [&](int axis) { return std::floor((high[axis] - low[axis]) / (cell_ * side)) + 1; };
  while (blocks(0) * blocks(1) * blocks(2) > most_blocks) cell_ *= 1.25;
  for (int axis = 0; axis < 3; ++axis) blocks_[axis] = static_cast<int>(blocks(axis));
  per_cell_ = 1 / cell_;
  // Rounding where a query passes from voxel to voxel: triangles reach that much further.
  reach_ = cell_ / 2 + 1e-12 * (norm(low) + norm(high) + cell_);
  top_ =
      std::make_unique<std::atomic<Block*>[]>(static_cast<std::size_t>(blocks_[0]) * blocks_[1] * blocks_[2]);
}

ContactCells::~ContactCells() = default;

void ContactCells::voxels_of(const Corners& c, std::vector<std::uint64_t>& out) const {
  int first[3], last[3];
  const double slack = reach_ - cell_ / 2;
  for (int axis = 0; axis < 3; ++axis) {
    first[axis] = index(std::min({c[0][axis], c[1][axis], c[2][axis]}) - slack, axis);
    last[axis] = index(std::max({c[0][axis], c[1][axis], c[2][axis]}) + slack, axis);
  }
  const bool single = first[0] == last[0] && first[1] == last[1] && first[2] == last[2];
  const Vec3 normal = scaled_normal(c);
  for (int i = first[0]; i <= last[0]; ++i)
    for (int j = first[1]; j <= last[1]; ++j)
      for (int k = first[2]; k <= last[2]; ++k) {
        const Vec3 middle = low_ + cell_ * Vec3{i + 0.5, j + 0.5, k + 0.5};
        if (single || plane_meets_box(c, normal, middle, reach_))
          out.push_back(static_cast<std::uint64_t>(block_index(i, j, k)) << (3 * bits) |
                        inner_index(i, j, k));
      }
}

std::atomic<CellList*>& ContactCells::cell_at(std::uint64_t voxel) {
  std::atomic<Block*>& block = top_[voxel >> (3 * bits)];
  if (!block.load(std::memory_order_relaxed)) {
    owned_.push_back(std::make_unique<Block>());
    block.store(owned_.back().get(), std::memory_order_release);
  }
  return block.load(std::memory_order_relaxed)->cell[voxel & ((1u << (3 * bits)) - 1)];
}

CellList* ContactCells::make_list(int capacity) {
  auto& free = free_[std::bit_width(static_cast<unsigned>(capacity))];
  if (!free.empty()) {
    CellList* list = free.back();
    free.pop_back();
    list->count.store(0, std::memory_order_relaxed);
    return list;
  }
  if (lists_.empty() || lists_used_ == lists_a_chunk) {
    lists_.push_back(std::make_unique<CellList[]>(lists_a_chunk));
    lists_used_ = 0;
  }
  if (chunk_used_ + static_cast<std::size_t>(capacity) > chunk_size_) {
    chunk_size_ = std::max(ids_a_chunk, static_cast<std::size_t>(capacity));
    chunks_.push_back(std::make_unique<std::atomic<std::int32_t>[]>(chunk_size_));
    chunk_used_ = 0;
  }
  CellList* list = &lists_.back()[lists_used_++];
  list->capacity = capacity;
  list->ids = chunks_.back().get() + chunk_used_;
  chunk_used_ += static_cast<std::size_t>(capacity);
  return list;
}

void ContactCells::add(std::uint64_t voxel, std::int32_t id) {
  std::atomic<CellList*>& cell = cell_at(voxel);
  CellList* list = cell.load(std::memory_order_relaxed);
  const int count = list ? list->count.load(std::memory_order_relaxed) : 0;
  for (int n = 0; n < count; ++n)
    if (list->ids[n].load(std::memory_order_relaxed) < 0)
      return list->ids[n].store(id, std::memory_order_release);
  if (!list || count == list->capacity) {
    CellList* larger = make_list(list ? 2 * list->capacity : 8);
    for (int n = 0; n < count; ++n)
      larger->ids[n].store(list->ids[n].load(std::memory_order_relaxed), std::memory_order_relaxed);
    larger->ids[count].store(id, std::memory_order_relaxed);
    larger->count.store(count + 1, std::memory_order_relaxed);
    cell.store(larger, std::memory_order_release);
    if (list) replaced_.push_back(list);
    return;
  }
  list->ids[count].store(id, std::memory_order_relaxed);
  list->count.store(count + 1, std::memory_order_release);
}

void ContactCells::remove(std::uint64_t voxel, std::int32_t id) {
  CellList* list = cell_at(voxel).load(std::memory_order_relaxed);
  const int count = list ? list->count.load(std::memory_order_relaxed) : 0;
  for (int n = 0; n < count; ++n)
    if (list->ids[n].load(std::memory_order_relaxed) == id)
      return list->ids[n].store(-1, std::memory_order_relaxed);
  CLEFT_CHECK(id, ==, -1);  // it was not there
}

void ContactCells::recycle() {
  for (CellList* list : replaced_)
    free_[std::bit_width(static_cast<unsigned>(list->capacity))].push_back(list);
  replaced_.clear();
}

}  // namespace cleft
