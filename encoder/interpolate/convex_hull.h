// The distance of a point from the cases.
#pragma once

#include <Eigen/Core>

namespace cleft {

/// Distance of a point from the convex hull of `points` (n x d); 0 inside.
double distance_to_hull(const Eigen::MatrixXd& points, const Eigen::VectorXd& x);

}  // namespace cleft
