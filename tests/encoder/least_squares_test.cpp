// The fit of all frames against the same least squares written out as dense matrices.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

#include "encoder/field/unknowns.h"
#include "encoder/series_fit.h"
#include "encoder/series_system.h"
#include "tests/encoder/synthetic_snapshot.h"

namespace cleft {

namespace {

/// All frames and nodes as one system over the unknowns of every control point in t but the first.
struct Joint {
  Eigen::MatrixXd data, roughness;  ///< B^T B and what regularises it, both n T x n T
  Eigen::MatrixXd right;            ///< B^T d
  double total = 0;                 ///< |d|^2

  Joint(const Series& series, const Parametrization& parametrization,
        const std::array<BSplineBasis, 4>& bases, const ControlTies& ties, double strength) {
    const std::array<BSplineBasis, 3> space{bases[0], bases[1], bases[2]};
    const SpaceFit fit(parametrization, space, series.samples);
    const int n = ties.size(), T = bases[3].size() - 1, W = bases[2].size();
    Eigen::MatrixXd in_t = Eigen::MatrixXd::Zero(T, T), mean = Eigen::MatrixXd::Zero(n, n);
    const bool tied = n < bases[0].size() * bases[1].size() * W;
    data = roughness = Eigen::MatrixXd::Zero(n * T, n * T), right = Eigen::MatrixXd::Zero(n * T, 3);
    const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(n, n);
    for (std::size_t j = 1; j < series.times.size(); ++j) {
      const double t = series.times[j];
      const auto bt = bases[3].evaluate(parametrization.time(t).value);
      // A row for every sample and side it speaks for; uncut tissue on the plane speaks for both sides, but
      // where they are tied they are one.
      Eigen::MatrixXd b = Eigen::MatrixXd::Zero(2 * series.samples.size(), n),
                      d = Eigen::MatrixXd::Zero(b.rows(), 3);
      Eigen::Index row = 0;
      for (std::size_t s = 0; s < series.samples.size(); ++s)
        for (const Side side : {Side::left, Side::right}) {
          const Sample& sample = series.samples[s];
          if (sample.side != side && (sample.side != Side::both || (tied && side == Side::left))) continue;
          const auto bu = bases[0].evaluate(parametrization.along(sample.uvw.x, t).value),
                     bv = bases[1].evaluate(parametrization.across(sample.uvw.y).value,
                                            side == Side::left ? Limit::from_left : Limit::from_right),
                     bw = bases[2].evaluate(parametrization.height(sample.uvw.z).value);
          for (int i = 0; i < 4; ++i)
            for (int k = 0; k < 16; ++k) {
              const ControlTies::Control& control =
                  ties.row(bu.first + i)[(bv.first + k / 4) * W + bw.first + k % 4];
              for (int term = 0; term < control.terms; ++term)
                b(row, ties.first(bu.first + i) + control.term[term].unknown) +=
                    control.term[term].weight * bu.value[i] * bv.value[k / 4] * bw.value[k % 4];
            }
          d.row(row++) = series.frames[j].row(static_cast<Eigen::Index>(s));
        }
      const Eigen::MatrixXd normal = b.transpose() * b, projected = b.transpose() * d;
      const Eigen::MatrixXd rough = fit.multiply(fit.normal(t, strength), identity) - normal;
      mean += (normal + rough) / static_cast<double>(series.times.size() - 1);
      for (int k = 0; k <= bases[3].degree(); ++k)
        for (int l = 0; l <= bases[3].degree(); ++l)
          if (const int row_t = bt.first + k - 1, column_t = bt.first + l - 1; row_t >= 0 && column_t >= 0) {
            in_t(row_t, column_t) += bt.value[k] * bt.value[l];
            data.block(row_t * n, column_t * n, n, n) += bt.value[k] * bt.value[l] * normal;
            roughness.block(row_t * n, column_t * n, n, n) += bt.value[k] * bt.value[l] * rough;
          }
      for (int k = 0; k <= bases[3].degree(); ++k)
        if (const int row_t = bt.first + k - 1; row_t >= 0)
          right.middleRows(row_t * n, n) += bt.value[k] * projected;
      total += d.squaredNorm();
    }
    // Second differences in t, of which the first begins with the 0 at t = 0.
    Eigen::MatrixXd differences = Eigen::MatrixXd::Zero(T - 1, T);
    for (int i = 0; i + 1 < T; ++i) {
      if (i > 0) differences(i, i - 1) = 1;
      differences(i, i) = -2, differences(i, i + 1) = 1;
    }
    const Eigen::MatrixXd hold =
        time_roughness * in_t.diagonal().mean() * differences.transpose() * differences;
    for (int k = 0; k < T; ++k)
      for (int l = 0; l < T; ++l) roughness.block(k * n, l * n, n, n) += hold(k, l) * mean;
  }

  /// |B c - d|^2 = |d|^2 + c.(B^T B c - 2 B^T d), and with the roughness.
  double data_cost(const Eigen::MatrixXd& c) const {
    return total + c.cwiseProduct(data * c - 2 * right).sum();
  }
  double cost(const Eigen::MatrixXd& c) const { return data_cost(c) + c.cwiseProduct(roughness * c).sum(); }
};

/// T x 3 n to n T x 3.
Eigen::MatrixXd stacked(const Eigen::MatrixXd& control_points) {
  const Eigen::Index T = control_points.rows(), n = control_points.cols() / 3;
  Eigen::MatrixXd x(n * T, 3);
  for (Eigen::Index l = 0; l < T; ++l) x.middleRows(l * n, n) = control_points.row(l).reshaped(n, 3);
  return x;
}

Vec3 contradicting(const Vec3& p, Side side, double t) {
  return Vec3{std::sin(p.x + t), sign_of(p, side) * std::min(t, 3.0), std::cos(p.y * p.z) * t} -
         Vec3{std::sin(p.x), 0, t};
}

constexpr Rung small{1, 1, 1, 1, 1, 1, 2};

}  // namespace

TEST(LeastSquares, EqualsTheJointFourDimensionalOne) {
  for (const char* name : {"fixed", "tip"}) {
    SCOPED_TRACE(name);
    const SyntheticSnapshot data(std::string(name) == "tip" ? opening : contradicting);
    const Series series = data.series();
    const auto parametrization = make_parametrization(name, series.geometry);
    const auto bases = bases_of(small, *parametrization, 8);
    const SeriesFit fit(series, parametrization, bases);
    EXPECT_EQ(fit.ties().size() < bases[0].size() * bases[1].size() * bases[2].size(),
              std::string(name) == "tip");
    const Joint joint(series, *parametrization, bases, fit.ties(), fit.strength());
    const Eigen::MatrixXd all = joint.data + joint.roughness;
    const Eigen::MatrixXd best = all.ldlt().solve(joint.right), found = stacked(fit.control_points());
    EXPECT_GT(joint.cost(best), 1e-3 * joint.total) << "a perfect fit proves nothing";
    // Where the parametrisation moves, conjugate gradients stop at a residual of 1e-6 of the right-hand side.
    const Eigen::MatrixXd residual = joint.right - all * found;
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_LE(residual.col(axis).norm(), 1.1e-6 * joint.right.col(axis).norm());
    EXPECT_GE(joint.cost(found) / joint.cost(best), 1 - 1e-9);
    EXPECT_LE(joint.cost(found) / joint.cost(best), 1 + 1e-7);
    // Regularisation costs the data 5 % at most.
    const Eigen::MatrixXd free = (joint.data + 1e-4 * joint.roughness).ldlt().solve(joint.right);
    EXPECT_LT(std::sqrt(joint.data_cost(found) / joint.data_cost(free)), 1.05);
  }
}

TEST(LeastSquares, KeepsABoundAtAllNodesForLittleMore) {
  const SyntheticSnapshot data(opening);
  const Series series = data.series();
  const auto parametrization = make_parametrization("tip", series.geometry);
  const auto bases = bases_of(small, *parametrization, 8);
  SeriesFit fit(series, parametrization, bases);
  const Joint joint(series, *parametrization, bases, fit.ties(), fit.strength());
  const double least = joint.data_cost(stacked(fit.control_points())), off = fit.misfit(0).largest;
  // Within reach: nothing moves.
  const Eigen::MatrixXd before = fit.control_points();
  fit.keep(1.01 * off);
  EXPECT_EQ(fit.control_points(), before);
  fit.keep(0.8 * off);
  EXPECT_LT(fit.misfit(0).largest, 0.85 * off);
  EXPECT_LT(joint.data_cost(stacked(fit.control_points())), 1.1 * least);
}

/// Few nodes in the hole of a cloud, and few frames for each control point in t: what a fit says there comes
/// late in the iterations.
TEST(LeastSquares, ConvergesSoonWhereLittleIsKnown) {
  std::vector<Vec3> points;
  for (const Vec3& p : grid(24, 20, 5))
    if (std::hypot(p.x - 2, p.y - 2) > 1.2) points.push_back(p);
  const Series series = SyntheticSnapshot(cut_in(points, eight_times), opening).series();
  const auto parametrization = make_parametrization("tip", series.geometry);
  const SeriesFit fit(series, parametrization, bases_of({2, 12, 2, 7, 2, 2, 4}, *parametrization, 8));
  EXPECT_LT(fit.iterations(), 150);
}

/// Where no data reach, the roughness carries straight lines on: data on one half, a linear motion over all.
TEST(LeastSquares, ContinuesAStraightLineWhereThereAreNoData) {
  const auto line = [](const Vec3& p, Side, double t) {
    return t / 8 * Vec3{1 + p.x, 2 * p.y - p.x, p.z + p.y};
  };
  std::vector<Vec3> points;
  for (const Vec3& p : grid(24, 19, 5))
    if (p.x <= 0) points.push_back(p);
  const Series half = SyntheticSnapshot(cut_in(points, eight_times), line).series();
  FieldGeometry whole = half.geometry;
  whole.domain[0] = {-6, 6};
  const auto parametrization = make_parametrization("fixed", whole);
  const SeriesFit fit(half, parametrization,
                      bases_of({.along = 7, .across = 2, .above = 3}, *parametrization, 8));
  const Field field = fit.field(fit.control_points());
  const Vec3 far{5, 2, -1};
  // The diagonal's strength, 1e-11, against the roughness's, 1e-6, over the 6 mm of about 4 control points
  // without data.
  EXPECT_LT(norm(field.displacement(far, Side::both, 8) - line(far, Side::both, 8)),
            0.05 * norm(line(far, Side::both, 8)));
}

/// What nodes leave free must not jump from case to case of a study: with one strength for all of them
/// control points are a linear function of the data. Left to each of these two, it is not the same.
TEST(LeastSquares, WithAGivenStrengthFitsSuperpose) {
  const auto smooth = [](const Vec3& p, Side, double t) { return t / 8 * Vec3{0, p.x * p.x / 36, 0}; };
  const auto rough = [](const Vec3& p, Side side, double t) {
    return t / 8 * Vec3{std::sin(3 * p.x + p.y), side == Side::left ? 1. : -1., 0};
  };
  const auto both = [&](const Vec3& p, Side side, double t) {
    return smooth(p, side, t) + rough(p, side, t);
  };
  const std::vector<Vec3> points = grid(24, 8, 5);
  struct Fitted {
    Eigen::MatrixXd points;
    double strength;
  };
  const auto fitted = [&](const auto& function, std::optional<double> strength) {
    const Series series = SyntheticSnapshot(cut_in(points, eight_times), function).series();
    const auto parametrization = make_parametrization("fixed", series.geometry);
    const SeriesFit fit(series, parametrization, bases_of(small, *parametrization, 8), SeriesFit::Start::zero,
                        strength);
    return Fitted{fit.control_points(), fit.strength()};
  };
  const auto off = [&](std::optional<double> strength) {
    const Eigen::MatrixXd sum = fitted(both, strength).points;
    return (fitted(smooth, strength).points + fitted(rough, strength).points - sum).norm() / sum.norm();
  };
  EXPECT_EQ(fitted(rough, 3e-5).strength, 3e-5);
  EXPECT_LT(off(3e-5), 1e-9);
  ASSERT_NE(fitted(smooth, {}).strength, fitted(rough, {}).strength);
  EXPECT_GT(off({}), 1e-6);
}

// A spline that lies in the space comes back to rounding: at its nodes, and, where those determine it,
// between them.
TEST(LeastSquares, ReproducesASplineOfTheSpace) {
  for (const char* name : {"fixed", "tip"}) {
    SCOPED_TRACE(name);
    // Nodes that determine every control point, also while the tip is near the start.
    const bool moves = std::string(name) == "tip";
    const std::vector<Vec3> all = moves ? grid(72, 20, 10) : grid();
    const Series closed = SyntheticSnapshot(cut_in(all, eight_times), [](const Vec3&, Side, double) {
                            return Vec3{};
                          }).series();
    const auto parametrization = make_parametrization(name, closed.geometry);
    const auto bases = bases_of(small, *parametrization, 8);
    const ControlTies ties = ties_of(name, bases);
    std::vector<std::int64_t> values(static_cast<std::size_t>(3 * (bases[3].size() - 1) * ties.size()));
    std::mt19937 random(1);
    for (std::int64_t& value : values) value = std::uniform_int_distribution<int>(-1000, 1000)(random);
    const Field truth(parametrization, bases, control_points(ties, bases, multiples(values, 1e-3)));
    std::vector<Vec3> points;  // ties or none, left and right agree on single nodes of v = 0
    for (const Vec3& p : all)
      if (moves || p.y != 0 || (std::abs(p.x) < 4 && p.z > -1.5)) points.push_back(p);
    const SyntheticSnapshot data(cut_in(points, eight_times), [&](const Vec3& p, Side side, double t) {
      return truth.displacement(p, side, t);
    });
    const Series series = data.series();
    const SeriesFit fit(series, parametrization, bases);
    EXPECT_LT(fit.misfit(0).largest, 1e-12 * series.largest_displacement);
    const Field field = fit.field(fit.control_points());
    double worst = 0;
    for (int n = 0; n < 2000; ++n) {
      const auto in = [&](int axis) {
        const auto [front, back] = field.domain(axis);
        return std::uniform_real_distribution<double>(front, back)(random);
      };
      const Vec3 p{in(0), in(1), in(2)};
      const double t = in(3);
      worst = std::max(worst,
                       norm(field.displacement(p, side_of(p.y), t) - truth.displacement(p, side_of(p.y), t)));
    }
    EXPECT_LT(worst, 1e-12 * series.largest_displacement);
  }
}

}  // namespace cleft
