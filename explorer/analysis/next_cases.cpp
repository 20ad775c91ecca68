#include "explorer/analysis/next_cases.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace cleft {

namespace {

constexpr double hardly_left = 1e-9;  // of the variance: what is left of it at a place that is chosen

double nearest(const Eigen::VectorXd& point, const Eigen::MatrixXd& places, const Eigen::VectorXd& lengths) {
  double least = HUGE_VAL;
  for (Eigen::Index i = 0; i < places.cols(); ++i)
    least = std::min(least, (places.col(i) - point).cwiseQuotient(lengths).norm());
  return least;
}

}  // namespace

NextCases next_cases(const FigureModel& model, const Eigen::MatrixXd& candidates,
                     const Eigen::VectorXd& lengths, const Eigen::MatrixXd& avoided, int count) {
  Eigen::MatrixXd cases(candidates.rows(), model.cases());
  Eigen::VectorXd largest = Eigen::VectorXd::Zero(std::ssize(model.figures()));
  for (int i = 0; i < model.cases(); ++i)
    cases.col(i) = model.place_of(i), largest = largest.cwiseMax(model.figures_of(i).cwiseAbs());
  std::vector<Eigen::Index> possible;
  for (Eigen::Index j = 0; j < candidates.cols(); ++j)
    if (const double apart = nearest(candidates.col(j), cases, lengths);
        apart > 0 && apart <= nearest(candidates.col(j), avoided, lengths))
      possible.push_back(j);
  NextCases next;
  if (possible.empty()) return next;
  const Eigen::MatrixXd points = candidates(Eigen::all, possible);
  const Eigen::VectorXd errors =
      (largest.cwiseMax(1e-300).cwiseInverse().asDiagonal() * model.at(points).errors)
          .colwise()
          .maxCoeff()
          .transpose();
  next.error = errors.maxCoeff();

  const Eigen::Index chosen = std::min<Eigen::Index>(count, points.cols());
  next.points.resize(points.rows(), chosen), next.errors.resize(chosen);
  Eigen::MatrixXd covariance = model.covariance(points);
  const Eigen::VectorXd weights = (errors / std::max(next.error, 1e-300))
                                      .cwiseAbs2()
                                      .cwiseQuotient(covariance.diagonal().cwiseMax(1e-300));
  const Eigen::VectorXd before = covariance.diagonal();
  for (Eigen::Index k = 0; k < chosen; ++k) {
    Eigen::Index best = 0;
    // Of the variance everywhere what a case takes away.
    Eigen::VectorXd told = covariance.cwiseAbs2().transpose() * weights;
    for (Eigen::Index j = 0; j < told.size(); ++j)
      told[j] = covariance(j, j) > hardly_left * before[j] ? told[j] / covariance(j, j) : 0;
    told.maxCoeff(&best);
    next.points.col(k) = points.col(best), next.errors[k] = errors[best];
    const Eigen::VectorXd column = covariance.col(best);
    covariance -= column * column.transpose() / column[best];
    covariance.row(best).setZero(), covariance.col(best).setZero();  // up to rounding
  }
  return next;
}

}  // namespace cleft
