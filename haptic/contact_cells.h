// A sparse uniform grid of voxels with the triangles that meet each of them: one thread changes it while
// others read, and nobody waits. Paper, section 3.6.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/vec3.h"
#include "haptic/triangle_geometry.h"

namespace cleft {

/// Numbers of triangles in one voxel. The writer changes it in place: a removed number becomes -1, a further
/// one takes such a place or the end.
struct CellList {
  std::atomic<std::int32_t> count{0};
  std::int32_t capacity = 0;
  std::atomic<std::int32_t>* ids = nullptr;
};

class ContactCells {
 public:
  static constexpr int bits = 3,
                       side = 1 << bits;  ///< blocks of 8 x 8 x 8 cells, made where there is surface

  /// Over the box from low to high; `cell` is the edge of a voxel.
  ContactCells(const Vec3& low, const Vec3& high, double cell);
  ~ContactCells();

  double cell() const { return cell_; }
  const Vec3& low() const { return low_; }
  int size(int axis) const { return blocks_[axis] << bits; }
  int index(double x, int axis) const {  ///< of the voxel, clamped to the grid
    const double i = (x - low_[axis]) * per_cell_;
    return i <= 0 ? 0 : i >= size(axis) ? size(axis) - 1 : static_cast<int>(i);
  }

  /// For readers: the triangles of a voxel, or none.
  const CellList* at(int i, int j, int k) const {
    const auto* block = top_[block_index(i, j, k)].load(std::memory_order_acquire);
    return block ? block->cell[inner_index(i, j, k)].load(std::memory_order_acquire) : nullptr;
  }
  /// Whether there is nothing in all of the voxel's block.
  bool empty_block(int i, int j, int k) const {
    return !top_[block_index(i, j, k)].load(std::memory_order_acquire);
  }

  /// Numbers, from 0, of the voxels that the triangle meets: appended to `out`.
  void voxels_of(const Corners& corners, std::vector<std::uint64_t>& out) const;

  // For the one writer.
  void add(std::uint64_t voxel, std::int32_t id);
  void remove(std::uint64_t voxel, std::int32_t id);
  /// Lists replaced since the last call are used again: no reader may still see them.
  void recycle();

 private:
  struct Block {
    std::atomic<CellList*> cell[side * side * side]{};
  };
  static std::size_t inner_index(int i, int j, int k) {
    constexpr int mask = side - 1;
    return static_cast<std::size_t>(((i & mask) << (2 * bits)) | ((j & mask) << bits) | (k & mask));
  }
  std::size_t block_index(int i, int j, int k) const {
    return (static_cast<std::size_t>(i >> bits) * blocks_[1] + (j >> bits)) * blocks_[2] + (k >> bits);
  }
  std::atomic<CellList*>& cell_at(std::uint64_t voxel);
  CellList* make_list(int capacity);

  Vec3 low_;
  double cell_, per_cell_, reach_;
  int blocks_[3];
  std::unique_ptr<std::atomic<Block*>[]> top_;
  std::vector<std::unique_ptr<Block>> owned_;
  std::vector<std::unique_ptr<CellList[]>> lists_;
  std::vector<std::unique_ptr<std::atomic<std::int32_t>[]>> chunks_;
  std::size_t lists_used_ = 0, chunk_used_ = 0, chunk_size_ = 0;
  std::vector<CellList*> free_[32], replaced_;  // by the logarithm of their capacity
};

}  // namespace cleft
