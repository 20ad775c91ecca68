// An array that grows without moving: readers on other threads may hold its elements.
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <string>

#include "base/error.h"

namespace cleft {

/// Memory for `capacity` elements is asked for once and touched as it is used. One thread grows it.
template <class T>
class SlotArray {
 public:
  explicit SlotArray(std::size_t capacity)
      : capacity_(capacity), memory_(std::allocator<T>().allocate(capacity)) {}
  ~SlotArray() {
    std::destroy_n(memory_, size_);
    std::allocator<T>().deallocate(memory_, capacity_);
  }
  SlotArray(const SlotArray&) = delete;
  SlotArray& operator=(const SlotArray&) = delete;

  std::size_t size() const { return size_; }
  T& operator[](std::size_t i) { return memory_[i]; }
  const T& operator[](std::size_t i) const { return memory_[i]; }
  void grow_to(std::size_t size) {
    if (size > capacity_)
      throw InputError("the cut mesh grew to " + std::to_string(size) +
                       " vertices or triangles, and there is room for " + std::to_string(capacity_) +
                       ": cut with longer edges near the path");
    for (; size_ < size; ++size_) new (memory_ + size_) T();
  }

 private:
  std::size_t capacity_, size_ = 0;
  T* memory_;
};

}  // namespace cleft
