// BLAS as MUMPS calls it, against Eigen.
#include "solver/blas.h"

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <string>

extern "C" {
void dgemm_(const char*, const char*, const int*, const int*, const int*, const double*, const double*,
            const int*, const double*, const int*, const double*, double*, const int*, std::size_t,
            std::size_t);
void dtrsm_(const char*, const char*, const char*, const char*, const int*, const int*, const double*,
            const double*, const int*, double*, const int*, std::size_t, std::size_t, std::size_t,
            std::size_t);
}

namespace cleft {

namespace {

using Eigen::MatrixXd;

constexpr int spare = 3;  // rows that the arrays have and the matrices have not

MatrixXd some(int rows, int columns) {
  return MatrixXd::NullaryExpr(rows, columns, [](Eigen::Index i, Eigen::Index j) {
    return std::sin(1. + 3. * static_cast<double>(i) + 7.3 * static_cast<double>(j));
  });
}

}  // namespace

TEST(Blas, ProductsOfOneColumnAndOfManyAreThoseOfEigen) {
  for (const int columns : {1, 2})
    for (const int inner : {0, 1, 5})
      for (const char a_is : {'N', 'T'})
        for (const char b_is : {'N', 'T'})
          for (const double beta : {0., 1., -0.5}) {
            SCOPED_TRACE((std::string{a_is, b_is} + std::to_string(columns) + std::to_string(inner)));
            const int rows = 4;
            const double alpha = -1.5;
            const MatrixXd a = a_is == 'N' ? some(rows + spare, inner) : some(inner + spare, rows);
            const MatrixXd b = b_is == 'N' ? some(inner + spare, columns) : some(columns + spare, inner);
            const MatrixXd left =
                a_is == 'N' ? MatrixXd(a.topRows(rows)) : MatrixXd(a.topRows(inner).transpose());
            const MatrixXd right =
                b_is == 'N' ? MatrixXd(b.topRows(inner)) : MatrixXd(b.topRows(columns).transpose());
            MatrixXd c = some(rows + spare, columns), expected = c;
            expected.topRows(rows) = beta * c.topRows(rows);
            if (inner > 0) expected.topRows(rows) += alpha * left * right;
            const int of_a = static_cast<int>(a.rows()), of_b = static_cast<int>(b.rows()),
                      of_c = static_cast<int>(c.rows());
            dgemm_(&a_is, &b_is, &rows, &columns, &inner, &alpha, a.data(), &of_a, b.data(), &of_b, &beta,
                   c.data(), &of_c, 1, 1);
            EXPECT_LT((c - expected).cwiseAbs().maxCoeff(), 1e-14);
          }
}

TEST(Blas, TrianglesAreSolvedAsByEigen) {
  const int size = 6, leading = size + spare;
  MatrixXd a = some(leading, size);
  a.diagonal().array() += 4;
  const MatrixXd square = a.topRows(size);
  for (const int columns : {1, 2})
    for (const double alpha : {1., 2.})
      for (const char triangle : {'L', 'U'})
        for (const char transposed : {'N', 'T'}) {
          SCOPED_TRACE((std::string{triangle, transposed} + std::to_string(columns)));
          const MatrixXd part = triangle == 'L' ? MatrixXd(square.triangularView<Eigen::Lower>())
                                                : MatrixXd(square.triangularView<Eigen::Upper>());
          MatrixXd b = some(leading, columns);
          const MatrixXd right = alpha * b.topRows(size);
          const MatrixXd matrix = transposed == 'N' ? part : MatrixXd(part.transpose());
          const MatrixXd expected = matrix.partialPivLu().solve(right);
          dtrsm_("L", &triangle, &transposed, "N", &size, &columns, &alpha, a.data(), &leading, b.data(),
                 &leading, 1, 1, 1, 1);
          EXPECT_LT((b.topRows(size) - expected).cwiseAbs().maxCoeff(), 1e-14);
        }
}

TEST(Blas, ThreadsAreOneForAWhileAndThenAsBefore) {
  const auto threads = reinterpret_cast<int (*)()>(dlsym(RTLD_DEFAULT, "openblas_get_num_threads"));
  if (!threads) GTEST_SKIP() << "this BLAS is not OpenBLAS";
  const int before = threads();
  {
    const OneBlasThread one, inner;
    EXPECT_EQ(threads(), 1);
    const OneBlasThread unwanted(false);
    EXPECT_EQ(threads(), 1);
  }
  EXPECT_EQ(threads(), before);
  const OneBlasThread unwanted(false);
  EXPECT_EQ(threads(), before);
}

}  // namespace cleft
