#include "explorer/analysis/optimum.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace cleft {

namespace {

constexpr int members_for_each = 14, fewest_members = 28, most_members = 140;
constexpr int most_generations = 400;
constexpr double best_share = 0.15;   // of the members, toward which the others move
constexpr double step = 0.6;          // factor of differences
constexpr double crossing = 0.9;      // share of the coordinates that change
constexpr double near_enough = 1e-7;  // of the box: the members are then one point

bool better(double aim, double excess, double other_aim, double other_excess) {
  if (excess <= 0 && other_excess <= 0) return aim < other_aim;
  return excess < other_excess;
}

class Evolution {
 public:
  Evolution(const BoxProblem& problem, const Eigen::MatrixXd& starts) : problem_(problem) {
    const Eigen::Index d = problem.least.size();
    const auto n = std::clamp<Eigen::Index>(members_for_each * d, fewest_members, most_members);
    members_.resize(d, n + starts.cols());
    members_.leftCols(n) = filling(d, n);
    members_.rightCols(starts.cols()) =
        (starts.colwise() - problem.least).array().colwise() / lengths().array();
    values_ = at(members_);
    keep_best(n);
  }

  Optimum run() {
    for (int generation = 0; generation < most_generations && !together(); ++generation) advance();
    const std::vector<int> order = ranks();
    const Eigen::Index best = order.front();
    return {problem_.least + lengths().cwiseProduct(members_.col(best)), values_.aim[best],
            values_.excess[best], evaluations_};
  }

 private:
  Eigen::VectorXd lengths() const { return (problem_.greatest - problem_.least).cwiseMax(1e-300); }

  /// An additive sequence of low discrepancy, and the corners in few dimensions, where optima often are.
  static Eigen::MatrixXd filling(Eigen::Index d, Eigen::Index n) {
    const double base = std::pow(2., 1. / (static_cast<double>(d) + 1));  // below 2 in every dimension
    Eigen::MatrixXd points(d, n);
    for (Eigen::Index j = 0; j < n; ++j)
      for (Eigen::Index k = 0; k < d; ++k) {
        const double x = 0.5 + static_cast<double>(j + 1) / std::pow(base, static_cast<double>(k + 1));
        points(k, j) = x - std::floor(x);
      }
    for (Eigen::Index j = 0; d < 4 && j < (1 << d); ++j)
      for (Eigen::Index k = 0; k < d; ++k) points(k, j) = static_cast<double>(j >> k & 1);
    return points;
  }

  AimAndExcess at(const Eigen::MatrixXd& points) {
    evaluations_ += static_cast<int>(points.cols());
    return problem_.at((points.array().colwise() * lengths().array()).matrix().colwise() + problem_.least);
  }

  std::vector<int> ranks() const {
    std::vector<int> order(static_cast<std::size_t>(members_.cols()));
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
      return better(values_.aim[a], values_.excess[a], values_.aim[b], values_.excess[b]);
    });
    return order;
  }

  void keep_best(Eigen::Index count) {
    std::vector<int> order = ranks();
    order.resize(static_cast<std::size_t>(count));
    members_ = Eigen::MatrixXd(members_(Eigen::all, order));
    values_ = {values_.aim(order), values_.excess(order)};
  }

  bool together() const {
    return (members_.rowwise().maxCoeff() - members_.rowwise().minCoeff()).maxCoeff() < near_enough;
  }

  void advance() {
    const Eigen::Index d = members_.rows(), n = members_.cols();
    const std::vector<int> order = ranks();
    const auto leading =
        std::max<Eigen::Index>(2, static_cast<Eigen::Index>(best_share * static_cast<double>(n)));
    Eigen::MatrixXd trials = members_;
    for (Eigen::Index i = 0; i < n; ++i) {
      const Eigen::Index best = order[static_cast<std::size_t>(below(leading))], one = below(n),
                         other = below(n), always = below(d);
      const double factor = step * (0.5 + fraction());
      for (Eigen::Index k = 0; k < d; ++k)
        if (k == always || fraction() < crossing)
          trials(k, i) = std::clamp(members_(k, i) + factor * (members_(k, best) - members_(k, i)) +
                                        factor * (members_(k, one) - members_(k, other)),
                                    0., 1.);
    }
    const AimAndExcess tried = at(trials);
    for (Eigen::Index i = 0; i < n; ++i)
      if (!better(values_.aim[i], values_.excess[i], tried.aim[i], tried.excess[i]))
        members_.col(i) = trials.col(i), values_.aim[i] = tried.aim[i], values_.excess[i] = tried.excess[i];
  }

  double fraction() { return static_cast<double>(random_() >> 11) * 0x1p-53; }
  Eigen::Index below(Eigen::Index count) {
    return std::min(count - 1, static_cast<Eigen::Index>(fraction() * static_cast<double>(count)));
  }

  const BoxProblem& problem_;
  Eigen::MatrixXd members_;  // in the unit cube, a column each
  AimAndExcess values_;
  std::mt19937_64 random_{1};
  int evaluations_ = 0;
};

}  // namespace

Optimum least_in_box(const BoxProblem& problem, const Eigen::MatrixXd& starts) {
  return Evolution(problem, starts).run();
}

std::vector<int> unsurpassed(const Eigen::MatrixXd& values) {
  std::vector<int> list;
  for (Eigen::Index i = 0; i < values.cols(); ++i) {
    bool surpassed = false;
    for (Eigen::Index j = 0; j < values.cols() && !surpassed; ++j)
      surpassed = (values.col(j).array() <= values.col(i).array()).all() &&
                  (values.col(j).array() < values.col(i).array()).any();
    if (!surpassed) list.push_back(static_cast<int>(i));
  }
  return list;
}

}  // namespace cleft
