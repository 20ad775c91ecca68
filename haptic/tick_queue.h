// All values from one thread to another, in order; neither thread waits. If the reader is so late that the
// queue is full, the writer drops values.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace cleft {

/// One writer, one reader. T is copied; all memory is allocated and touched at the beginning.
template <class T>
class TickQueue {
 public:
  explicit TickQueue(std::size_t capacity) : values_(capacity) {}

  void push(const T& value) {
    const std::size_t at = written_.load(std::memory_order_relaxed);
    if (at - read_.load(std::memory_order_acquire) == values_.size()) {
      ++dropped_;
      return;
    }
    values_[at % values_.size()] = value;
    written_.store(at + 1, std::memory_order_release);
  }
  /// False if there is none.
  bool pop(T& value) {
    const std::size_t at = read_.load(std::memory_order_relaxed);
    if (at == written_.load(std::memory_order_acquire)) return false;
    value = values_[at % values_.size()];
    read_.store(at + 1, std::memory_order_release);
    return true;
  }

  /// How many values were dropped; for the writer's thread.
  std::uint64_t dropped() const { return dropped_; }

 private:
  std::vector<T> values_;
  std::uint64_t dropped_ = 0;
  alignas(64) std::atomic<std::size_t> written_{0};
  alignas(64) std::atomic<std::size_t> read_{0};
};

}  // namespace cleft
