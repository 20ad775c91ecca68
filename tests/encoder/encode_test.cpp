#include "encoder/encode.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <functional>
#include <optional>

#include "base/error.h"
#include "encoder/samples.h"
#include "tests/support/temporary_folder.h"

namespace cleft {

namespace {

/// A grid of nodes with a cut over half of the plane v = 0, and displacements of our choice.
class SyntheticSnapshot {
 public:
  using Motion = std::function<Vec3(const Vec3& p, Side side, double t)>;

  SyntheticSnapshot(const std::vector<double>& times, const Motion& motion) {
    s_.times = times;
    for (int i = 0; i <= 12; ++i)
      for (int j = 0; j <= 10; ++j)
        for (int k = 0; k <= 5; ++k) s_.points.push_back({i - 6.0, j - 5.0, k / 2.0 - 2.5});
    const std::size_t single = s_.points.size();
    for (std::size_t n = 0; n < single; ++n)
      if (const Vec3 p = s_.points[n]; p.y == 0 && std::abs(p.x) < 4 && p.z > -1.5) {
        s_.pairs.push_back({static_cast<int>(n), static_cast<int>(s_.points.size())});
        s_.points.push_back(p);
      }
    s_.cell_offsets = {0};
    s_.released.assign(times.size(), static_cast<int>(s_.pairs.size()));
    s_.released[0] = 0;
    s_.position = s_.smallest_gap = s_.residual_equilibrium = s_.residual_closure = times;
    for (std::size_t j = 1; j < times.size(); ++j)
      s_.released[j] = static_cast<int>(s_.pairs.size() * j / (times.size() - 1));
    s_.cut_start = -4, s_.cut_length = 8, s_.cut_depth = 1.5;
    s_.case_hash = "0123456789abcdef";
    s_.parameters = {{"skin.thickness", 1.5}, {"cut.frames", "column"}};
    SnapshotWriter writer(folder_ / "case.h5", s_);
    const std::vector<Sample> samples = samples_of(s_);
    for (std::size_t j = 0; j < times.size(); ++j) {
      std::vector<Vec3> d;
      for (const Sample& sample : samples) d.push_back(motion(sample.uvw, sample.side, times[j]));
      writer.write_frames(j, d);
    }
    writer.finish(s_);
    reader_.emplace(folder_ / "case.h5");
  }

  const SnapshotReader& reader() const { return *reader_; }

 private:
  TemporaryFolder folder_;
  Snapshot s_;
  std::optional<SnapshotReader> reader_;
};

const auto silent = [](const std::string&) {};
const std::vector<double> times = {0, 2, 3, 4, 5, 6, 7, 8};

/// Side of a motion: left and right differ where the tissue is cut, by terms that vanish on the cut's rim.
double sign_of(const Vec3& p, Side side) {
  return side == Side::left || p.y < 0 ? -1 : side == Side::right || p.y > 0 ? 1 : 0;
}

Vec3 cubic(const Vec3& p, double t) {
  return {t * (1 + p.x * p.y * p.z / 50), t * t * (p.x - p.y * p.y * p.y / 90),
          t * t * t * (p.z * p.z - p.x * p.x * p.y) / 300};
}

}  // namespace

// Cubics are in the space, and second differences over Greville points leave straight lines alone, not
// cubics: the error is bounded by the roughness's strength, 1e-7, times the size of second differences over
// the data, below 10.
TEST(Encode, ReproducesACubic) {
  const SyntheticSnapshot data(times, [](const Vec3& p, Side, double t) { return cubic(p, t); });
  const Field field = encode(data.reader(), {{8, 10, 6, 5}}, silent);
  EXPECT_LT(field.report.node_error, 1e-6);
  EXPECT_LT(field.report.false_gap, 1e-6);
}

TEST(Encode, KeepsAJumpAcrossTheCutSharp) {
  // Frame 0 is closed; then the sides move apart by a polynomial of their own. Uncut plane nodes are given
  // the mean, 0.
  const SyntheticSnapshot data(times, [](const Vec3& p, Side side, double t) {
    return Vec3{0, sign_of(p, side) * t * (1 + p.x * p.x / 40), 0};
  });
  const Field field = encode(data.reader(), {{8, 10, 6, 5}}, silent);
  // Away from the plane's uncut nodes, which contradict the jump, the two sides are fitted apart.
  const Vec3 left = field.displacement({0, -3, -0.2}, Side::both, 8),
             right = field.displacement({0, 3, -0.2}, Side::both, 8);
  EXPECT_NEAR(right.y - left.y, 16, 0.1);
  EXPECT_GT((field.displacement({0, 0, 0}, Side::right, 8) - field.displacement({0, 0, 0}, Side::left, 8)).y,
            8);
}

/// The same least-squares problem written as one dense system over all nodes and frames.
TEST(Encode, EqualsTheJointFourDimensionalLeastSquares) {
  const SyntheticSnapshot data(times, [](const Vec3& p, Side side, double t) {
    return Vec3{std::sin(p.x + t), sign_of(p, side) * std::min(t, 3.0), std::cos(p.y * p.z) * t} -
           Vec3{std::sin(p.x), 0, 0};
  });
  const Field field = encode(data.reader(), {{5, 8, 4, 4}}, silent);
  const std::vector<Sample> samples = samples_of(data.reader().snapshot());
  const int n = static_cast<int>(field.coefficients().size());
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(n, n);
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(n, 3);
  const auto closed = data.reader().displacement(0);
  double total = 0;
  for (std::size_t j = 0; j < times.size(); ++j) {
    const auto d = data.reader().displacement(j);
    for (std::size_t s = 0; s < samples.size(); ++s)
      for (const Limit limit : {Limit::from_left, Limit::from_right}) {
        const Side wanted = limit == Limit::from_left ? Side::left : Side::right;
        if (samples[s].side != wanted && samples[s].side != Side::both) continue;
        std::vector<std::pair<int, double>> row;
        const auto bu = field.basis(0).evaluate(samples[s].uvw.x),
                   bv = field.basis(1).evaluate(samples[s].uvw.y, limit);
        const auto bw = field.basis(2).evaluate(samples[s].uvw.z), bt = field.basis(3).evaluate(times[j]);
        for (int a = 0; a < 256; ++a) {
          const int i = a / 64, k = a / 16 % 4, l = a / 4 % 4, m = a % 4;
          const int at = (((bu.first + i) * field.basis(1).size() + bv.first + k) * field.basis(2).size() +
                          bw.first + l) *
                             field.basis(3).size() +
                         bt.first + m;
          row.emplace_back(at, bu.value[i] * bv.value[k] * bw.value[l] * bt.value[m]);
        }
        const Vec3 value = d[s] - closed[s];
        total += squared_norm(value);
        for (const auto& [a, x] : row) {
          for (const auto& [b, y] : row) normal(a, b) += x * y;
          right.row(a) += x * Eigen::RowVector3d(value.x, value.y, value.z);
        }
      }
  }
  // The cost |B c - d|^2 - |d|^2 = c.(N c - 2 r): the optimum of the joint system against the encoder's
  // answer.
  Eigen::MatrixXd found(n, 3);
  for (int i = 0; i < n; ++i)
    found.row(i) << field.coefficients()[i].x, field.coefficients()[i].y, field.coefficients()[i].z;
  const Eigen::MatrixXd joint = normal.completeOrthogonalDecomposition().solve(right);
  const auto cost = [&](const Eigen::MatrixXd& c) {
    return total + c.cwiseProduct(normal * c - 2 * right).sum();
  };
  // At an optimum the cost grows with the square of the roughness's strength, 1e-7, and of 32-bit storage.
  EXPECT_GT(cost(joint), 1e-3 * total) << "a perfect fit proves nothing";
  EXPECT_NEAR(cost(found) / cost(joint), 1, 1e-6);
}

TEST(Encode, ReportsTheErrorsOfBruteForce) {
  const SyntheticSnapshot data(times, [](const Vec3& p, Side side, double t) {
    return 7 * Vec3{std::sin(3 * p.x) * t, sign_of(p, side) * t, 0};
  });
  const Field field = encode(data.reader(), {{5, 8, 4, 4}}, silent);
  const Snapshot& s = data.reader().snapshot();
  const std::vector<Sample> samples = samples_of(s);
  double worst = 0, largest = 0, squared = 0, total = 0, gape = 0, gap = 0;
  for (std::size_t j = 0; j < times.size(); ++j) {
    const auto d = data.reader().displacement(j);
    const auto jump = [&](const Vec3& p) {
      return field.displacement(p, Side::right, times[j]) - field.displacement(p, Side::left, times[j]);
    };
    for (std::size_t n = 0; n < samples.size(); ++n) {
      const double error = norm(field.displacement(samples[n].uvw, samples[n].side, times[j]) - d[n]);
      worst = std::max(worst, error), largest = std::max(largest, norm(d[n]));
      squared += error * error, total += squared_norm(d[n]);
      if (samples[n].uvw.y == 0 && samples[n].side == Side::both)
        gap = std::max(gap, norm(jump(samples[n].uvw)));
    }
    for (std::size_t p = 0; p < s.pairs.size(); ++p) {
      const double error = norm(jump(s.points[s.pairs[p][0]]) - (d[s.pairs[p][1]] - d[s.pairs[p][0]]));
      double& kind = static_cast<int>(p) < s.released[j] ? gape : gap;
      kind = std::max(kind, error);
    }
  }
  EXPECT_NEAR(field.report.spline_error, worst / largest, 1e-12);
  EXPECT_NEAR(field.report.relative_l2, std::sqrt(squared / total), 1e-12);
  EXPECT_NEAR(field.report.largest_displacement, largest, 1e-12 * largest);
  EXPECT_NEAR(field.report.gape_error, gape / largest, 1e-12);
  EXPECT_NEAR(field.report.false_gap, gap / largest, 1e-12);
  EXPECT_GT(field.report.gape_error, 0.01);
  EXPECT_GT(field.report.false_gap, 0.01);
}

TEST(Encode, CarriesTheCaseAndStoresWhatItMeasures) {
  const SyntheticSnapshot data(times, [](const Vec3& p, Side, double t) { return cubic(p, t); });
  const Field field = encode(data.reader(), {{8, 10, 6, 5}}, silent);
  EXPECT_EQ(field.case_hash, "0123456789abcdef");
  EXPECT_EQ(field.parameters, (std::map<std::string, double>{{"skin.thickness", 1.5}}));
  EXPECT_EQ(field.cut().start, -4);
  EXPECT_EQ(field.cut().length, 8);
  EXPECT_EQ(field.cut().depth, 1.5);
  for (const Vec3& c : field.coefficients())
    for (int i = 0; i < 3; ++i)
      ASSERT_EQ(c[i], static_cast<double>(static_cast<float>(c[i]))) << "measured before rounding";
}

TEST(Encode, SidesOfDoubledNodesComeFromThePairs) {
  const SyntheticSnapshot data(times, [](const Vec3&, Side, double) { return Vec3{}; });
  const std::vector<Sample> samples = samples_of(data.reader().snapshot());
  for (const auto& [left, right] : data.reader().snapshot().pairs) {
    EXPECT_EQ(samples[left].side, Side::left);
    EXPECT_EQ(samples[right].side, Side::right);
  }
}

/// Where no data reach, the roughness carries straight lines on: data on one half, a linear motion over all
/// of it.
TEST(SpatialFit, ContinuesAStraightLineWhereThereAreNoData) {
  const std::array<BSplineBasis, 3> bases = {BSplineBasis::uniform(3, 10, -6, 6),
                                             BSplineBasis::broken(3, 11, -5, 0, 4),
                                             BSplineBasis::uniform(3, 6, -3, 0)};
  const auto line = [](const Vec3& p) { return Vec3{1 + p.x, 2 * p.y - p.x, p.z + p.y}; };
  std::vector<Sample> samples;
  std::vector<Vec3> values;
  for (double u = -6; u <= 0; u += 0.5)
    for (double v = -4.75; v <= 4; v += 0.5)
      for (double w = -3; w <= 0; w += 0.5) {
        samples.push_back({{u, v, w}, side_of(v)});
        values.push_back(line(samples.back().uvw));
      }
  const SpatialFit fit(bases, samples);
  const Eigen::MatrixXd solution = fit.solve(fit.project(values));
  const Vec3 far{5, 2, -1};
  const auto bu = bases[0].evaluate(far.x), bv = bases[1].evaluate(far.y), bw = bases[2].evaluate(far.z);
  Vec3 sum;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      for (int k = 0; k < 4; ++k) {
        const auto row =
            solution.row(((bu.first + i) * bases[1].size() + bv.first + j) * bases[2].size() + bw.first + k);
        sum += bu.value[i] * bv.value[j] * bw.value[k] * Vec3{row(0), row(1), row(2)};
      }
  // The diagonal's strength, 1e-10, against the roughness's, 1e-7, over the 5 mm of about 4 control points
  // without data.
  EXPECT_LT(norm(sum - line(far)), 0.05 * norm(line(far)));
}

TEST(Encode, FewFramesGetFewControlPointsInTime) {
  const SyntheticSnapshot data({0, 2, 3}, [](const Vec3& p, Side, double t) {
    return Vec3{t * p.x, t * t, 0};
  });
  const Field field = encode(data.reader(), {{6, 8, 5, 16}}, silent);
  EXPECT_EQ(field.basis(3).size(), 3);
  EXPECT_LT(field.report.node_error, 1e-6);
  const SyntheticSnapshot one({0}, [](const Vec3&, Side, double) { return Vec3{}; });
  EXPECT_THROW(encode(one.reader(), {}, silent), InputError);
}

TEST(Encode, NothingThatMovesIsNoError) {
  const SyntheticSnapshot data(times, [](const Vec3& p, Side, double) { return p; });
  const Field field = encode(data.reader(), {{6, 8, 5, 4}}, silent);
  EXPECT_EQ(field.report.largest_displacement, 0);
  EXPECT_EQ(field.report.node_error, 0);
  EXPECT_EQ(norm(field.displacement({1, 1, -1}, Side::both, 3)), 0);
}

}  // namespace cleft
