// Stresses and temperatures beside the displacement, or alone.
#include <gtest/gtest.h>

#include <random>

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
    quantity.largest = std::max(quantity.largest, frame.rowwise().norm().maxCoeff());
    quantity.frames.push_back(std::move(frame));
  }
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

TEST(Quantities, AStressIsFittedBesideTheDisplacementAndItsErrorIsTold) {
  const SyntheticSnapshot snapshot(opening);
  Series series = snapshot.series();
  const Field alone = encoded_within(series, 0.05).field;
  add_quantity(series, "stress", 6, stress);
  const Field field = encoded_within(series, 0.05).field;
  ASSERT_EQ(field.quantities.size(), 1u);
  const Quantity& found = field.quantities[0];
  EXPECT_EQ(found.components, 6);
  double worst = 0;
  for (std::size_t j = 0; j < series.times.size(); ++j)
    for (const Sample& sample : series.samples) {
      std::array<double, 6> value;
      field.quantity(0, sample.uvw, sample.side, series.times[j], value);
      double squared = 0;
      for (int c = 0; c < 6; ++c) {
        const double off =
            value[static_cast<std::size_t>(c)] - stress(sample.uvw, sample.side, series.times[j], c);
        squared += off * off;
      }
      worst = std::max(worst, std::sqrt(squared));
    }
  EXPECT_NEAR(worst / found.largest, found.error, 1e-12);
  EXPECT_LT(found.error, 0.1);
  EXPECT_EQ(field.coefficients(), alone.coefficients()) << "the displacement does not change";
}

}  // namespace cleft
