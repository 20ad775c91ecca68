// Memory in large pages, if the system provides them. A tick begins with cold caches and reads scattered
// data: with small pages it would wait for page tables as long as for the data.
#pragma once

#include <cstddef>
#include <memory>

namespace cleft {

/// Allocates at least `bytes` without touching them. Throws std::bad_alloc.
void* take_large_pages(std::size_t bytes);
void release_large_pages(void* memory);

/// n elements, value-initialised. They are trivially destructible.
template <class T>
class LargeArray {
 public:
  LargeArray() = default;
  explicit LargeArray(std::size_t n) : memory_(static_cast<T*>(take_large_pages(n * sizeof(T)))) {
    static_assert(std::is_trivially_destructible_v<T>);
    std::uninitialized_value_construct_n(memory_.get(), n);
  }
  T* get() const { return memory_.get(); }
  T& operator[](std::size_t i) const { return memory_.get()[i]; }
  explicit operator bool() const { return memory_ != nullptr; }

 private:
  struct Release {
    void operator()(T* memory) const { release_large_pages(memory); }
  };
  std::unique_ptr<T, Release> memory_;
};

}  // namespace cleft
