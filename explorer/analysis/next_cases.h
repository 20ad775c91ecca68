// Which further cases a study needs most, so that its figures are known everywhere in its ranges.
#pragma once

#include <Eigen/Core>

#include "explorer/analysis/figure_model.h"

namespace cleft {

struct NextCases {
  double error = 0;        ///< the largest at any candidate, of any figure over its largest value
  Eigen::MatrixXd points;  ///< the candidates to simulate next, the most wanted first: a column for each
  Eigen::VectorXd errors;  ///< estimated there, before any of them is simulated
};

/// Chosen one after another: each where a case lowers the variance at all candidates most (Kriging: it is
/// known before the case is simulated), which counts by the square of the error that is estimated there:
/// active learning by Cohn, Neural network exploration using optimal experiment design, 1996, with weights.
/// `candidates`: values of the model's parameters, a column for each.
/// `lengths`: of the ranges, by which distances are measured. Candidates that lie nearer to a place in
/// `avoided` (a case that failed) than to any case are left out.
NextCases next_cases(const FigureModel& model, const Eigen::MatrixXd& candidates,
                     const Eigen::VectorXd& lengths, const Eigen::MatrixXd& avoided, int count);

}  // namespace cleft
