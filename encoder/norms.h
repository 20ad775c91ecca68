// Norms of the values of a field.
#pragma once

#include <Eigen/Core>

namespace cleft {

/// Norms of the rows: Euclidean; of six components, of the symmetric tensor XX YY ZZ XY YZ XZ, whose norm
/// does not depend on the axes.
inline Eigen::VectorXd norms_of(const Eigen::MatrixXd& rows) {
  if (rows.cols() != 6) return rows.rowwise().norm();
  return (rows.leftCols<3>().rowwise().squaredNorm() + 2 * rows.rightCols<3>().rowwise().squaredNorm())
      .cwiseSqrt();
}

}  // namespace cleft
