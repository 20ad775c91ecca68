// Which coincident nodes are a break, which are not, and where (u, v, w) is then.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "tests/import/plate.h"

namespace cleft {

namespace {

class ImportBreak : public testing::Test {
 protected:
  const TemporaryFolder folder;

  std::string refusal(const SourceSeries& series, const std::optional<std::string>& plane = {}) {
    try {
      const Imported imported(folder, series.write(folder), {"displacement"}, plane);
    } catch (const InputError& e) {
      return e.what();
    }
    return "accepted";
  }
};

/// Cells with nodes of their own, as discontinuous elements are written.
SourceSeries unshared(const SourceSeries& series) {
  SourceSeries loose;
  loose.times = series.times;
  loose.fields = series.fields;
  for (auto& field : loose.fields) field.frames.assign(series.times.size(), {});
  for (std::size_t c = 0; c < series.mesh.cell_types.size(); ++c) {
    std::vector<std::int64_t> corners;
    for (auto i = series.mesh.cell_offsets[c]; i < series.mesh.cell_offsets[c + 1]; ++i) {
      const std::size_t node = series.mesh.connectivity[i];
      corners.push_back(loose.add_point(series.mesh.points[node]));
      for (std::size_t f = 0; f < series.fields.size(); ++f) {
        const std::size_t k = series.fields[f].components;
        for (std::size_t j = 0; j < series.times.size(); ++j) {
          const auto first = series.fields[f].frames[j].begin() + static_cast<long>(k * node);
          auto& to = loose.fields[f].frames[j];
          to.insert(to.end(), first, first + static_cast<long>(k));
        }
      }
    }
    loose.add_cell(series.mesh.cell_types[c], corners);
  }
  return loose;
}

/// One more node at the place of another, with its values; cells at larger or smaller distance along `axis`
/// than the node get it, according to `sign`.
std::int32_t double_node(SourceSeries& series, std::int32_t node, const Vec3& axis, double sign) {
  const Vec3 place = series.mesh.points[node];
  const std::int32_t added = series.add_point(place);
  for (auto& field : series.fields)
    for (auto& values : field.frames)
      for (int c = 0; c < field.components; ++c) values.push_back(values[node * field.components + c]);
  for (std::size_t cell = 0; cell < series.mesh.cell_types.size(); ++cell) {
    const auto first = series.mesh.cell_offsets[cell], last = series.mesh.cell_offsets[cell + 1];
    double side = 0;
    for (auto i = first; i < last; ++i)
      side += dot(axis, series.mesh.points[series.mesh.connectivity[i]] - place);
    for (auto i = first; i < last; ++i)
      if (auto& corner = series.mesh.connectivity[i]; corner == node && side * sign > 0) corner = added;
  }
  return added;
}

/// A strip of quads (and hexahedra of them with thickness > 0) on [0, 10] x [-2, 2], doubled on y = 0 for x <
/// end. In frame j nodes at x < open[j] are open.
SourceSeries strip(double thickness, double start, double end,
                   const std::vector<std::pair<double, double>>& open, const Pose& pose = {}) {
  SourceSeries s;
  std::vector<Vec3> local;
  std::vector<int> side;
  const auto node = [&](double x, double y, double z, int of_cell) {
    const int its = y == 0 && start <= x && x <= end ? of_cell : 0;
    for (std::size_t i = 0; i < local.size(); ++i)
      if (local[i] == Vec3{x, y, z} && side[i] == its) return static_cast<std::int64_t>(i);
    local.push_back({x, y, z}), side.push_back(its);
    return static_cast<std::int64_t>(s.add_point(pose.point({x, y, z})));
  };
  for (double x = 0; x < 10; ++x)
    for (double y = -2; y < 2; ++y) {
      std::vector<std::int64_t> corners;
      for (double z = 0; z <= thickness; z += std::max(thickness, 1.0))
        for (const auto& [a, b] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
          corners.push_back(node(x + a, y + b, z, y < 0 ? -1 : 1));
      s.add_cell(thickness > 0 ? hexahedron : quad, corners);
    }
  s.fields = {{"displacement", 3, {}}};
  for (std::size_t j = 0; j < open.size(); ++j) {
    s.times.push_back(static_cast<double>(j));
    auto& values = s.fields[0].frames.emplace_back();
    for (std::size_t i = 0; i < local.size(); ++i) {
      const bool is_open = open[j].first < local[i].x && local[i].x < open[j].second;
      const Vec3 d = pose.vector({0.1, side[i] * (is_open ? 0.5 : 0.0), 0});
      values.insert(values.end(), {d.x, d.y, d.z});
    }
  }
  return s;
}

const std::pair<double, double> closed = {0, 0};

}  // namespace

TEST_F(ImportBreak, AFlatMeshStaysFlat) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const SourceSeries s = strip(0, 0, 4, {closed, {-1, 1.5}, {-1, 3.5}}, Pose::random(seed));
    const Imported imported(folder, s.write(folder), {"displacement"});
    const Snapshot& r = imported.snapshot();
    ASSERT_EQ(r.pairs.size(), 5u);
    for (const Vec3& p : r.points) EXPECT_EQ(p.z, 0);
    EXPECT_NEAR(r.cut_start, -2, 1e-12);
    EXPECT_NEAR(r.cut_length, 4, 1e-12);
    EXPECT_NEAR(r.cut_depth, 0, 1e-12);
    EXPECT_EQ(r.released, (std::vector<std::int32_t>{0, 2, 4}));
    // It grows along u: from the middle of [0, 4], columns at 0, 2 and 4.
    for (std::size_t j = 0; j < 3; ++j) EXPECT_NEAR(r.position[j], 2.0 * static_cast<double>(j) - 2, 1e-12);
    double right_edge = 0;
    for (const Vec3& p : r.points) right_edge = std::max(right_edge, p.x);
    EXPECT_NEAR(right_edge, 8, 1e-12) << "u points the way the cut grows";
    // Left and right by the cells, not by which way they move: here they close over each other.
    for (const auto& [left, right] : r.pairs) EXPECT_EQ(r.points[left].y, 0);
    EXPECT_NEAR(imported.reader.displacement(2)[r.pairs[0][1]].y, 0.5, 1e-12);
    EXPECT_NEAR(imported.reader.displacement(2)[r.pairs[0][0]].y, -0.5, 1e-12);
  }
}

TEST_F(ImportBreak, AThroughCrackHasItsTopAtTheBodysTop) {
  const Imported imported(folder, strip(3, 0, 4, {closed, {-1, 2.5}, {-1, 4.5}}).write(folder),
                          {"displacement"});
  const Snapshot& s = imported.snapshot();
  EXPECT_EQ(s.pairs.size(), 10u);
  EXPECT_NEAR(s.cut_depth, 3, 1e-12);
  double low = 0, high = -10;
  for (const Vec3& p : s.points) low = std::min(low, p.z), high = std::max(high, p.z);
  EXPECT_EQ(low, -3);
  EXPECT_EQ(high, 0);
  EXPECT_EQ(s.source->axes[2], (Vec3{0, 0, 1}));
  EXPECT_EQ(s.position,
            (std::vector<double>{-2, 1, 3}));  // columns at 0 .. 4, from their middle; 5 is single
}

TEST_F(ImportBreak, ASlitThatOpensAtOnceHasItsEndAsPosition) {
  const Imported imported(folder, strip(0, 3, 7, {closed, closed, {2, 8}, {2, 8}}).write(folder),
                          {"displacement"});
  EXPECT_EQ(imported.snapshot().released, (std::vector<std::int32_t>{0, 0, 5, 5}));
  EXPECT_EQ(imported.snapshot().position, std::vector<double>(4, 2.0));
}

TEST_F(ImportBreak, WhatIsOpenInTheFirstFrameIsReleasedInTheSecond) {
  const Imported imported(folder, strip(0, 3, 7, {{2, 4.5}, {2, 5.5}, {2, 8}}).write(folder),
                          {"displacement"});
  EXPECT_EQ(imported.snapshot().released, (std::vector<std::int32_t>{0, 3, 5}));
}

TEST_F(ImportBreak, ACrackThatGrowsBothWaysFollowsTheEndAhead) {
  const Imported imported(folder, strip(0, 1, 9, {closed, {4.5, 5.5}, {2.5, 7.5}}).write(folder),
                          {"displacement"});
  const Snapshot& s = imported.snapshot();
  EXPECT_EQ(s.released, (std::vector<std::int32_t>{0, 1, 5}));
  EXPECT_EQ(s.position, (std::vector<double>{-4, 1, 3}));
}

/// Inside a block: nowhere at its surface.
TEST_F(ImportBreak, ACutWithinTheBodyIsMeasuredFromItsTop) {
  SourceSeries s;
  const auto node = [&](double x, double y, double z, int side) {
    const bool doubled = y == 0 && 2 <= x && x <= 6 && 2 <= z && z <= 3;
    const Vec3 p = {x, y, z + (doubled ? 1e-12 * side : 0)};
    for (std::size_t i = 0; i < s.mesh.points.size(); ++i)
      if (s.mesh.points[i] == p) return static_cast<std::int64_t>(i);
    s.add_point(p);
    return static_cast<std::int64_t>(s.mesh.points.size()) - 1;
  };
  for (double x = 0; x < 8; ++x)
    for (const double y : {-1.0, 0.0})
      for (double z = 0; z < 6; ++z) {
        std::vector<std::int64_t> corners;
        for (const int c : {0, 1})
          for (const auto& [a, b] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
            corners.push_back(node(x + a, y + b, z + c, y < 0 ? -1 : 1));
        s.add_cell(hexahedron, corners);
      }
  s.times = {0, 1};
  s.fields = {{"displacement", 3, {{}, {}}}};
  for (const Vec3& p : s.mesh.points)
    for (int j = 0; j < 2; ++j)
      for (const double d :
           {0.1, p.z != std::round(p.z) && j == 1 ? (p.z - std::round(p.z)) * 1e12 : 0.0, 0.0})
        s.fields[0].frames[j].push_back(d);
  const Imported imported(folder, s.write(folder), {"displacement"});
  EXPECT_EQ(imported.snapshot().pairs.size(), 10u);
  double high = -10;
  for (const Vec3& p : imported.snapshot().points) high = std::max(high, p.z);
  EXPECT_NEAR(high, 0, 1e-11);
  EXPECT_NEAR(imported.snapshot().cut_depth, 1, 1e-11);
  EXPECT_NEAR(norm(imported.snapshot().source->origin - Vec3{4, 0, 6}), 0, 1e-11);
}

TEST_F(ImportBreak, UnsharedNodesAreWeldedButNotAcrossTheBreak) {
  const Plate plate(Plate::Cells::hexahedra, Pose::random(21));
  for (const bool single : {false, true}) {
    SourceSeries s = unshared(plate.series());
    for (auto& values : s.fields[0].frames)  // evaluated cell by cell, with another last digit in each
      for (std::size_t i = 0; i < values.size(); ++i)
        values[i] *= 1 + 1e-15 * static_cast<double>(i / 24 % 5);
    s.single = single;
    const Imported imported(folder, s.write(folder), {"displacement", "temperature"});
    const Snapshot& r = imported.snapshot();
    EXPECT_NE(imported.notes().find("were welded"), std::string::npos) << imported.notes();
    std::size_t opened = 0;
    for (std::size_t n = 0; n < plate.local.size(); ++n)
      opened += plate.side[n] < 0 && Plate::is_open(plate.local[n], Plate::frames - 1);
    EXPECT_EQ(r.pairs.size(), opened) << "all pairs open in the last frame";
    EXPECT_EQ(r.points.size(), plate.local.size());
    EXPECT_EQ(r.released.back(), static_cast<std::int32_t>(opened));
    for (std::size_t j = 0; j < Plate::frames; ++j) {  // every node's values are those of its place and side
      const auto found = imported.reader.displacement(j);
      for (const auto& [left, right] : r.pairs)
        for (const std::int32_t node : {left, right}) {
          std::size_t n = 0;
          while (plate.side[n] != (node == left ? -1 : 1) || norm(plate.local[n] - r.points[node]) > 1e-9)
            ASSERT_LT(++n, plate.local.size());
          EXPECT_LT(norm(found[node] - plate.displacement(n, j)), single ? 1e-6 : 1e-12);
        }
    }
  }
}

/// Two nodes that are tied differ by a digit of single precision, as solvers write them.
TEST_F(ImportBreak, RoundingToSinglePrecisionOpensNothing) {
  SourceSeries s = strip(0, 0, 4, {closed, {-1, 1.5}, {-1, 3.5}});
  s.single = true;
  for (auto& values : s.fields[0].frames)
    for (std::size_t i = 0; i < values.size(); i += 6) values[i] = std::nextafter(0.1f, 1.0f);
  const Imported imported(folder, s.write(folder), {"displacement"});
  EXPECT_EQ(imported.snapshot().released, (std::vector<std::int32_t>{0, 2, 4}));
}

TEST_F(ImportBreak, CoincidentPointsAreFoundAcrossAnyBorder) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-1, 1);
  std::vector<Vec3> points;
  const double tolerance = 1e-3;
  for (int i = 0; i < 2000; ++i) {
    points.push_back({place(random), place(random), place(random)});
    points.push_back(points.back() + (0.5 * tolerance) * Vec3{place(random), place(random), place(random)});
  }
  std::vector<std::int32_t> first(points.size(), -1);
  for (const auto& group : coincident_groups(points, tolerance)) {
    EXPECT_GT(group.size(), 1u);
    for (const std::int32_t i : group) first[i] = group.front();
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    bool alone = true;
    for (std::size_t k = 0; k < points.size(); ++k)
      if (k != i && norm(points[k] - points[i]) <= tolerance) {
        alone = false;
        ASSERT_EQ(first[i], first[k]);
      }
    ASSERT_EQ(first[i] < 0, alone);
  }
}

TEST_F(ImportBreak, AConformingSeamIsNoBreak) {
  SourceSeries s = strip(0, 20, 20, {closed, closed});  // no node doubled
  const auto count = static_cast<std::int32_t>(s.mesh.points.size());
  for (std::int32_t i = 0; i < count; ++i)
    if (s.mesh.points[i].x == 4) double_node(s, i, {1, 0, 0}, 1);
  const Imported imported(folder, s.write(folder), {"displacement"});
  EXPECT_TRUE(imported.snapshot().pairs.empty());
  EXPECT_EQ(imported.snapshot().source->break_plane, "none");
  EXPECT_NE(imported.notes().find("10 coincident nodes never part"), std::string::npos) << imported.notes();
  // Asked for, it is one, that never opens.
  const Imported asked(folder, s.write(folder), {"displacement"}, "1,0,0,4");
  EXPECT_EQ(asked.snapshot().pairs.size(), 5u);
  EXPECT_EQ(asked.snapshot().released.back(), 0);
}

TEST_F(ImportBreak, ASeamBesideTheBreakIsLeft) {
  SourceSeries s = strip(0, 0, 4, {closed, {-1, 1.5}, {-1, 4.5}});
  const auto count = static_cast<std::int32_t>(s.mesh.points.size());
  for (std::int32_t i = 0; i < count; ++i)
    if (s.mesh.points[i].x == 7) double_node(s, i, {1, 0, 0}, 1);
  const Imported imported(folder, s.write(folder), {"displacement"});
  EXPECT_EQ(imported.snapshot().pairs.size(), 5u);
  EXPECT_NE(imported.notes().find("8 coincident nodes lie outside the break's plane"), std::string::npos)
      << imported.notes();
  EXPECT_NE(imported.notes().find("2 coincident nodes in the break's plane have cells on one side only"),
            std::string::npos)
      << imported.notes();
}

TEST_F(ImportBreak, ThreeNodesAtAPlacePairEveryLeftWithARight) {
  SourceSeries s = strip(0, 0, 4, {closed, {-1, 4.5}});
  std::int32_t left = -1, right = -1;
  for (std::size_t i = 0; i < s.mesh.points.size(); ++i)
    if (s.mesh.points[i] == Vec3{2, 0, 0})
      (s.fields[0].frames[1][3 * i + 1] < 0 ? left : right) = static_cast<std::int32_t>(i);
  const std::int32_t second = double_node(s, left, {1, 0, 0}, 1);
  const Imported imported(folder, s.write(folder), {"displacement"});
  EXPECT_EQ(imported.snapshot().pairs.size(), 6u);
  for (const std::int32_t node : {left, second})
    EXPECT_EQ(std::count(imported.snapshot().pairs.begin(), imported.snapshot().pairs.end(),
                         (NodePair{node, right})),
              1);
  EXPECT_NE(imported.notes().find("more than two nodes at 1 place"), std::string::npos) << imported.notes();
}

TEST_F(ImportBreak, OfTwoBreaksEachHasAPiece) {
  SourceSeries s = strip(0, 0, 4, {closed, {-1, 4.5}});
  std::vector<std::int32_t> added;
  const auto count = static_cast<std::int32_t>(s.mesh.points.size());
  for (std::int32_t i = 0; i < count; ++i)
    if (s.mesh.points[i].x == 7) added.push_back(double_node(s, i, {1, 0, 0}, 1));
  for (const std::int32_t node : added) s.fields[0].frames[1][3 * node] += 0.5;
  const Imported both(folder, s.write(folder), {"displacement"});
  ASSERT_EQ(both.snapshot().pieces.size(), 2u);
  for (const SnapshotPiece& piece : both.snapshot().pieces) EXPECT_EQ(piece.pairs.size(), 5u);
  EXPECT_EQ(both.snapshot().pairs.size(), 10u);
  EXPECT_NE(both.notes().find("2 breaks"), std::string::npos) << both.notes();

  const Imported along_y(folder, s.write(folder), {"displacement"}, "0,3,0,0.001");  // typed roughly
  EXPECT_EQ(along_y.snapshot().pairs.size(), 5u);
  EXPECT_EQ(along_y.snapshot().source->break_plane, "0,1,0,0");
  const Imported along_x(folder, s.write(folder), {"displacement"}, "1,0,0,7");
  EXPECT_EQ(along_x.snapshot().pairs.size(), 5u);
  EXPECT_EQ(along_x.snapshot().source->axes[1], (Vec3{1, 0, 0}));
  const Imported none(folder, s.write(folder), {"displacement"}, "none");
  EXPECT_TRUE(none.snapshot().pairs.empty());
  EXPECT_EQ(none.snapshot().cut_length, 0);
}

TEST_F(ImportBreak, ALineOfDoubledNodesFixesNoPlaneInABody) {
  SourceSeries s = strip(3, 20, 20, {closed, closed});
  const auto count = static_cast<std::int32_t>(s.mesh.points.size());
  std::vector<std::int32_t> added;
  for (std::int32_t i = 0; i < count; ++i)
    if (const Vec3& p = s.mesh.points[i]; p.y == 0 && p.z == 0)
      added.push_back(double_node(s, i, {0, 1, 0}, 1));
  for (const std::int32_t node : added) s.fields[0].frames[1][3 * node] += 0.5;
  EXPECT_NE(refusal(s).find("on a line"), std::string::npos) << refusal(s);
  const Imported imported(folder, s.write(folder), {"displacement"}, "0,1,0,0");
  EXPECT_EQ(imported.snapshot().pairs.size(), 11u);
  EXPECT_NEAR(imported.snapshot().cut_length, 10, 1e-12);
  EXPECT_EQ(imported.snapshot().cut_depth, 0);
}

TEST_F(ImportBreak, APlaneThatDoesNotDivideIsRefused) {
  const SourceSeries s = strip(0, 0, 4, {closed, {-1, 4.5}});
  EXPECT_NE(refusal(s, "0,1,0,5").find("all nodes lie on one side of this plane, the nearest 3"),
            std::string::npos)
      << refusal(s, "0,1,0,5");
  EXPECT_NE(refusal(s, "0,2,0,4").find("on one side"), std::string::npos) << "it only touches";
  EXPECT_NE(refusal(s, "0,0,1,0").find("parallel"), std::string::npos) << refusal(s, "0,0,1,0");
  EXPECT_NE(
      refusal(s, "0,1,0,1").find("none of the 10 coincident nodes lies in this plane, the nearest 1 away"),
      std::string::npos)
      << refusal(s, "0,1,0,1");
  EXPECT_NE(refusal(strip(3, 0, 4, {closed, {-1, 4.5}}), "0,0,1,3").find("on one side"), std::string::npos);
  for (const char* text : {"", "1,0,0", "0,0,0,1", "1,0,x,0", "1,0,0,0,0", "nan,0,0,0"})
    EXPECT_NE(refusal(s, text).find("--break '" + std::string(text) + "'"), std::string::npos)
        << refusal(s, text);
}

/// A mesh without doubled nodes, of a body that is divided all the same.
TEST_F(ImportBreak, APlaneBetweenNodesIsTaken) {
  const Imported imported(folder, strip(3, 20, 20, {closed, closed}).write(folder), {"displacement"},
                          "0,2,0,1");
  EXPECT_EQ(imported.snapshot().source->break_plane, "0,1,0,0.5");
  EXPECT_TRUE(imported.snapshot().pairs.empty());
  EXPECT_NE(imported.notes().find("no nodes are doubled"), std::string::npos) << imported.notes();
}

}  // namespace cleft
