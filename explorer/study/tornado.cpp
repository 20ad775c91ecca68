#include "explorer/study/tornado.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "encoder/interpolate/least_squares.h"

namespace cleft {

Tornado tornado_of(const std::vector<std::string>& parameters, const std::vector<std::vector<double>>& rows,
                   const std::vector<double>& figures) {
  const auto cases = static_cast<Eigen::Index>(rows.size()),
             count = static_cast<Eigen::Index>(parameters.size());
  if (count == 0) throw InputError("no parameter varies in this study: there is nothing to compare");
  Eigen::MatrixXd x(cases, count);
  Eigen::VectorXd y(cases);
  for (Eigen::Index i = 0; i < cases; ++i) {
    y[i] = figures[i];
    for (Eigen::Index k = 0; k < count; ++k) x(i, k) = rows[i][k];
  }
  if (!x.allFinite() || !y.allFinite()) throw InputError("some cases lack a parameter or the figure");
  Tornado tornado;
  tornado.logarithms = cases > 0 && x.minCoeff() > 0 && y.minCoeff() > 0;
  if (tornado.logarithms) x = x.array().log().matrix(), y = y.array().log().matrix();
  const auto back = [&](double value) { return tornado.logarithms ? std::exp(value) : value; };

  Eigen::MatrixXd design(cases, count + 1);
  design.col(0).setOnes();
  design.rightCols(count) = x;
  const LeastSquares fitted = cases > count ? least_squares(design, y) : LeastSquares{};
  if (fitted.rank < count + 1)
    throw InputError(std::to_string(cases) + " cases do not tell what each of " + std::to_string(count) +
                     " parameters does by itself");
  const Eigen::VectorXd& fit = fitted.solution;
  const double spread = (y.array() - y.mean()).square().sum();
  tornado.explained = spread > 0 ? 1 - (y - design * fit).squaredNorm() / spread : 1;

  const Eigen::VectorXd least = x.colwise().minCoeff(), greatest = x.colwise().maxCoeff();
  const Eigen::VectorXd middle = 0.5 * (least + greatest);
  const double at_middle = fit[0] + fit.tail(count).dot(middle);
  tornado.middle = back(at_middle);
  for (Eigen::Index k = 0; k < count; ++k) {
    const double half = fit[k + 1] * (greatest[k] - least[k]) / 2;
    tornado.bars.push_back(
        {parameters[k], back(least[k]), back(greatest[k]), back(at_middle - half), back(at_middle + half)});
  }
  const auto width = [](const Tornado::Bar& b) { return std::abs(b.at_greatest - b.at_least); };
  std::stable_sort(tornado.bars.begin(), tornado.bars.end(),
                   [&](const auto& a, const auto& b) { return width(a) > width(b); });
  return tornado;
}

}  // namespace cleft
