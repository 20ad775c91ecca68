// A growing cut in a body that lies anyhow in space: every place, pair and value against its closed form.
#include "tests/import/plate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace cleft {

namespace {

const std::vector<std::string> all_fields = {"displacement", "stress", "temperature"};

class ImportPlate : public testing::TestWithParam<Plate::Cells> {
 protected:
  const TemporaryFolder folder;
};

std::set<double> columns(const Plate& plate) {
  std::set<double> places;
  for (const Vec3& p : plate.local)
    if (Plate::is_doubled(p)) places.insert(p.x);
  return places;
}

int pairs_open(const Plate& plate, std::size_t frame) {
  int count = 0;
  for (std::size_t n = 0; n < plate.local.size(); ++n)
    count += plate.side[n] < 0 && Plate::is_open(plate.local[n], frame);
  return count;
}

}  // namespace

// Rounding: coordinates of 100 with 16 digits.
TEST_P(ImportPlate, PlacesAreThoseOfTheCut) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const Plate plate(GetParam(), Pose::random(seed));
    const Imported imported(folder, plate.series().write(folder), all_fields);
    const Snapshot& s = imported.snapshot();
    EXPECT_LT(largest_difference(s.points, plate.local), 1e-12) << "seed " << seed;
    for (std::size_t n = 0; n < s.points.size(); ++n)
      if (plate.local[n].y == 0) {
        EXPECT_EQ(s.points[n].y, 0);
      }
    EXPECT_NEAR(s.cut_start, -Plate::half_cut, 1e-12);
    EXPECT_NEAR(s.cut_length, 2 * Plate::half_cut, 1e-12);
    EXPECT_NEAR(s.cut_depth, Plate::depth, 1e-12);
    EXPECT_EQ(s.times, (std::vector<double>{0, 0.5, 1.25, 2, 5}));
    EXPECT_EQ(imported.notes(), "");
    EXPECT_TRUE(s.parameters.empty() && s.foundation_triangles.empty());
  }
}

TEST_P(ImportPlate, WhatItDoesNotTellMayBeGiven) {
  ImportOptions options;
  options.series = Plate(GetParam(), Pose::random(1)).series().write(folder);
  options.out = folder / "case.h5";
  options.fields = all_fields;
  options.parameters = {"skin.thickness=1.5", "skin.prestress_v=0.03"};
  import_series(options, [](const std::string&) {});
  const auto parameters = SnapshotReader(options.out).snapshot().parameters;
  ASSERT_EQ(parameters.all().size(), 2u);
  EXPECT_EQ(parameters->skin.thickness, 1.5);
  EXPECT_EQ(parameters->skin.prestress.vv, 0.03);
}

TEST_P(ImportPlate, TheSourceIsTold) {
  const Pose pose = Pose::random(3);
  const Plate plate(GetParam(), pose);
  const Imported imported(folder, plate.series().write(folder), all_fields);
  const SnapshotSource& source = *imported.snapshot().source;
  EXPECT_EQ(source.file, "series.pvd");
  EXPECT_EQ(source.time_start, 3);
  EXPECT_LT(norm(source.origin - pose.origin), 1e-12);
  for (int i = 0; i < 3; ++i) EXPECT_LT(norm(source.axes[i] - pose.axes[i]), 1e-12);
  const Plane plane = parse_plane(source.break_plane);
  EXPECT_LT(norm(plane.normal - pose.axes[1]), 1e-12);
  EXPECT_NEAR(plane.offset, dot(pose.axes[1], pose.origin), 1e-12);
}

TEST_P(ImportPlate, PairsAreLeftAndRightInTheOrderTheyOpen) {
  const Plate plate(GetParam(), Pose::random(7));
  const Imported imported(folder, plate.series().write(folder), all_fields);
  const Snapshot& s = imported.snapshot();
  ASSERT_EQ(static_cast<long>(s.pairs.size()), std::count(plate.side.begin(), plate.side.end(), -1));
  for (std::size_t p = 0; p < s.pairs.size(); ++p) {
    const auto left = static_cast<std::size_t>(s.pairs[p][0]),
               right = static_cast<std::size_t>(s.pairs[p][1]);
    EXPECT_EQ(plate.side[left], -1);
    EXPECT_EQ(plate.side[right], 1);
    EXPECT_EQ(plate.local[left], plate.local[right]);
  }
  for (std::size_t j = 0; j < Plate::frames; ++j) {
    EXPECT_EQ(s.released[j], pairs_open(plate, j)) << "frame " << j;
    for (std::size_t p = 0; p < s.pairs.size(); ++p)
      EXPECT_EQ(static_cast<std::int32_t>(p) < s.released[j], Plate::is_open(plate.local[s.pairs[p][0]], j));
  }
  // Of those that open together, the first along u and from the top first.
  for (std::size_t p = 1; p < s.pairs.size(); ++p) {
    const auto at = [&](std::size_t i) { return plate.local[s.pairs[i][0]]; };
    const auto frame = [&](std::size_t i) {
      return std::count_if(s.released.begin(), s.released.end(),
                           [=](int open) { return open <= static_cast<int>(i); });
    };
    if (frame(p - 1) == frame(p)) {
      EXPECT_TRUE(at(p - 1).x < at(p).x || (at(p - 1).x == at(p).x && at(p - 1).z > at(p).z));
    }
  }
  // The tip: the next column of nodes, which after the last doubled one are single.
  for (std::size_t j = 0; j < Plate::frames; ++j) {
    const std::set<double> places = columns(plate);
    const auto next = places.lower_bound(Plate::tips[j]);
    const double step = GetParam() == Plate::Cells::quadratic_hexahedra ? 1 : 2;
    EXPECT_NEAR(s.position[j], next == places.end() ? Plate::half_cut + step : *next, 1e-12) << "frame " << j;
  }
}

TEST_P(ImportPlate, VectorsAndTensorsTurnAndScalarsStay) {
  for (unsigned seed = 11; seed <= 13; ++seed) {
    const Plate plate(GetParam(), Pose::random(seed));
    const Imported imported(folder, plate.series().write(folder), all_fields);
    const auto arrays = imported.reader.point_arrays();
    ASSERT_EQ(arrays.size(), 2u);
    EXPECT_EQ(arrays[0].name, "stress");
    EXPECT_EQ(arrays[0].components, 6u);
    EXPECT_EQ(arrays[1].name, "temperature");
    for (std::size_t j = 0; j < Plate::frames; ++j) {
      const auto displacement = imported.reader.displacement(j);
      const auto stress = imported.reader.point_array(arrays[0], j);
      const auto temperature = imported.reader.point_array(arrays[1], j);
      double gap = std::numeric_limits<double>::infinity();
      for (std::size_t n = 0; n < plate.local.size(); ++n) {
        ASSERT_LT(norm(displacement[n] - plate.displacement(n, j)), 1e-13) << "node " << n << " frame " << j;
        for (std::size_t c = 0; c < 6; ++c)
          ASSERT_NEAR(stress[6 * n + c], plate.stress(n, j)[c], 1e-12) << "component " << c;
        ASSERT_EQ(temperature[n], plate.temperature(n, j));
        if (plate.side[n] > 0 && Plate::is_open(plate.local[n], j))
          gap = std::min(gap, 0.02 * (Plate::tips[j] - plate.local[n].x) * (3 + plate.local[n].z));
      }
      EXPECT_NEAR(imported.snapshot().smallest_gap[j], std::isfinite(gap) ? gap : 0, 1e-13);
    }
  }
}

/// Some programs write the deformed places besides the displacement.
TEST_P(ImportPlate, NodesThatMoveAreTakenFromTheFirstFrame) {
  const Plate plate(GetParam(), Pose::random(2));
  SourceSeries series = plate.series();
  series.write(folder);
  series.mesh.points[7].y += 0.25;
  folder.write("series_2.vtu", series.vtu(2));
  const Imported imported(folder, folder / "series.pvd", all_fields);
  EXPECT_LT(largest_difference(imported.snapshot().points, plate.local), 1e-12);
  EXPECT_NE(imported.notes().find("the nodes move by up to 0.2"), std::string::npos) << imported.notes();
}

INSTANTIATE_TEST_SUITE_P(Cells, ImportPlate,
                         testing::Values(Plate::Cells::hexahedra, Plate::Cells::tetrahedra,
                                         Plate::Cells::wedges, Plate::Cells::quadratic_hexahedra));

}  // namespace cleft
