// Heat in a bar without any cut: where (u, v, w) is then.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/import/source_series.h"

namespace cleft {

namespace {

/// Cooling of a bar of 10 x 4 x `thickness` from one end: heat conduction's first mode, in closed form.
SourceSeries cooling_bar(const Pose& pose, double thickness = 2) {
  SourceSeries s;
  std::vector<Vec3> local;
  const int layers = thickness > 0 ? 2 : 1;
  for (int z = 0; z < layers; ++z)
    for (int y = 0; y <= 4; ++y)
      for (int x = 0; x <= 10; ++x) local.push_back({1.0 * x, 1.0 * y, thickness * z});
  for (const Vec3& p : local) s.add_point(pose.point(p));
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 10; ++x) {
      const int n = 11 * y + x;
      std::vector<std::int64_t> corners = {n, n + 1, n + 12, n + 11};
      if (layers == 2) corners.insert(corners.end(), {n + 55, n + 56, n + 67, n + 66});
      s.add_cell(layers == 2 ? hexahedron : quad, corners);
    }
  s.fields = {{"T", 1, {}}, {"flux", 3, {}}};
  for (const double t : {0.0, 1.0, 4.0, 9.0}) {
    s.times.push_back(t);
    auto &temperature = s.fields[0].frames.emplace_back(), &flux = s.fields[1].frames.emplace_back();
    const double k = std::numbers::pi / 10;
    for (const Vec3& p : local) {
      temperature.push_back(300 + 50 * std::cos(k * p.x) * std::exp(-k * k * t));
      const Vec3 q = pose.vector({50 * k * std::sin(k * p.x) * std::exp(-k * k * t), 0, 0});
      flux.insert(flux.end(), {q.x, q.y, q.z});
    }
  }
  return s;
}

Pose turned_about_z(double degrees) {
  const double a = degrees * std::numbers::pi / 180;
  Pose pose;
  pose.axes[0] = {std::cos(a), std::sin(a), 0}, pose.axes[1] = {-std::sin(a), std::cos(a), 0};
  pose.origin = {1, 2, 3};
  return pose;
}

struct Extent {
  Vec3 low{1e9, 1e9, 1e9}, high{-1e9, -1e9, -1e9};
};
Extent extent(const std::vector<Vec3>& points) {
  Extent e;
  for (const Vec3& p : points)
    for (int i = 0; i < 3; ++i) e.low[i] = std::min(e.low[i], p[i]), e.high[i] = std::max(e.high[i], p[i]);
  return e;
}

class ImportBox : public testing::Test {
 protected:
  const TemporaryFolder folder;

  Imported import(const SourceSeries& series, Box box = Box::smaller) {
    return {folder, series.write(folder), {"T:temperature", "flux"}, {}, box};
  }
};

const std::array<Vec3, 3> identity = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

}  // namespace

TEST_F(ImportBox, WithoutABreakTheMiddleIsDivided) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const SourceSeries series = cooling_bar(Pose::random(seed));
    const Imported imported = import(series);
    const Snapshot& s = imported.snapshot();
    const auto [low, high] = extent(s.points);
    EXPECT_LT(norm(low - Vec3{-5, -2, -2}), 1e-12) << "seed " << seed;
    EXPECT_LT(norm(high - Vec3{5, 2, 0}), 1e-12) << "seed " << seed;
    EXPECT_TRUE(s.pairs.empty());
    EXPECT_EQ(s.released, std::vector<std::int32_t>(4));
    EXPECT_EQ(s.position, std::vector<double>(4));
    EXPECT_EQ(s.cut_length, 0);
    EXPECT_EQ(s.cut_depth, 0);
    EXPECT_EQ(s.source->break_plane, "none");
    EXPECT_EQ(s.times, (std::vector<double>{0, 1, 4, 9}));

    const auto arrays = imported.reader.point_arrays();  // by name
    ASSERT_EQ(arrays.size(), 2u);
    EXPECT_EQ(arrays[1].name, "temperature");
    for (std::size_t j = 0; j < 4; ++j) {
      EXPECT_EQ(imported.reader.point_array(arrays[1], j), series.fields[0].frames[j]);
      const auto flux = imported.reader.point_array(arrays[0], j);
      for (std::size_t i = 0; i < flux.size(); i += 3) {
        EXPECT_NEAR(flux[i + 1], 0, 1e-13);
        EXPECT_NEAR(flux[i + 2], 0, 1e-13);
      }
    }
  }
}

TEST_F(ImportBox, ABodyAlongTheAxesStaysThere) {
  for (const double degrees : {0.0, 2.0}) {  // at 2 degrees the principal box saves 9 percent
    const Imported imported = import(cooling_bar(turned_about_z(degrees)));
    EXPECT_EQ(imported.snapshot().source->axes, identity);
    const auto [low, high] = extent(imported.snapshot().points);
    EXPECT_EQ(high.z, 0);
    EXPECT_NEAR(low.y + high.y, 0, 1e-12);
    EXPECT_NEAR(low.x + high.x, 0, 1e-12);
  }
  const auto& turned = import(cooling_bar(turned_about_z(30))).snapshot().source->axes;
  EXPECT_LT(norm(turned[0] - turned_about_z(30).axes[0]), 1e-12);
}

TEST_F(ImportBox, TheBoxCanBeChosen) {
  const Pose leaning = turned_about_z(30), slightly = turned_about_z(2);
  EXPECT_EQ(import(cooling_bar(leaning), Box::aligned).snapshot().source->axes, identity);
  const auto axes = import(cooling_bar(slightly), Box::principal).snapshot().source->axes;
  EXPECT_LT(norm(axes[0] - slightly.axes[0]), 1e-12);
}

TEST_F(ImportBox, AFlatMeshStaysFlatAnyhow) {
  Pose upright;  // in the plane of x and z
  upright.axes[1] = {0, 0, 1}, upright.axes[2] = {0, -1, 0};
  for (const Pose& pose : {Pose(), upright, turned_about_z(30), Pose::random(4)}) {
    const Imported imported = import(cooling_bar(pose, 0));
    const auto [low, high] = extent(imported.snapshot().points);
    EXPECT_EQ(low.z, 0);
    EXPECT_EQ(high.z, 0);
    EXPECT_NEAR((high.x - low.x) * (high.y - low.y), 40, 1e-10);
    EXPECT_NEAR(low.y + high.y, 0, 1e-12);
  }
}

}  // namespace cleft
