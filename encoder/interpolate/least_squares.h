// Least squares of dense matrices. Eigen's decompositions take seconds to compile for each type of a
// right-hand side, so that they are in one file.
#pragma once

#include <Eigen/Core>

namespace cleft {

struct LeastSquares {
  Eigen::VectorXd solution;
  Eigen::Index rank = 0;  ///< of the matrix
};
/// An x for which |A x - b| is least, by a QR decomposition with column pivoting: 0 where columns depend on
/// those before.
LeastSquares least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

/// The shortest of all x for which |A x - b| is least.
Eigen::VectorXd shortest_least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);
/// The same for each column of B.
Eigen::MatrixXd shortest_least_squares(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

}  // namespace cleft
