// An array that grows without moving: readers on other threads may hold its elements.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <new>
#include <string>

#include "base/error.h"
#include "haptic/large_pages.h"

namespace cleft {

/// Memory for `capacity` elements is reserved once and touched as it is used. One thread grows it.
template <class T>
class SlotArray {
 public:
  explicit SlotArray(std::size_t capacity)
      : capacity_(capacity), memory_(static_cast<T*>(take_large_pages(capacity * sizeof(T)))) {}
  ~SlotArray() {
    std::destroy_n(memory_, size_);
    release_large_pages(memory_);
  }
  SlotArray(const SlotArray&) = delete;
  SlotArray& operator=(const SlotArray&) = delete;

  std::size_t size() const { return size_; }
  T& operator[](std::size_t i) { return memory_[i]; }
  const T& operator[](std::size_t i) const { return memory_[i]; }
  template <class... Value>
  void grow_to(std::size_t size, const Value&... value) {
    if (size > capacity_)
      throw InputError("the cut mesh grew to " + std::to_string(size) +
                       " vertices or triangles, and there is room for " + std::to_string(capacity_) +
                       ": cut with longer edges near the path");
    for (; size_ < size; ++size_) new (memory_ + size_) T(value...);
    ready_ = std::max(ready_, size_);
  }
  /// Touches the memory of the next elements, so that the step that adds them does not wait for it.
  void prepare(std::size_t ahead) {
    constexpr std::size_t page = 4096;
    const std::size_t until = std::min(size_ + ahead, capacity_);
    if (until <= ready_) return;
    auto* bytes = reinterpret_cast<volatile char*>(memory_ + ready_);
    const std::size_t count = (until - ready_) * sizeof(T);
    for (std::size_t at = 0; at < count; at += page) bytes[at] = 0;
    bytes[count - 1] = 0;
    ready_ = until;
  }

 private:
  std::size_t capacity_, size_ = 0, ready_ = 0;  // ready: of which the memory was touched
  T* memory_;
};

}  // namespace cleft
