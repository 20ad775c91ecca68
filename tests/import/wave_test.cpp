// A wave that crosses a slit: no solid mechanics, no displacement, and a slit that does not grow.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "base/text.h"
#include "encoder/field/file/field_file.h"
#include "tests/import/source_series.h"
#include "tests/pipeline/commands.h"

namespace cleft {

namespace {

constexpr int width = 30, height = 20, slit_first = 8, slit_last = 16;

/// The wave equation on [0, 30] x [-10, 10] by finite volumes around the nodes, reflecting at all edges and
/// at the slit on y = 0, 8 <= x <= 16; from rest, with a bump of pressure at (x0, y0), of a radius.
class Wave {
 public:
  Wave(double x0, double y0, double radius = 0.5) {
    for (int y = -height / 2; y <= height / 2; ++y)
      for (int x = 0; x <= width; ++x)
        for (const int side : {-1, 1})
          if (side < 0 || is_slit(x, y)) series.add_point({3.0 + x, 5.0 + y, -2}), sides.push_back(side);
    area.resize(series.mesh.points.size());
    for (int y = -height / 2; y < height / 2; ++y)
      for (int x = 0; x < width; ++x) {
        const int side = y < 0 ? -1 : 1;
        const std::vector<std::int64_t> n = {number(x, y, side), number(x + 1, y, side),
                                             number(x + 1, y + 1, side), number(x, y + 1, side)};
        series.add_cell(quad, n);
        for (std::size_t i = 0; i < 4; ++i) {
          area[n[i]] += 0.25;
          edges.push_back({static_cast<std::size_t>(n[i]), static_cast<std::size_t>(n[(i + 1) % 4])});
        }
      }
    for (const Vec3& p : series.mesh.points)
      pressure.push_back(
          std::exp(-(std::pow(p.x - 3 - x0, 2) + std::pow(p.y - 5 - y0, 2)) / (radius * radius)));
    before = pressure;
  }

  /// `frames` frames, a few steps apart.
  SourceSeries run(int frames) {
    series.fields = {{"pressure", 1, {}}};
    for (int j = 0; j < frames; ++j) {
      series.times.push_back(steps * step * j);
      series.fields[0].frames.push_back(pressure);
      for (int i = 0; i < steps; ++i) advance();
    }
    return series;
  }

  std::vector<int> sides;

  static bool is_slit(int x, int y) { return y == 0 && slit_first <= x && x <= slit_last; }
  /// Nodes row by row, the right one of two after the left one.
  std::int64_t number(int x, int y, int side) const {
    const int row = y + height / 2, above = y > 0 ? slit_last - slit_first + 1 : 0;
    const int along = y == 0 ? std::clamp(x - slit_first, 0, slit_last - slit_first + 1) : 0;
    return row * (width + 1) + above + x + along + (is_slit(x, y) && side > 0 ? 1 : 0);
  }

 private:
  static constexpr int steps = 3;
  static constexpr double step = 0.5;  // stable up to 1 / sqrt 2

  void advance() {
    std::vector<double> force(pressure.size());
    for (const auto& [a, b] : edges) {  // half of the edge's dual lies in each cell
      force[a] += 0.5 * (pressure[b] - pressure[a]);
      force[b] += 0.5 * (pressure[a] - pressure[b]);
    }
    for (std::size_t i = 0; i < force.size(); ++i)
      before[i] = 2 * pressure[i] - before[i] + step * step * force[i] / area[i];
    std::swap(before, pressure);
  }

  SourceSeries series;
  std::vector<std::array<std::size_t, 2>> edges;
  std::vector<double> area, pressure, before;
};

class ImportWave : public testing::Test {
 protected:
  const TemporaryFolder folder;
};

}  // namespace

TEST_F(ImportWave, TheSlitIsFoundAndThePressureKept) {
  Wave wave(12, 4);
  const SourceSeries s = wave.run(30);
  const Imported imported(folder, s.write(folder), {"pressure"});
  const Snapshot& r = imported.snapshot();
  constexpr int slit_nodes = slit_last - slit_first + 1;
  ASSERT_EQ(r.pairs.size(), static_cast<std::size_t>(slit_nodes));
  for (const auto& [left, right] : r.pairs) {
    EXPECT_EQ(wave.sides[left], -1);
    EXPECT_EQ(wave.sides[right], 1);
  }
  EXPECT_EQ(r.source->axes[1], (Vec3{0, 1, 0}));
  EXPECT_EQ(r.source->axes[2], (Vec3{0, 0, 1}));
  EXPECT_EQ(r.source->origin, (Vec3{3 + 12, 5, -2}));
  EXPECT_EQ(r.cut_start, -4);
  EXPECT_EQ(r.cut_length, 8);

  // Nothing moves, and every number is as it was.
  const auto arrays = imported.reader.point_arrays();
  ASSERT_EQ(arrays.size(), 1u);
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t j = 0; j < 30; ++j) {
    EXPECT_EQ(imported.reader.displacement(j), std::vector<Vec3>(r.points.size()));
    EXPECT_EQ(imported.reader.point_array(arrays[0], j), s.fields[0].frames[j]);
    for (const double p : s.fields[0].frames[j]) low = std::min(low, p), high = std::max(high, p);
  }
  // A pair is open from when the wave is on one side of it.
  std::vector<bool> open(slit_nodes);
  for (std::size_t j = 0; j < 30; ++j) {
    for (int x = slit_first; x <= slit_last; ++x) {
      const auto at = [&](int side) { return s.fields[0].frames[j][wave.number(x, 0, side)]; };
      if (std::abs(at(1) - at(-1)) > 1e-9 * (high - low)) open[x - slit_first] = true;
    }
    EXPECT_EQ(r.released[j], j == 0 ? 0 : std::count(open.begin(), open.end(), true)) << "frame " << j;
  }
  EXPECT_EQ(r.released.back(), slit_nodes);
  EXPECT_LT(r.released[1], slit_nodes) << "the wave has not arrived everywhere";
  EXPECT_EQ(r.position.back(), 5) << "the first single node";
  EXPECT_EQ(imported.notes(), "");
}

TEST_F(ImportWave, ItsFieldKeepsTheToleranceAtEveryNodeAndFrame) {
  constexpr double tolerance = 0.02;
  const SourceSeries s = Wave(12, 4).run(30);
  const std::string snapshot = folder / "case.h5", field = folder / "case.dffd",
                    values = folder / "values.csv";
  expect_success(run_cleft("import", {s.write(folder), "--field", "pressure", "--out", snapshot}));
  expect_success(run_cleft("encode", {snapshot, "--tolerance", shortest(tolerance), "--out", field}));
  expect_success(run_cleft("check", {field}));
  double largest = 0, worst = 0;
  for (std::size_t j = 0; j < s.times.size(); ++j) {
    for (const double p : s.fields[0].frames[j]) largest = std::max(largest, std::abs(p));
    expect_success(
        run_cleft("eval", {field, "--nodes", snapshot, "--frame", std::to_string(j), "--out", values}));
    const NumberTable table = read_csv(values);
    const std::size_t column = table.column("pressure");
    ASSERT_EQ(table.rows.size(), s.fields[0].frames[j].size());
    for (std::size_t n = 0; n < table.rows.size(); ++n)
      worst = std::max(worst, std::abs(table.rows[n][column] - s.fields[0].frames[j][n]));
    std::filesystem::remove(values);
  }
  EXPECT_LE(worst, tolerance * largest);
  EXPECT_GT(worst, 0.1 * tolerance * largest) << "kept, and not by keeping all";
}

/// What is drawn keeps it too, and the jump across the slit, of a wave that the mesh resolves.
TEST_F(ImportWave, TheSplineOfASmoothWaveKeepsTheTolerance) {
  constexpr double tolerance = 0.01;
  Wave wave(12, 4, 2.5);
  const SourceSeries s = wave.run(16);
  const std::string snapshot = folder / "case.h5", file = folder / "case.dffd";
  expect_success(run_cleft("import", {s.write(folder), "--field", "pressure", "--out", snapshot}));
  expect_success(run_cleft("encode", {snapshot, "--tolerance", shortest(tolerance), "--out", file}));
  const Field field = read_field(file);
  const Quantity& pressure = field.quantities.at(0);
  EXPECT_LE(pressure.spline_error, tolerance);
  double worst = 0;
  for (std::size_t j = 0; j < s.times.size(); ++j)
    for (int x = slit_first; x <= slit_last; ++x) {
      double jump = 0;
      for (const int side : {-1, 1}) {
        double value = 0;
        field.quantity(0, field.source->canonical({3. + x, 5, -2}), side < 0 ? Side::left : Side::right,
                       s.times[j], {&value, 1});
        jump += side * (value - s.fields[0].frames[j][wave.number(x, 0, side)]);
      }
      worst = std::max(worst, std::abs(jump) / pressure.scale);
    }
  EXPECT_LE(worst, 2 * tolerance);
}

/// A wave along the slit is the same on both sides: nothing in the series says that there is one.
TEST_F(ImportWave, ASlitThatTheWaveDoesNotSeeMustBeTold) {
  const std::string series = Wave(2, 0).run(6).write(folder);
  const Imported found(folder, series, {"pressure"});
  EXPECT_TRUE(found.snapshot().pairs.empty());
  EXPECT_NE(found.notes().find("18 coincident nodes never part in 'pressure'"), std::string::npos)
      << found.notes();
  const Imported told(folder, series, {"pressure"}, "0,1,0,5");
  EXPECT_EQ(told.snapshot().pairs.size(), 9u);
  EXPECT_EQ(told.snapshot().released, std::vector<std::int32_t>(6));
  EXPECT_EQ(told.snapshot().position, std::vector<double>(6, -4));
}

}  // namespace cleft
