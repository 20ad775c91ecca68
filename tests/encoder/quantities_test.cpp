// Stresses and temperatures in addition to the displacement, or alone.
#include <gtest/gtest.h>

#include <random>

#include "encoder/field/file/field_file.h"
#include "tests/encoder/synthetic_snapshot.h"

namespace cleft {

namespace {

Vec3 nowhere(const Vec3&, Side, double) { return {}; }

Snapshot without_cut(const std::vector<double>& times) {
  Snapshot s = cut_in(grid(), times);
  s.cut_length = s.cut_depth = 0;
  s.source = SnapshotSource{"series.pvd", {}, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, 0, "none"};
  s.points.resize(s.points.size() - s.pairs.size());
  s.pairs.clear();
  s.released.assign(times.size(), 0);
  s.position.assign(times.size(), 0);
  // Cells between the nodes of grid().
  const auto node = [](int i, int j, int k) { return std::int64_t{(i * 11 + j) * 6 + k}; };
  for (int i = 0; i < 12; ++i)
    for (int j = 0; j < 10; ++j)
      for (int k = 0; k < 5; ++k) {
        for (const int up : {0, 1})
          for (const auto& [x, y] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}})
            s.connectivity.push_back(node(i + x, j + y, k + up));
        s.cell_types.push_back(12);  // hexahedra
        s.cell_offsets.push_back(static_cast<std::int64_t>(s.connectivity.size()));
      }
  return s;
}

/// A quantity of the given components at a series' nodes.
template <class Value>
void add_quantity(Series& series, const std::string& name, int components, const Value& value) {
  SeriesQuantity& quantity = series.quantities.emplace_back();
  quantity.name = name;
  for (const double t : series.times) {
    Eigen::MatrixXd frame(series.samples.size(), components);
    for (std::size_t n = 0; n < series.samples.size(); ++n)
      for (int c = 0; c < components; ++c)
        frame(static_cast<Eigen::Index>(n), c) = value(series.samples[n].uvw, series.samples[n].side, t, c);
    quantity.largest = std::max(quantity.largest, norms_of(frame).maxCoeff());
    quantity.frames.push_back(std::move(frame));
  }
  set_scale(quantity, [&](std::size_t frame) { return Eigen::MatrixXd(quantity.frames[frame]); });
}

/// Warm from the start, where a displacement would be 0.
double temperature(const Vec3& p, Side, double t, int) {
  return 300 + 40 * std::exp(-t / 4) * std::sin(0.4 * p.x) * std::cos(0.3 * p.y) + 2 * p.z;
}

double stress(const Vec3& p, Side side, double t, int component) {
  const double released = sign_of(p, side) * (p.x < t - 4 ? 1 : 0) * std::max(0., 1 + p.z / 1.5);
  return (component + 1) * (1 + 0.1 * p.x) + 0.02 * t * p.y +
         0.05 * component * released * std::exp(-std::abs(p.y));
}

}  // namespace

TEST(Quantities, ATemperatureAloneKeepsTheToleranceEverywhere) {
  std::vector<double> times;
  for (int j = 0; j <= 20; ++j) times.push_back(0.4 * j);
  const SyntheticSnapshot snapshot(without_cut(times), nowhere);
  Series series = snapshot.series();
  add_quantity(series, "temperature", 1, temperature);
  const Field field = encoded_within(series, 1e-3).field;
  ASSERT_EQ(field.quantities.size(), 1u);
  EXPECT_EQ(field.quantities[0].name, "temperature");
  EXPECT_EQ(field.report.largest_displacement, 0);
  EXPECT_LE(field.quantities[0].error, 1e-3);
  EXPECT_GT(field.quantities[0].error, 0);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> part(0, 1);
  for (int i = 0; i < 1000; ++i) {  // between the nodes too
    const Vec3 p{12 * part(random) - 6, 10 * part(random) - 5, -2.5 * part(random)};
    const double t = 8 * part(random);
    double found = 0;
    field.quantity(0, p, Side::both, t, {&found, 1});
    EXPECT_NEAR(found, temperature(p, Side::both, t, 0), 3e-3 * 340)
        << p.x << ' ' << p.y << ' ' << p.z << ' ' << t;
    EXPECT_EQ(field.displacement(p, Side::both, t), Vec3{});
  }
}

TEST(Quantities, AStressKeepsTheToleranceAtEveryNodeAndFrameAsItIsWritten) {
  const SyntheticSnapshot snapshot(opening);
  Series series = snapshot.series();
  const Field alone = encoded_within(series, 0.05).field;
  add_quantity(series, "stress", 6, stress);
  add_quantity(series, "temperature", 1, temperature);
  for (const double tolerance : {0.05, 1e-3}) {
    const Encoded encoded = encoded_within(series, tolerance);
    if (tolerance == 0.05) {
      EXPECT_EQ(encoded.field.coefficients(), alone.coefficients()) << "the displacement does not change";
    }
    const TemporaryFolder folder;
    write_field(folder / "case.dffd", encoded);
    const Field field = read_field(folder / "case.dffd");
    ASSERT_EQ(field.quantities.size(), 2u);
    for (std::size_t q = 0; q < 2; ++q) {
      const Quantity& found = field.quantities[q];
      const auto residual = read_quantity_residual(folder / "case.dffd", q);
      EXPECT_GT(found.quantum, 0);
      double worst = 0, of_spline = 0;
      for (std::size_t j = 0; j < series.times.size(); ++j)
        for (std::size_t n = 0; n < series.samples.size(); ++n) {
          const Sample& sample = series.samples[n];
          std::vector<double> value(static_cast<std::size_t>(found.components));
          field.quantity(q, sample.uvw, sample.side, series.times[j], value);
          double squared = 0, squared_of_spline = 0;
          for (int c = 0; c < found.components; ++c) {
            const double off =
                value[c] - (q == 0 ? stress : temperature)(sample.uvw, sample.side, series.times[j], c);
            const double times = c < 3 ? 1 : 2;  // shear is in a tensor twice
            squared_of_spline += times * off * off;
            squared += times * std::pow(off + (residual ? residual->at(n, c, j) : 0), 2);
          }
          worst = std::max(worst, std::sqrt(squared));
          of_spline = std::max(of_spline, std::sqrt(squared_of_spline));
        }
      EXPECT_LE(worst / found.largest, tolerance);
      EXPECT_NEAR(worst / found.scale, found.error, 1e-12);
      EXPECT_NEAR(of_spline / found.scale, found.spline_error, 1e-12);
      EXPECT_EQ(residual.has_value(), found.spline_error > tolerance);
    }
  }
}

/// A fit is linear: of a derivative that is 2.5 times the displacement it makes control points that are so
/// too.
TEST(Quantities, ADerivativeIsFittedAsTheDisplacementIs) {
  const SyntheticSnapshot snapshot(opening);
  Series series = snapshot.series();
  const Field alone = encoded_within(series, 0.02).field;
  EXPECT_TRUE(alone.by_parameter.empty());
  SeriesDerivative derivative{"tissue.young_modulus", {}, 2.5 * series.largest_displacement};
  for (const Eigen::MatrixX3d& frame : series.frames) derivative.frames.push_back(2.5 * frame);
  series.derivatives = {derivative};
  const Field field = encoded_within(series, 0.02).field;
  EXPECT_EQ(field.coefficients(), alone.coefficients()) << "the displacement does not change";
  ASSERT_EQ(field.by_parameter.size(), 1u);
  const ParameterDerivative& found = field.by_parameter[0];
  EXPECT_EQ(found.parameter, "tissue.young_modulus");
  const Field of_derivative(field.shared_parametrization(),
                            {field.basis(0), field.basis(1), field.basis(2), field.basis(3)},
                            found.control_points);
  double worst = 0;
  for (std::size_t j = 0; j < series.times.size(); ++j)
    for (std::size_t n = 0; n < series.samples.size(); ++n) {
      const Sample& sample = series.samples[n];
      const auto row = derivative.frames[j].row(static_cast<Eigen::Index>(n));
      const Vec3 value = of_derivative.displacement(sample.uvw, sample.side, series.times[j]);
      worst = std::max(worst, norm(value - Vec3{row(0), row(1), row(2)}));
    }
  EXPECT_NEAR(worst / derivative.largest, found.error, 1e-12);
  EXPECT_LE(found.error, 1.5 * field.report.spline_error) << "a quarter for steps, and a little for lips";
}

}  // namespace cleft
