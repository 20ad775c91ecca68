// A sparse uniform grid of voxels with the triangles that meet each of them: one thread changes it while
// others read, and no thread waits. Paper, section 3.6.
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "base/vec3.h"
#include "haptic/large_pages.h"
#include "haptic/triangle_geometry.h"

namespace cleft {

/// Numbers of triangles in one voxel, for readers: a cache line, half of one, or several. The writer changes
/// it in place: a removed number becomes -1, a further one takes such a place or the end.
class CellList {
 public:
  static constexpr int header = 2;  ///< words before the numbers: their count, and the number of words

  CellList() = default;
  explicit CellList(const std::atomic<std::int32_t>* words) : words_(words) {}
  explicit operator bool() const { return words_; }
  int count() const { return words_[0].load(std::memory_order_acquire); }
  int operator[](int n) const { return words_[header + n].load(std::memory_order_acquire); }
  friend bool operator==(const CellList&, const CellList&) = default;

 private:
  const std::atomic<std::int32_t>* words_ = nullptr;
};

class ContactCells {
 public:
  static constexpr int bits = 3,
                       side = 1 << bits;  ///< blocks of 8 x 8 x 8 cells, which exist where there is surface

  /// A grid over the box from low to high, mm; `cell` is the edge of a voxel, mm.
  ContactCells(const Vec3& low, const Vec3& high, double cell);
  ~ContactCells();

  double cell() const { return cell_; }
  const Vec3& low() const { return low_; }
  int size(int axis) const { return blocks_[axis] << bits; }
  int index(double x, int axis) const {  ///< of the voxel, clamped to the grid
    const double i = (x - low_[axis]) * per_cell_;
    return i <= 0 ? 0 : i >= size(axis) ? size(axis) - 1 : static_cast<int>(i);
  }

  /// 8 x 8 x 8 voxels. Bit 8 j + k of occupied[i] is set if voxel (i, j, k) contains triangles.
  struct alignas(64) Block {
    std::atomic<std::uint64_t> occupied[side]{};
    std::atomic<std::atomic<std::int32_t>*> cell[side * side * side]{};
    CellList at(int i, int j, int k) const {
      return CellList(cell[inner_index(i, j, k)].load(std::memory_order_acquire));
    }
  };

  /// For readers: the triangles of a voxel, or none.
  CellList at(int i, int j, int k) const {
    const Block* block = block_at(i >> bits, j >> bits, k >> bits);
    return block ? block->at(i, j, k) : CellList();
  }
  /// A block, or null if it is empty.
  const Block* block_at(int i, int j, int k) const {
    return top_[(static_cast<std::size_t>(i) * blocks_[1] + j) * blocks_[2] + k].load(
        std::memory_order_acquire);
  }

  /// Numbers, from 0, of the voxels that the triangle meets: appended to `out`.
  void voxels_of(const Corners& corners, std::vector<std::uint64_t>& out) const;

  // For the writer only.
  void add(std::uint64_t voxel, std::int32_t id);
  void remove(std::uint64_t voxel, std::int32_t id);
  /// Reuses lists that were replaced before the last call: no reader may still use them.
  void recycle();
  /// Allocates and touches memory for the next steps in advance.
  void prepare();

 private:
  using Word = std::atomic<std::int32_t>;
  static std::size_t inner_index(int i, int j, int k) {
    constexpr int mask = side - 1;
    return static_cast<std::size_t>(((i & mask) << (2 * bits)) | ((j & mask) << bits) | (k & mask));
  }
  std::size_t block_index(int i, int j, int k) const {
    return (static_cast<std::size_t>(i >> bits) * blocks_[1] + (j >> bits)) * blocks_[2] + (k >> bits);
  }
  Block* make_block();
  Block& block_of(std::uint64_t voxel);
  Word* make_list(int words);

  Vec3 low_;
  double cell_, per_cell_, reach_;
  int blocks_[3];
  LargeArray<std::atomic<Block*>> top_;
  std::vector<LargeArray<Block>> blocks_taken_;
  std::vector<LargeArray<Word>> lists_taken_;
  LargeArray<Block> spare_blocks_;
  LargeArray<Word> spare_lists_;
  std::size_t blocks_used_, words_used_;    // of the last ones taken
  std::vector<Word*> free_[32], replaced_;  // free ones by the logarithm of their size
};

}  // namespace cleft
