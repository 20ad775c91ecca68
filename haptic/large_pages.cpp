#include "haptic/large_pages.h"

#include <sys/mman.h>

#include <cstdlib>
#include <new>

namespace cleft {

namespace {
constexpr std::size_t large = 2 << 20;
}

void* take_large_pages(std::size_t bytes) {
  const std::size_t whole = (bytes + large - 1) / large * large;
  void* memory = std::aligned_alloc(large, whole);
  if (!memory) throw std::bad_alloc();
  madvise(memory, whole, MADV_HUGEPAGE);  // a wish: small pages do as well
  return memory;
}

void release_large_pages(void* memory) { std::free(memory); }

}  // namespace cleft
