// Control points as the kernels read them: four doubles each (x, y, z, 0), so that one wide load takes one.
#pragma once

#include <array>
#include <cstddef>
#include <new>
#include <span>
#include <vector>

#include "base/vec3.h"
#include "encoder/field/span_table.h"

namespace cleft {

/// Memory that begins at a multiple of 64 bytes, a line of the cache.
template <class T>
struct LineAllocator {
  using value_type = T;
  LineAllocator() = default;
  template <class U>
  LineAllocator(const LineAllocator<U>&) {}
  T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), std::align_val_t(64))); }
  void deallocate(T* p, std::size_t) { ::operator delete(p, std::align_val_t(64)); }
  friend bool operator==(const LineAllocator&, const LineAllocator&) { return true; }
};
using Lines = std::vector<double, LineAllocator<double>>;

/// The grid of a field: control point (i, j, k, l) begins at i * stride[0] + j * stride[1] + k * stride[2] +
/// 4 l. Axes with fewer functions than a span needs are padded with zeros.
struct ControlGrid {
  ControlGrid(const std::array<BSplineBasis, 4>& bases, const Axes& axes, std::span<const Vec3> coefficients);

  const double* data() const { return values.data(); }

  std::array<std::ptrdiff_t, 3> stride;
  Lines values;
};

}  // namespace cleft
