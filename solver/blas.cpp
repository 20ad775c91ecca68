#include "solver/blas.h"

#include <dlfcn.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>

namespace cleft {

namespace {

template <class Function>
Function* in_any_library(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_DEFAULT, name));
}

/// The function that is found when that of this file is left out.
template <class Function>
Function* behind_this(const char* name) {
  void* found = dlsym(RTLD_NEXT, name);
  if (!found) std::abort();  // MUMPS would not have been loaded without it
  return reinterpret_cast<Function*>(found);
}

}  // namespace

OneBlasThread::OneBlasThread(bool wanted) {
  static const auto get = in_any_library<int()>("openblas_get_num_threads");
  static const auto set = in_any_library<void(int)>("openblas_set_num_threads");
  if (!wanted || !get || !set || get() == 1) return;
  before_ = get();
  set(1);
}

OneBlasThread::~OneBlasThread() {
  static const auto set = in_any_library<void(int)>("openblas_set_num_threads");
  if (before_ > 0) set(before_);
}

}  // namespace cleft

// MUMPS solves for one column by the routines for many, which first copy every block of the factor into an
// order that pays with many: for one column that takes longer than the product. Those for one column do not
// copy. (Fortran's calls, in the place of the library's own; the lengths of texts come last.)
extern "C" {

void dgemv_(const char* transposed, const int* rows, const int* columns, const double* alpha, const double* a,
            const int* leading, const double* x, const int* step_of_x, const double* beta, double* y,
            const int* step_of_y, std::size_t);
void dtrsv_(const char* triangle, const char* transposed, const char* diagonal, const int* size,
            const double* a, const int* leading, double* x, const int* step, std::size_t, std::size_t,
            std::size_t);

void dgemm_(const char* transposed_a, const char* transposed_b, const int* rows, const int* columns,
            const int* inner, const double* alpha, const double* a, const int* leading_a, const double* b,
            const int* leading_b, const double* beta, double* c, const int* leading_c, std::size_t,
            std::size_t) {
  using cleft::behind_this;
  static const auto of_many = behind_this<decltype(dgemm_)>("dgemm_");
  const auto is_as_stored = [](char letter) { return letter == 'N' || letter == 'n'; };
  if (*columns != 1 || *rows == 0 || *inner == 0)
    return of_many(transposed_a, transposed_b, rows, columns, inner, alpha, a, leading_a, b, leading_b, beta,
                   c, leading_c, 1, 1);
  const int one = 1, step = is_as_stored(*transposed_b) ? 1 : *leading_b;
  const bool as_stored = is_as_stored(*transposed_a);
  dgemv_(transposed_a, as_stored ? rows : inner, as_stored ? inner : rows, alpha, a, leading_a, b, &step,
         beta, c, &one, 1);
}

void dtrsm_(const char* side, const char* triangle, const char* transposed, const char* diagonal,
            const int* rows, const int* columns, const double* alpha, const double* a, const int* leading_a,
            double* b, const int* leading_b, std::size_t, std::size_t, std::size_t, std::size_t) {
  using cleft::behind_this;
  static const auto of_many = behind_this<decltype(dtrsm_)>("dtrsm_");
  const bool left = *side == 'L' || *side == 'l';
  if (!left || *columns != 1 || *alpha != 1)
    return of_many(side, triangle, transposed, diagonal, rows, columns, alpha, a, leading_a, b, leading_b, 1,
                   1, 1, 1);
  const int one = 1;
  dtrsv_(triangle, transposed, diagonal, rows, a, leading_a, b, &one, 1, 1, 1);
}
}
