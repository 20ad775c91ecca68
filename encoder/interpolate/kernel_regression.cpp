#include "encoder/interpolate/kernel_regression.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <optional>

namespace cleft {

namespace {

Eigen::Index rows_of(const TrainingCases& cases) {
  return cases.features.rows() + static_cast<Eigen::Index>(cases.slopes.of.size());
}

/// Covariances of all slopes of some cases with anything.
class SlopeRows {
 public:
  explicit SlopeRows(const TrainingCases& cases)
      : x_(cases.features(cases.slopes.of, Eigen::all)),
        loads_(cases.loads(cases.slopes.of, Eigen::all)),
        slopes_(cases.slopes) {}

  /// With the data at a place under a load.
  Eigen::VectorXd with_data(const Eigen::VectorXd& x, const Eigen::VectorXd& load,
                            const Covariance& covariance) const {
    const Covariance::Jets k =
        covariance.along_rows(x_, slopes_.features, x, Eigen::VectorXd::Zero(x.size()));
    return (slopes_.loads * load).array() * k.value + (loads_ * load).array() * k.by_x;
  }
  /// With those from the s-th on, each other's.
  Eigen::VectorXd with_slope(Eigen::Index s, const Covariance& covariance) const {
    const Eigen::Index rest = x_.rows() - s;
    const Eigen::MatrixXd loads = loads_.bottomRows(rest), along = slopes_.loads.bottomRows(rest);
    const Eigen::VectorXd load = loads_.row(s), dload = slopes_.loads.row(s);
    const Covariance::Jets k =
        covariance.along_rows(x_.bottomRows(rest), slopes_.features.bottomRows(rest), x_.row(s).transpose(),
                              slopes_.features.row(s).transpose());
    return (along * dload).array() * k.value + (along * load).array() * k.by_y +
           (loads * dload).array() * k.by_x + (loads * load).array() * k.by_both;
  }

 private:
  Eigen::MatrixXd x_, loads_;
  const TrainingCases::Slopes& slopes_;
};

Eigen::MatrixXd matrix_of(const TrainingCases& cases, const Covariance& covariance) {
  const Eigen::Index n = cases.features.rows(), q = rows_of(cases) - n;
  Eigen::MatrixXd K(n + q, n + q);
  std::vector<Eigen::VectorXd> x, loads;
  for (Eigen::Index i = 0; i < n; ++i)
    x.emplace_back(cases.features.row(i)), loads.emplace_back(cases.loads.row(i));
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j <= i; ++j) K(i, j) = K(j, i) = loads[i].dot(loads[j]) * covariance(x[i], x[j]);
  if (q == 0) return K;
  const SlopeRows slopes(cases);
  for (Eigen::Index j = 0; j < n; ++j) K.col(j).tail(q) = slopes.with_data(x[j], loads[j], covariance);
  K.topRightCorner(n, q) = K.bottomLeftCorner(q, n).transpose();
  for (Eigen::Index s = 0; s < q; ++s) {
    K.col(n + s).tail(q - s) = slopes.with_slope(s, covariance);
    K.row(n + s).tail(q - s) = K.col(n + s).tail(q - s).transpose();
  }
  return K;
}

/// The rows of each case: its own, then its slopes'.
std::vector<std::vector<Eigen::Index>> blocks_of(const TrainingCases& cases) {
  const Eigen::Index n = cases.features.rows();
  std::vector<std::vector<Eigen::Index>> blocks(static_cast<std::size_t>(n));
  for (Eigen::Index i = 0; i < n; ++i) blocks[i] = {i};
  for (std::size_t s = 0; s < cases.slopes.of.size(); ++s)
    blocks[cases.slopes.of[s]].push_back(n + static_cast<Eigen::Index>(s));
  return blocks;
}

/// How many values each feature takes, and how many places there are in all; but for rounding.
struct Distinct {
  std::vector<Eigen::Index> values;
  Eigen::Index places = 0;

  explicit Distinct(const Eigen::MatrixXd& features) {
    constexpr double same = 1e-6;
    for (Eigen::Index k = 0; k < features.cols(); ++k) {
      std::vector<double> list(features.col(k).begin(), features.col(k).end());
      std::sort(list.begin(), list.end());
      values.push_back(
          std::unique(list.begin(), list.end(), [](double a, double b) { return b - a < same; }) -
          list.begin());
    }
    for (Eigen::Index i = 0; i < features.rows(); ++i) {
      bool first = true;
      for (Eigen::Index j = 0; j < i && first; ++j)
        first = (features.row(i) - features.row(j)).cwiseAbs().maxCoeff() > same;
      places += first;
    }
  }
};

/// Whether features take other values in most cases, as those of sequences and drawn ones do.
bool scattered(const Distinct& distinct) {
  return std::ranges::all_of(distinct.values, [&](Eigen::Index n) { return 2 * n >= distinct.places; });
}

/// Whether cases take few values of each feature, but only a few of their combinations: a sparse grid. Left
/// out, a case there leaves the end of an axis, or a corner, to what is beyond: the errors of that are least
/// by methods, and with nuggets and lengths, that miss the cases themselves.
bool on_sparse_grid(const Distinct& distinct) {
  const auto few = [&](Eigen::Index n) { return 2 * n < distinct.places; };
  double combinations = 1;
  for (const Eigen::Index n : distinct.values) combinations *= static_cast<double>(n);
  return std::ranges::all_of(distinct.values, few) &&
         2 * combinations > 3 * static_cast<double>(distinct.places);
}

/// By which hyperparameters of a Gaussian process are chosen. Where cases are scattered, from six a feature
/// on, the likelihood counts as much as left_out_error(), which is often least at lengths that are far too
/// great; of fewer cases it is often greatest at lengths that are far too short. Lengths that scattered cases
/// do not tell are drawn to the others. With 24 to 64 cases of six studies errors are 0.75 to 0.99 of those
/// by left_out_error() alone, with fewer 0.84 to 0.99 (tests/analysis/README.md); on grids they are not less.
double misfit(const TrainingCases& cases, const Covariance& covariance, bool is_scattered) {
  constexpr Eigen::Index enough = 6;
  const KernelRegression regression(cases, covariance);
  double own = regression.left_out_error();
  if (!is_scattered) return own;
  const Eigen::Index n = cases.features.rows();
  if (n >= enough * cases.features.cols()) own = std::sqrt(own * regression.by_likelihood(cases.gram));
  const Eigen::ArrayXd lengths = covariance.lengths.array().log();
  return own * std::exp((lengths - lengths.mean()).square().sum() / static_cast<double>(n));
}

/// Coordinate descent on logarithms: both are smooth in them, and seldom have more than one minimum.
Covariance tuned(const TrainingCases& cases, Covariance covariance, bool one_length, bool with_nugget) {
  const Eigen::Index d = cases.features.cols();
  const bool is_scattered = !one_length && scattered(Distinct(cases.features));
  const auto error_of = [&](const Covariance& one) { return misfit(cases, one, is_scattered); };
  double best = error_of(covariance);
  const auto attempt = [&](Covariance changed) {
    if (changed.lengths.minCoeff() < 0.05 || changed.lengths.maxCoeff() > 200 || changed.nugget < 1e-9 ||
        changed.nugget > 0.1 || changed.slope_nugget < 1e-9 || changed.slope_nugget > 0.1)
      return false;
    const double error = error_of(changed);
    if (!(error < best * (1 - 1e-6))) return false;
    best = error, covariance = std::move(changed);
    return true;
  };
  const Eigen::Index lengths = one_length ? 1 : d,
                     knobs = lengths + (with_nugget ? cases.slopes.of.empty() ? 1 : 2 : 0);
  for (double step = 4; step > 1.15; step = std::sqrt(step)) {
    bool moved = true;
    for (int round = 0; moved && round < 8; ++round) {
      moved = false;
      for (Eigen::Index knob = 0; knob < knobs; ++knob)
        for (const double factor : {step, 1 / step}) {
          Covariance changed = covariance;
          if (knob == lengths)
            changed.nugget *= factor * factor;
          else if (knob > lengths)
            changed.slope_nugget *= factor * factor;
          else if (one_length)
            changed.lengths *= factor;
          else
            changed.lengths[knob] *= factor;
          if (attempt(std::move(changed))) moved = true;
        }
    }
  }
  return covariance;
}

}  // namespace

KernelRegression::KernelRegression(const TrainingCases& cases, Covariance covariance)
    : cases_{cases.features, cases.loads, {}, cases.slopes},
      matrix_(matrix_of(cases, covariance)),
      covariance_(std::move(covariance)) {
  const Eigen::Index n = cases.features.rows(), m = rows_of(cases), d = cases.features.cols();
  const double own = covariance_(Eigen::VectorXd::Zero(d), Eigen::VectorXd::Zero(d));
  nugget_ = covariance_.nugget * own;
  nuggets_ = Eigen::VectorXd::Constant(m, covariance_.slope_nugget * own);
  nuggets_.head(n).setConstant(nugget_);
  factor_.compute(matrix_ + Eigen::MatrixXd(nuggets_.asDiagonal()));
  if (cases.gram.size() == 0) return;
  const LeftOut left_out = this->left_out();
  const Eigen::VectorXd squares = cases.gram.diagonal().head(n);
  const double least = std::max(squares.mean() * least_size * least_size, 1e-300);
  double sum = 0;
  for (Eigen::Index i = 0; i < n; ++i)
    sum += std::max(0., left_out.weights.col(i).dot(cases.gram * left_out.weights.col(i))) /
           std::max(squares[i], least);
  left_out_error_ = std::sqrt(sum / static_cast<double>(n));
  if (!std::isfinite(left_out_error_)) left_out_error_ = 1e300;
}

double KernelRegression::by_likelihood(const Eigen::MatrixXd& gram) const {
  const double sum = factor_.solve(gram).trace(),
               logarithm = factor_.vectorD().cwiseMax(1e-300).array().log().mean();
  const double scale = std::sqrt(std::max(sum, 0.)) * std::exp(logarithm / 2);
  return std::isfinite(scale) ? scale : 1e300;
}

Eigen::MatrixXd KernelRegression::inverse() const {
  return factor_.solve(Eigen::MatrixXd::Identity(rows(), rows()));
}

KernelRegression::LeftOut KernelRegression::left_out() const {
  const Eigen::Index n = cases_.features.rows(), m = rows();
  const Eigen::MatrixXd inverse = this->inverse();
  const auto blocks = blocks_of(cases_);
  LeftOut left_out{Eigen::MatrixXd(m, n), Eigen::VectorXd(n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto& block = blocks[i];
    if (block.size() == 1) {
      const double diagonal = std::max(inverse(i, i), 1e-300);
      left_out.weights.col(i) = inverse.col(i) / diagonal;
      left_out.deviations[i] = 1 / std::sqrt(diagonal);
    } else {
      const Eigen::MatrixXd own_block = inverse(block, block);
      Eigen::VectorXd first = Eigen::VectorXd::Zero(own_block.rows());
      first[0] = 1;
      const Eigen::VectorXd shares = own_block.ldlt().solve(first);
      left_out.weights.col(i) = inverse(Eigen::all, block) * shares;
      left_out.deviations[i] = std::sqrt(std::max(shares[0], 1e-300));
    }
  }
  return left_out;
}

Eigen::MatrixXd KernelRegression::against(const Eigen::MatrixXd& features,
                                          const Eigen::MatrixXd& loads) const {
  const Eigen::Index n = cases_.features.rows();
  Eigen::MatrixXd against(rows(), features.rows());
  against.topRows(n) = cases_.loads * loads.transpose();
  for (Eigen::Index j = 0; j < features.rows(); ++j)
    against.col(j).head(n).array() *= covariance_.of_rows(cases_.features, features.row(j));
  if (rows() == n) return against;
  const SlopeRows slopes(cases_);
  for (Eigen::Index j = 0; j < features.rows(); ++j)
    against.col(j).tail(rows() - n) =
        slopes.with_data(features.row(j).transpose(), loads.row(j).transpose(), covariance_);
  return against;
}

Eigen::MatrixXd KernelRegression::coefficients(const Eigen::MatrixXd& data) const {
  return factor_.solve(data.transpose()).transpose();
}

Eigen::MatrixXd KernelRegression::sums(const Eigen::MatrixXd& coefficients, const Eigen::MatrixXd& features,
                                       const Eigen::MatrixXd& loads) const {
  return coefficients * against(features, loads);
}

KernelRegression::Weights KernelRegression::weights(const Eigen::MatrixXd& features,
                                                    const Eigen::MatrixXd& loads) const {
  const Eigen::MatrixXd k = against(features, loads);
  Eigen::VectorXd own(features.rows());
  for (Eigen::Index j = 0; j < own.size(); ++j) {
    const Eigen::VectorXd x = features.row(j).transpose();
    own[j] = loads.row(j).squaredNorm() * covariance_(x, x);
  }
  Weights weights{factor_.solve(k), {}};
  // Of the predictions w as they were rounded: own - k . K^-1 k would only add up the errors of w.
  const Eigen::MatrixXd& w = weights.of_rows;
  const Eigen::MatrixXd spread = matrix_ * w + nuggets_.asDiagonal() * w - 2 * k;
  weights.deviations =
      ((own + w.cwiseProduct(spread).colwise().sum().transpose()).cwiseMax(0.).array() + nugget_).sqrt();
  return weights;
}

Eigen::MatrixXd KernelRegression::covariance_between(const Eigen::MatrixXd& features,
                                                     const Eigen::MatrixXd& loads) const {
  const Eigen::MatrixXd k = against(features, loads);
  Eigen::MatrixXd between = -(k.transpose() * factor_.solve(k));
  for (Eigen::Index a = 0; a < between.rows(); ++a)
    for (Eigen::Index b = 0; b < between.cols(); ++b)
      between(a, b) += loads.row(a).dot(loads.row(b)) *
                       covariance_(Eigen::VectorXd(features.row(a)), Eigen::VectorXd(features.row(b)));
  between.diagonal() = between.diagonal().cwiseMax(0.).array() + nugget_;
  return between;
}

namespace {

/// Whether squares are seen apart from all else: not if the places lie on a quadric though they are as many
/// as would determine one, such as two parallel lines. A square is then the same as a constant, which a
/// quadratic trend shares out, and between the lines only a part of it is left.
bool sees_squares(const Eigen::MatrixXd& features) {
  constexpr double nothing = 1e-10;
  const Eigen::Index n = features.rows(), d = features.cols();
  Eigen::MatrixXd terms(n, 1 + d + d * (d + 1) / 2);
  terms.col(0).setOnes(), terms.middleCols(1, d) = features;
  Eigen::Index at = 1 + d;
  for (Eigen::Index a = 0; a < d; ++a)
    for (Eigen::Index b = 0; b <= a; ++b) terms.col(at++) = features.col(a).cwiseProduct(features.col(b));
  const Eigen::VectorXd values =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(terms.transpose() * terms, Eigen::EigenvaluesOnly)
          .eigenvalues();
  const Eigen::Index rank = (values.array() > nothing * values.maxCoeff()).count();
  return rank >= std::min(Distinct(features).places, terms.cols());
}

}  // namespace

std::vector<KernelRegression> all_methods(const TrainingCases& cases) {
  using enum Covariance::Correlation;
  const Eigen::VectorXd lengths = Eigen::VectorXd::Constant(cases.features.cols(), 2.0);
  const std::string with = cases.slopes.of.empty() ? "" : " with derivatives";
  std::vector<KernelRegression> methods;
  if (cases.fitted_alike && on_sparse_grid(Distinct(cases.features))) {
    methods.emplace_back(cases, Covariance{"Gaussian process" + with, 1, gaussian, 100, 1e-8, lengths});
    return methods;
  }
  methods.emplace_back(cases, Covariance{"linear polynomial" + with, 1, none, 1, 1e-9, lengths});
  if (cases.features.cols() == 0) return methods;
  const bool squares = !cases.slopes.of.empty() || sees_squares(cases.features);
  if (squares)
    methods.emplace_back(cases, Covariance{"quadratic polynomial" + with, 2, none, 1, 1e-9, lengths});
  methods.emplace_back(
      cases, tuned(cases, {"radial basis functions" + with, 1, matern, 100, 1e-9, lengths}, true, false));
  std::optional<KernelRegression> process;
  for (const int degree : {1, 2}) {
    if (degree == 2 && !squares) continue;
    KernelRegression one(
        cases, tuned(cases, {"Gaussian process" + with, degree, gaussian, 100, 1e-6, lengths}, false, true));
    if (!process || one.left_out_error() < process->left_out_error()) process.emplace(std::move(one));
  }
  methods.push_back(std::move(*process));
  return methods;
}

}  // namespace cleft
