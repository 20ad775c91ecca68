// The least value of a function in a box, under a condition, and points that no other one surpasses.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace cleft {

/// Of points, a column each: what is to be least, and how far the condition is from being fulfilled, which it
/// is where the excess is at most 0.
struct AimAndExcess {
  Eigen::VectorXd aim, excess;
};

struct BoxProblem {
  Eigen::VectorXd least, greatest;
  std::function<AimAndExcess(const Eigen::MatrixXd& points)> at;
};

struct Optimum {
  Eigen::VectorXd point;
  double aim = 0,
         excess = 0;  ///< above 0: no point was found that fulfils the condition; this is the nearest
  int evaluations = 0;
};

/// Differential evolution (Storn and Price 1997; current-to-best mutation: Zhang and Sanderson 2009), in
/// which the point that is nearer to the condition wins, and among those that fulfil it the one of the
/// lesser aim (Deb 2000). It needs no derivatives and leaves local minima; the numbers it draws are always
/// the same. `starts`: points to begin with, besides those that fill the box.
Optimum least_in_box(const BoxProblem& problem, const Eigen::MatrixXd& starts);

/// The columns that no other one surpasses: is less in a row and greater in none (Pareto). Of equal ones all.
std::vector<int> unsurpassed(const Eigen::MatrixXd& values);

}  // namespace cleft
