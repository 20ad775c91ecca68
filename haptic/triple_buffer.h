// The newest value from one thread to another: neither thread waits, and values are never torn.
#pragma once

#include <atomic>

namespace cleft {

/// One writer, one reader. T is copied.
template <class T>
class TripleBuffer {
 public:
  TripleBuffer() = default;
  explicit TripleBuffer(const T& value) : value_{value, value, value} {}

  void write(const T& value) {
    value_[back_] = value;
    back_ = middle_.exchange(back_ | fresh, std::memory_order_acq_rel) & index;
  }
  /// The value written last, which is the same again if none was written since.
  const T& read() {
    if (middle_.load(std::memory_order_relaxed) & fresh)
      front_ = middle_.exchange(front_, std::memory_order_acq_rel) & index;
    return value_[front_];
  }

 private:
  static constexpr unsigned index = 3, fresh = 4;
  T value_[3]{};
  alignas(64) std::atomic<unsigned> middle_{1};
  alignas(64) unsigned back_ = 0;
  alignas(64) unsigned front_ = 2;
};

}  // namespace cleft
