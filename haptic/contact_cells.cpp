#include "haptic/contact_cells.h"

#include <algorithm>
#include <bit>

#include "base/error.h"

namespace cleft {

namespace {
constexpr std::size_t words_together = 1 << 19, blocks_together = 500;  // 2 MB each
constexpr int first_words = 8;                                          // of a list: half a cache line
constexpr double most_blocks = 1 << 23;
constexpr std::size_t few = 4096;  // lists that a step replaces without taking memory
}  // namespace

ContactCells::ContactCells(const Vec3& low, const Vec3& high, double cell)
    : low_(low), cell_(cell), blocks_used_(blocks_together), words_used_(words_together) {
  const auto blocks = [&](int axis) { return std::floor((high[axis] - low[axis]) / (cell_ * side)) + 1; };
  while (blocks(0) * blocks(1) * blocks(2) > most_blocks) cell_ *= 1.25;
  for (int axis = 0; axis < 3; ++axis) blocks_[axis] = static_cast<int>(blocks(axis));
  per_cell_ = 1 / cell_;
  // Rounding where a query passes from voxel to voxel: triangles reach that much further.
  reach_ = cell_ / 2 + 1e-12 * (norm(low) + norm(high) + cell_);
  top_ = LargeArray<std::atomic<Block*>>(static_cast<std::size_t>(blocks_[0]) * blocks_[1] * blocks_[2]);
  replaced_.reserve(few);
  for (auto& free : free_) free.reserve(few);
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

void ContactCells::prepare() {
  if (!spare_blocks_) spare_blocks_ = LargeArray<Block>(blocks_together);
  if (!spare_lists_) spare_lists_ = LargeArray<Word>(words_together);
  blocks_taken_.reserve(blocks_taken_.size() + 1), lists_taken_.reserve(lists_taken_.size() + 1);
}

ContactCells::Block* ContactCells::make_block() {
  if (blocks_used_ == blocks_together) {
    if (!spare_blocks_) prepare();
    blocks_taken_.push_back(std::move(spare_blocks_));
    blocks_used_ = 0;
  }
  return &blocks_taken_.back()[blocks_used_++];
}

ContactCells::Block& ContactCells::block_of(std::uint64_t voxel) {
  std::atomic<Block*>& block = top_[voxel >> (3 * bits)];
  Block* there = block.load(std::memory_order_relaxed);
  if (!there) block.store(there = make_block(), std::memory_order_release);
  return *there;
}

ContactCells::Word* ContactCells::make_list(int words) {
  auto& free = free_[std::bit_width(static_cast<unsigned>(words))];
  Word* list = nullptr;
  if (!free.empty()) {
    list = free.back();
    free.pop_back();
  } else {
    constexpr std::size_t words_a_line = 64 / sizeof(Word);
    const auto size = static_cast<std::size_t>(words), whole = std::min(size, words_a_line);
    words_used_ = (words_used_ + whole - 1) / whole * whole;
    if (words_used_ + size > words_together) {
      CLEFT_CHECK(size, <=, words_together);
      if (!spare_lists_) prepare();
      lists_taken_.push_back(std::move(spare_lists_));
      words_used_ = 0;
    }
    list = lists_taken_.back().get() + words_used_;
    words_used_ += size;
  }
  list[0].store(0, std::memory_order_relaxed);
  list[1].store(words, std::memory_order_relaxed);
  return list;
}

void ContactCells::add(std::uint64_t voxel, std::int32_t id) {
  constexpr std::uint64_t inner_mask = (1u << (3 * bits)) - 1;
  constexpr int header = CellList::header;
  const std::uint64_t inner = voxel & inner_mask;
  Block& block = block_of(voxel);
  Word* list = block.cell[inner].load(std::memory_order_relaxed);
  const int count = list ? list[0].load(std::memory_order_relaxed) : 0;
  for (int n = header; n < header + count; ++n)
    if (list[n].load(std::memory_order_relaxed) < 0) return list[n].store(id, std::memory_order_release);
  const int words = list ? list[1].load(std::memory_order_relaxed) : 0;
  if (header + count < words) {
    list[header + count].store(id, std::memory_order_relaxed);
    list[0].store(count + 1, std::memory_order_release);
  } else {
    Word* larger = make_list(list ? 2 * words : first_words);
    for (int n = header; n < header + count; ++n)
      larger[n].store(list[n].load(std::memory_order_relaxed), std::memory_order_relaxed);
    larger[header + count].store(id, std::memory_order_relaxed);
    larger[0].store(count + 1, std::memory_order_relaxed);
    block.cell[inner].store(larger, std::memory_order_release);
    if (list) replaced_.push_back(list);
  }
  if (count > 0) return;
  std::atomic<std::uint64_t>& occupied = block.occupied[inner >> (2 * bits)];
  occupied.store(occupied.load(std::memory_order_relaxed) | std::uint64_t{1} << (inner & (side * side - 1)),
                 std::memory_order_release);
}

void ContactCells::remove(std::uint64_t voxel, std::int32_t id) {
  constexpr std::uint64_t inner_mask = (1u << (3 * bits)) - 1;
  const std::uint64_t inner = voxel & inner_mask;
  Block& block = block_of(voxel);
  Word* list = block.cell[inner].load(std::memory_order_relaxed);
  int count = list ? list[0].load(std::memory_order_relaxed) : 0;
  Word* ids = list + CellList::header;
  int n = 0;
  while (n < count && ids[n].load(std::memory_order_relaxed) != id) ++n;
  CLEFT_CHECK(n, <, count);
  ids[n].store(-1, std::memory_order_relaxed);
  while (count > 0 && ids[count - 1].load(std::memory_order_relaxed) < 0) --count;
  list[0].store(count, std::memory_order_release);
  if (count > 0) return;
  std::atomic<std::uint64_t>& occupied = block.occupied[inner >> (2 * bits)];
  occupied.store(
      occupied.load(std::memory_order_relaxed) & ~(std::uint64_t{1} << (inner & (side * side - 1))),
      std::memory_order_relaxed);
}

void ContactCells::recycle() {
  for (Word* list : replaced_)
    free_[std::bit_width(static_cast<unsigned>(list[1].load(std::memory_order_relaxed)))].push_back(list);
  replaced_.clear();
}

}  // namespace cleft
