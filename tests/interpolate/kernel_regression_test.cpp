// The closed forms against cases really left out, and regressions whose answer is known.
#include "encoder/interpolate/kernel_regression.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <random>

namespace cleft {

namespace {

using Correlation = Covariance::Correlation;

struct Problem {
  TrainingCases cases;
  Eigen::MatrixXd data;  // a column for each case
};

Problem random_problem(int n, int d, int loads, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto fill = [&](Eigen::Index rows, Eigen::Index columns) {
    return Eigen::MatrixXd(Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return uniform(random); }));
  };
  Problem p{{fill(n, d), fill(n, loads), {}}, fill(7, n)};
  p.cases.gram = p.data.transpose() * p.data;
  return p;
}

std::vector<Covariance> covariances(int d) {
  Eigen::VectorXd lengths(d);
  for (int k = 0; k < d; ++k) lengths[k] = 0.7 + 0.4 * k;
  return {{"linear", 1, Correlation::none, 1, 1e-3, lengths},
          {"quadratic", 2, Correlation::none, 2, 1e-2, lengths},
          {"matern", 1, Correlation::matern, 5, 1e-4, lengths},
          {"gaussian", 2, Correlation::gaussian, 5, 1e-3, lengths}};
}

TrainingCases without(const TrainingCases& all, Eigen::Index i) {
  std::vector<Eigen::Index> rest;
  for (Eigen::Index k = 0; k < all.features.rows(); ++k)
    if (k != i) rest.push_back(k);
  return {all.features(rest, Eigen::all), all.loads(rest, Eigen::all), all.gram(rest, rest)};
}

}  // namespace

TEST(KernelRegression, ClosedFormsAreThoseOfCasesReallyLeftOut) {
  const int n = 12, d = 2;
  const Problem p = random_problem(n, d, 2, 1);
  for (const Covariance& covariance : covariances(d)) {
    const KernelRegression all(p.cases, covariance);
    double sum = 0;
    for (Eigen::Index i = 0; i < n; ++i) {
      const KernelRegression rest(without(p.cases, i), covariance);
      const Eigen::VectorXd x = p.cases.features.row(i).transpose(), load = p.cases.loads.row(i).transpose();
      const Eigen::VectorXd weights = rest.weights(x.transpose(), load.transpose()).of_rows.col(0);
      Eigen::VectorXd residual = p.data.col(i);
      for (Eigen::Index k = 0, column = 0; k < n; ++k)
        if (k != i) residual -= weights[column++] * p.data.col(k);
      // Both invert matrices of condition 1e5 or so.
      EXPECT_LT((p.data * all.left_out().weights.col(i) - residual).norm(), 1e-9 * p.data.norm())
          << covariance.name;
      EXPECT_NEAR(all.left_out().deviations[i] / rest.weights(x.transpose(), load.transpose()).deviations[0],
                  1, 1e-9)
          << covariance.name;
      sum += residual.squaredNorm() / p.data.col(i).squaredNorm();
    }
    EXPECT_NEAR(all.left_out_error(), std::sqrt(sum / n), 1e-9 * std::sqrt(sum / n));
  }
}

TEST(KernelRegression, SlopesAreDerivativesOfTheCovariance) {
  const Problem p = random_problem(2, 3, 1, 5), ways = random_problem(2, 3, 1, 6);
  const Eigen::VectorXd x = p.cases.features.row(0).transpose(), y = p.cases.features.row(1).transpose(),
                        dx = ways.cases.features.row(0).transpose(),
                        dy = ways.cases.features.row(1).transpose();
  constexpr double h = 1e-4;  // second differences are off by h^2 and by rounding over h^2: 1e-8
  for (const Covariance& k : covariances(3)) {
    const auto at = [&](double s, double t) {
      return k(Eigen::VectorXd(x + s * dx), Eigen::VectorXd(y + t * dy));
    };
    const Covariance::Jets jet = k.along_rows(x.transpose(), dx.transpose(), y, dy);
    EXPECT_DOUBLE_EQ(jet.value[0], at(0, 0)) << k.name;
    EXPECT_NEAR(jet.by_x[0], (at(h, 0) - at(-h, 0)) / (2 * h), 1e-6) << k.name;
    EXPECT_NEAR(jet.by_y[0], (at(0, h) - at(0, -h)) / (2 * h), 1e-6) << k.name;
    EXPECT_NEAR(jet.by_both[0], (at(h, h) - at(h, -h) - at(-h, h) + at(-h, -h)) / (4 * h * h), 1e-5)
        << k.name;
  }
}

TEST(KernelRegression, ACaseLeftOutTakesItsSlopesWithIt) {
  const int n = 9, d = 2, q = 12;
  Problem p = random_problem(n, d, 2, 7);
  const Problem ways = random_problem(q, d, 2, 8);
  p.cases.slopes = {{}, ways.cases.features, ways.cases.loads};
  for (int s = 0; s < q; ++s) p.cases.slopes.of.push_back(s % 7);  // some cases have two, some none
  Eigen::MatrixXd data(7, n + q);
  data << p.data, ways.data;
  p.cases.gram = data.transpose() * data;
  for (const Covariance& covariance : covariances(d)) {
    const KernelRegression all(p.cases, covariance);
    for (Eigen::Index i = 0; i < n; ++i) {
      TrainingCases rest = without(p.cases, i);
      std::vector<Eigen::Index> kept, columns;
      for (Eigen::Index k = 0; k < n; ++k)
        if (k != i) columns.push_back(k);
      for (Eigen::Index s = 0; s < q; ++s)
        if (const Eigen::Index of = p.cases.slopes.of[s]; of != i)
          kept.push_back(s), columns.push_back(n + s), rest.slopes.of.push_back(of - (of > i ? 1 : 0));
      rest.slopes.features = p.cases.slopes.features(kept, Eigen::all);
      rest.slopes.loads = p.cases.slopes.loads(kept, Eigen::all);
      rest.gram = p.cases.gram(columns, columns);
      const KernelRegression others(rest, covariance);
      const Eigen::VectorXd x = p.cases.features.row(i).transpose(), load = p.cases.loads.row(i).transpose();
      const Eigen::VectorXd residual =
          data.col(i) -
          data(Eigen::all, columns) * others.weights(x.transpose(), load.transpose()).of_rows.col(0);
      EXPECT_LT((data * all.left_out().weights.col(i) - residual).norm(), 1e-8 * data.norm())
          << covariance.name;
      EXPECT_NEAR(
          all.left_out().deviations[i] / others.weights(x.transpose(), load.transpose()).deviations[0], 1,
          1e-8)
          << covariance.name;
    }
  }
}

TEST(KernelRegression, WithSlopesFewCasesDoForMany) {
  // exp(x) q from three cases and their slopes: a polynomial through such data is off by at most
  // (x (x - 1) (x + 1))^2 e / 720 (Hermite's remainder), 6e-4; through the values alone by 0.17.
  const auto problem = [](int n, bool slopes) {
    Problem p;
    p.cases.features.resize(n, 1), p.cases.loads = Eigen::MatrixXd::Ones(n, 1), p.data.resize(1, n);
    for (int i = 0; i < n; ++i)
      p.cases.features(i, 0) = -1 + 2. * i / (n - 1), p.data(0, i) = std::exp(p.cases.features(i, 0));
    if (slopes) {
      for (int i = 0; i < n; ++i) p.cases.slopes.of.push_back(i);
      p.cases.slopes.features = Eigen::MatrixXd::Ones(n, 1),
      p.cases.slopes.loads = Eigen::MatrixXd::Zero(n, 1);
      p.data.conservativeResize(1, 2 * n);
      p.data.rightCols(n) = p.data.leftCols(n);
    }
    p.cases.gram = p.data.transpose() * p.data;
    return p;
  };
  const auto error = [](const Problem& p) {
    const KernelRegression smooth(
        p.cases, {"", 1, Correlation::gaussian, 100, 1e-9, Eigen::VectorXd::Constant(1, 3), 1e-9});
    double worst = 0;
    for (double x = -1; x <= 1; x += 0.05) {
      const Eigen::VectorXd at = Eigen::VectorXd::Constant(1, x);
      worst = std::max(
          worst,
          std::abs((p.data * smooth.weights(at.transpose(), Eigen::MatrixXd::Ones(1, 1)).of_rows.col(0))(0) -
                   std::exp(x)));
    }
    return worst;
  };
  EXPECT_LT(error(problem(3, true)), error(problem(3, false)) / 10);
  EXPECT_LT(error(problem(3, true)), error(problem(5, false)));
}

TEST(KernelRegression, PolynomialsAreReproduced) {
  // Data that are quadratic in three features and linear in two loads, at more cases than that has numbers.
  const int n = 40;
  Problem p = random_problem(n, 3, 2, 2);
  const auto truth = [](const Eigen::VectorXd& x, const Eigen::VectorXd& q) {
    return Eigen::Vector2d(q[0] * (1 + x[0] - 2 * x[1] * x[2]) + q[1] * x[2] * x[2],
                           q[1] * (x[0] * x[1] - 3));
  };
  p.data.resize(2, n);
  for (Eigen::Index i = 0; i < n; ++i)
    p.data.col(i) = truth(p.cases.features.row(i).transpose(), p.cases.loads.row(i).transpose());
  p.cases.gram = p.data.transpose() * p.data;
  const KernelRegression quadratic(p.cases, {"", 2, Correlation::none, 1, 1e-9, Eigen::VectorXd::Ones(3)});
  const Eigen::Vector3d x(0.3, -0.9, 0.8);
  const Eigen::Vector2d q(0.5, -0.7);
  // The nugget of 1e-9 over the least eigenvalue of the features' products, above 1e-2 here.
  EXPECT_LT((p.data * quadratic.weights(x.transpose(), q.transpose()).of_rows.col(0) - truth(x, q)).norm(),
            1e-6);
  EXPECT_LT(quadratic.left_out_error(), 1e-6);
  const KernelRegression linear(p.cases, {"", 1, Correlation::none, 1, 1e-9, Eigen::VectorXd::Ones(3)});
  EXPECT_GT(linear.left_out_error(), 0.05);
}

TEST(KernelRegression, RadialFunctionsPassThroughTheCases) {
  // But for the nugget: (K - nugget) K^-1 Y is Y less nugget K^-1 Y.
  const Problem p = random_problem(15, 3, 1, 3);
  const Covariance covariance{"", 1, Correlation::matern, 100, 1e-9, Eigen::VectorXd::Ones(3)};
  const KernelRegression regression(p.cases, covariance);
  const double nugget = covariance.nugget * 101;
  for (Eigen::Index i = 0; i < 15; ++i) {
    const Eigen::VectorXd x = p.cases.features.row(i).transpose(), load = p.cases.loads.row(i).transpose();
    const double variance = std::pow(regression.left_out().deviations[i], 2);
    const Eigen::VectorXd rest = nugget / variance * (p.data * regression.left_out().weights.col(i));
    EXPECT_LT(
        (p.data.col(i) - p.data * regression.weights(x.transpose(), load.transpose()).of_rows.col(0) - rest)
            .norm(),
        1e-9);
    EXPECT_LT(regression.weights(x.transpose(), load.transpose()).deviations[0], 1e-3);
  }
}

TEST(KernelRegression, SquaresAreLeftOutWhereCasesLieOnTwoLines) {
  // Two moduli and three lengths, in features of both; and a modulus between.
  for (const int count : {6, 7}) {
    Problem p = random_problem(count, 2, 1, 4);
    for (int i = 0; i < count; ++i) {
      const double modulus = i == 6 ? 0 : i % 2 ? 1 : -1, length = i == 6 ? 0 : i / 2 - 1;
      p.cases.features.row(i) << (modulus + length) / 2, (modulus - length) / 2;
    }
    bool squares = false;
    for (const KernelRegression& method : all_methods(p.cases)) squares |= method.covariance().degree > 1;
    EXPECT_EQ(squares, count == 7);
    // Of the same everywhere, a quadratic trend has less left between the lines: squares took their part.
    p.cases.features.conservativeResize(6, 2), p.cases.loads = Eigen::MatrixXd::Ones(6, 1);
    p.cases.gram = Eigen::MatrixXd::Ones(6, 6);
    const auto of_the_same = [&](int degree) {
      const Covariance trend{"", degree, Covariance::Correlation::none, 1, 1e-9, Eigen::VectorXd::Ones(2)};
      return KernelRegression(p.cases, trend)
          .weights(Eigen::MatrixXd::Zero(1, 2), Eigen::MatrixXd::Ones(1, 1))
          .of_rows.sum();
    };
    EXPECT_NEAR(of_the_same(1), 1, 1e-6);
    EXPECT_LT(of_the_same(2), 0.8);
  }
}

/// Sums of waves whose numbers are normally distributed: a process with a Gaussian covariance of these
/// lengths.
TEST(KernelRegression, LengthsAreThoseFromWhichDataWereDrawn) {
  const Eigen::Vector3d lengths(8, 1.4, 1);
  double wrong = 0, count = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Problem p = random_problem(36, 3, 1, seed);
    p.cases.loads.setOnes();
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> phase(0, 2 * std::numbers::pi);
    p.data.setZero(1, 36);
    for (int wave = 0; wave < 100; ++wave) {
      Eigen::Vector3d number;
      for (int k = 0; k < 3; ++k) number[k] = normal(random) / lengths[k];
      const double begin = phase(random);
      for (Eigen::Index i = 0; i < p.data.cols(); ++i)
        p.data(0, i) += std::cos(p.cases.features.row(i).dot(number) + begin);
    }
    p.cases.gram = p.data.transpose() * p.data;
    for (const KernelRegression& method : all_methods(p.cases)) {
      if (method.covariance().name != "Gaussian process") continue;
      const Eigen::VectorXd& found = method.covariance().lengths;
      for (int k = 1; k < 3; ++k) wrong += std::abs(std::log(found[k] / lengths[k])), ++count;
    }
  }
  EXPECT_LT(wrong / count, 0.215);  // 0.24 by left_out_error() alone
}

TEST(KernelRegression, TuningMakesNoMethodWorse) {
  const Problem p = random_problem(20, 2, 1, 4);
  for (const KernelRegression& method : all_methods(p.cases)) {
    EXPECT_TRUE(std::isfinite(method.left_out_error()));
    if (method.covariance().correlation == Correlation::matern) {
      EXPECT_LE(method.left_out_error(), KernelRegression(p.cases, {"", 1, Correlation::matern, 100, 1e-9,
                                                                    Eigen::VectorXd::Constant(2, 2)})
                                             .left_out_error());
    }
  }
}

/// Places of a sparse grid of four features, or fewer: five values of each alone, and the corners of each
/// two. Data are of what no polynomial of the second degree tells, with noise as fits have it.
class SparseGrid {
 public:
  explicit SparseGrid(double noise, int count = 4) {
    std::vector<Eigen::Vector4d> places = {Eigen::Vector4d::Zero()};
    const double inner = std::numbers::sqrt2 / 2;
    for (int a = 0; a < count; ++a) {
      for (const double x : {-1., -inner, inner, 1.}) places.push_back(x * Eigen::Vector4d::Unit(a));
      for (int b = 0; b < a; ++b)
        for (const double x : {-1., 1.})
          for (const double y : {-1., 1.})
            places.push_back(x * Eigen::Vector4d::Unit(a) + y * Eigen::Vector4d::Unit(b));
    }
    std::mt19937 random(1);
    std::normal_distribution<double> distribution(0, 1);
    const auto n = static_cast<Eigen::Index>(places.size());
    problem = {{Eigen::MatrixXd(n, count), Eigen::MatrixXd::Ones(n, 1), {}}, Eigen::MatrixXd(rows, n)};
    noises.resize(rows, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      problem.cases.features.row(i) = places[i].head(count);
      for (Eigen::Index k = 0; k < rows; ++k) {
        noises(k, i) = noise * distribution(random);
        problem.data(k, i) = value(places[i]) + noises(k, i);
      }
    }
    problem.cases.gram = problem.data.transpose() * problem.data;
  }

  /// Root mean square between the cases, of what the noise contributes, and of the error.
  double noise_between(const KernelRegression& method) const {
    return between([&](const Eigen::Vector4d&,
                       const Eigen::VectorXd& weights) { return (noises * weights).squaredNorm() / rows; },
                   method);
  }
  double error_between(const KernelRegression& method) const {
    return between(
        [&](const Eigen::Vector4d& x, const Eigen::VectorXd& weights) {
          return ((problem.data * weights).array() - value(x)).square().sum() / rows;
        },
        method);
  }
  /// At the cases, the largest distance of the prediction from the data.
  double off_cases(const KernelRegression& method) const {
    const Eigen::MatrixXd weights = method.weights(problem.cases.features, problem.cases.loads).of_rows;
    return (problem.data * weights - problem.data).cwiseAbs().maxCoeff();
  }

  static constexpr Eigen::Index rows = 40;  // values with the same course and other noise
  Problem problem;
  Eigen::MatrixXd noises;

 private:
  static double value(const Eigen::Vector4d& x) {
    return std::exp(0.4 * x[0] + 0.3 * x[1]) / (1 + 0.3 * x[2] * x[2]) + 0.2 * std::cos(x[3]);
  }
  template <class Square>
  static double between(const Square& square, const KernelRegression& method) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> place(-1, 1);
    double sum = 0;
    for (int i = 0; i < 200; ++i) {
      Eigen::Vector4d at;
      for (double& x : at) x = place(random);
      sum += square(at, method.weights(at.transpose(), Eigen::RowVectorXd::Ones(1)).of_rows.col(0));
    }
    return std::sqrt(sum / 200);
  }
};

KernelRegression process_of(const TrainingCases& cases) {
  std::optional<KernelRegression> process;
  for (KernelRegression& method : all_methods(cases))
    if (method.covariance().name == "Gaussian process") process.emplace(std::move(method));
  return process.value();
}

/// A process with long lengths that passes through the cases multiplies their noise.
TEST(KernelRegression, OnASparseGridAProcessDoesNotMultiplyTheNoiseOfTheCases) {
  const SparseGrid grid(0.01);
  const KernelRegression through(grid.problem.cases,
                                 {"through the cases", 2, Covariance::Correlation::gaussian, 100, 1e-9,
                                  Eigen::VectorXd::Constant(4, 2.)});
  EXPECT_GT(grid.noise_between(through), 0.018);
  EXPECT_LT(grid.noise_between(process_of(grid.problem.cases)), 0.012);
}

/// Cases that are fitted alike have no noise: a case left out leaves the end of an axis, or a corner, to what
/// is beyond, and the nuggets and lengths with which that errs least miss the cases themselves.
TEST(KernelRegression, OnASparseGridAProcessPassesThroughCasesThatAreFittedAlike) {
  SparseGrid grid(0);
  const KernelRegression tuned = process_of(grid.problem.cases);
  grid.problem.cases.fitted_alike = true;
  const KernelRegression through = process_of(grid.problem.cases);
  EXPECT_LT(grid.off_cases(through), 1e-3);
  EXPECT_GT(grid.off_cases(tuned), 10 * grid.off_cases(through));
  EXPECT_LT(grid.error_between(through), grid.error_between(tuned));
}

/// Of two features too, as those of a family that are varied alone with one another.
TEST(KernelRegression, ASparseGridOfTwoFeaturesIsOne) {
  SparseGrid grid(0, 2);
  ASSERT_EQ(grid.problem.cases.features.rows(), 13);
  grid.problem.cases.fitted_alike = true;
  EXPECT_EQ(all_methods(grid.problem.cases).size(), 1u);
  EXPECT_LT(grid.off_cases(process_of(grid.problem.cases)), 1e-3);
}

/// Nor are scattered cases a sparse grid because one feature takes two values in them.
TEST(KernelRegression, CasesThatAreFittedAlikeHaveAllMethodsElsewhere) {
  Problem p = random_problem(30, 4, 1, 4);
  p.cases.fitted_alike = true;
  EXPECT_GT(all_methods(p.cases).size(), 2u);
  for (Eigen::Index i = 0; i < 30; ++i) p.cases.features(i, 3) = i % 2 == 0 ? -1 : 1;
  EXPECT_GT(all_methods(p.cases).size(), 2u);
}

}  // namespace cleft
