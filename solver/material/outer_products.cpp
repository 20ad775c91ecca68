#include "solver/material/outer_products.h"

namespace cleft {

namespace {

using Four __attribute__((vector_size(32), may_alias)) = double;

/// Column after column of the sum, which stays in registers meanwhile.
inline __attribute__((always_inline)) void sum_of(int count, const double (*left)[20],
                                                  const double (*right)[18], double (*columns)[20]) {
  for (int column = 0; column < 18; ++column) {
    Four sum[5] = {};
    for (int term = 0; term < count; ++term) {
      const auto* const rows = reinterpret_cast<const Four*>(left[term]);
      const double factor = right[term][column];
      for (int i = 0; i < 5; ++i) sum[i] += factor * rows[i];
    }
    for (int i = 0; i < 5; ++i) reinterpret_cast<Four*>(columns[column])[i] = sum[i];
  }
}

#if defined(__x86_64__)
__attribute__((target("avx2,fma"))) void sum_of_avx2(int count, const double (*left)[20],
                                                     const double (*right)[18], double (*columns)[20]) {
  sum_of(count, left, right, columns);
}
#endif

}  // namespace

OuterProducts::Matrix OuterProducts::sum() const {
  alignas(32) double columns[18][padded];
#if defined(__x86_64__)
  static const bool wide = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  if (wide)
    sum_of_avx2(count_, left_, right_, columns);
  else
#endif
    sum_of(count_, left_, right_, columns);
  return Eigen::Map<const Matrix, 0, Eigen::OuterStride<>>(columns[0], Eigen::OuterStride<>(padded));
}

}  // namespace cleft
