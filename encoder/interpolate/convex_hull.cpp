#include "encoder/interpolate/convex_hull.h"

#include <vector>

#include "encoder/interpolate/least_squares.h"

namespace cleft {

namespace {

/// Least squares A y = b with y >= 0: Lawson and Hanson, Solving Least Squares Problems, chapter 23.
Eigen::VectorXd not_negative_solution(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  const Eigen::Index n = A.cols();
  Eigen::VectorXd y = Eigen::VectorXd::Zero(n);
  std::vector<Eigen::Index> free;
  std::vector<bool> is_free(static_cast<std::size_t>(n), false);
  const double tiny = 1e-13 * A.cwiseAbs().maxCoeff() * b.norm();
  for (Eigen::Index round = 0; round < 3 * n; ++round) {
    const Eigen::VectorXd slope = A.transpose() * (b - A * y);
    Eigen::Index best = -1;
    for (Eigen::Index i = 0; i < n; ++i)
      if (!is_free[i] && slope[i] > tiny && (best < 0 || slope[i] > slope[best])) best = i;
    if (best < 0) break;
    free.push_back(best), is_free[best] = true;
    while (!free.empty()) {
      const Eigen::VectorXd s = least_squares(A(Eigen::all, free), b).solution;
      if (s.minCoeff() > 0) {
        y.setZero(), y(free) = s;
        break;
      }
      double step = 1;
      for (std::size_t k = 0; k < free.size(); ++k)
        if (const auto i = static_cast<Eigen::Index>(k); s[i] <= 0)
          step = std::min(step, y[free[k]] / std::max(y[free[k]] - s[i], 1e-300));
      std::vector<Eigen::Index> left;
      for (std::size_t k = 0; k < free.size(); ++k) {
        y[free[k]] += step * (s[static_cast<Eigen::Index>(k)] - y[free[k]]);
        const bool stays = y[free[k]] > 1e-14;
        if (!stays) y[free[k]] = 0, is_free[free[k]] = false;
        if (stays) left.push_back(free[k]);
      }
      free = std::move(left);
    }
  }
  return y;
}

}  // namespace

double distance_to_hull(const Eigen::MatrixXd& points, const Eigen::VectorXd& x) {
  if (x.size() == 0) return 0;
  // With the point at the origin, and a row of ones asked to sum to 1: whatever the sum becomes, its shares
  // are those of the nearest point.
  Eigen::MatrixXd A(x.size() + 1, points.rows());
  A << points.transpose().colwise() - x, Eigen::RowVectorXd::Ones(points.rows());
  Eigen::VectorXd b = Eigen::VectorXd::Zero(x.size() + 1);
  b[x.size()] = 1;
  const Eigen::VectorXd y = not_negative_solution(A, b);
  const double distance = (A.topRows(x.size()) * y).norm() / y.sum();
  return distance > 1e-9 * A.cwiseAbs().maxCoeff() ? distance : 0;
}

}  // namespace cleft
