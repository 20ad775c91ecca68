#include "encoder/stencil_product.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "encoder/space_fit_parts.h"

namespace cleft {

namespace {

using Four __attribute__((vector_size(32))) = double;

// Control points need not be aligned to 32 bytes.
inline __attribute__((always_inline)) void load(Four& four, const double* at) {
  std::memcpy(&four, at, sizeof four);
}
inline __attribute__((always_inline)) void store(double* at, const Four& four) {
  std::memcpy(at, &four, sizeof four);
}

template <bool Symmetric>
inline __attribute__((always_inline)) void add(const StencilBlock& block, const double* from, double* to,
                                               const double* other, double* to_other) {
  const int V = block.V, W = block.W;
  for (int j = 0; j < V; ++j)
    for (int k = 0; k < W; ++k) {
      const int c = j * W + k, first_k = std::max(0, k - order + 1), last_k = std::min(W - 1, k + order - 1);
      const double* stencil = block.values + static_cast<std::ptrdiff_t>(c) * reach * reach;
      Four sum = {}, left = {}, x, y;
      if constexpr (Symmetric) load(left, other + 4L * c);
      for (int jj = std::max(0, j - order + 1); jj <= std::min(V - 1, j + order - 1); ++jj) {
        const double* value = stencil + SpaceFit::Parts::offset(jj - j, first_k - k);
        for (int at = jj * W + first_k; at <= jj * W + last_k; ++at, ++value) {
          load(x, from + 4L * at);
          sum += *value * x;
          if constexpr (!Symmetric) continue;
          load(y, to_other + 4L * at);
          y += *value * left;
          store(to_other + 4L * at, y);
        }
      }
      load(y, to + 4L * c);
      y += sum;
      store(to + 4L * c, y);
    }
}

inline __attribute__((always_inline)) void add_any(const StencilBlock& block, const double* from, double* to,
                                                   const double* other, double* to_other) {
  if (to_other)
    add<true>(block, from, to, other, to_other);
  else
    add<false>(block, from, to, other, to_other);
}

#if defined(__x86_64__)
__attribute__((target("avx2,fma"))) void add_avx2(const StencilBlock& block, const double* from, double* to,
                                                  const double* other, double* to_other) {
  add_any(block, from, to, other, to_other);
}
#endif

}  // namespace

void add_product(const StencilBlock& block, const double* from, double* to, const double* other,
                 double* to_other) {
#if defined(__x86_64__)
  static const bool wide = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  if (wide) return add_avx2(block, from, to, other, to_other);
#endif
  add_any(block, from, to, other, to_other);
}

}  // namespace cleft
