// Cholesky decompositions by the BLAS that is made for the machine.
#pragma once

#include <Eigen/Core>

namespace cleft {

/// R, upper triangular, with R^T R = A. Only space_factor.cpp decomposes: elsewhere Eigen compiles the same
/// function without BLAS, and the linker would choose one of both.
Eigen::MatrixXd upper_cholesky_factor(const Eigen::MatrixXd& A);

}  // namespace cleft
