#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <tuple>

#include "params/consistency.h"
#include "params/parameters/table.h"
#include "solver/patch_mesh.h"
#include "tests/solver/patch_mesh_shapes.h"
#include "tests/support/even_piece.h"

namespace cleft {

TEST(Release, OpensIncisionByIncisionAndColumnByColumnFromTheSkin) {
  for (auto [name, p] : shapes())
    for (const FrameEvery frames : {FrameEvery::column, FrameEvery::pair}) {
      p.cut.frames = frames;
      SCOPED_TRACE(name + ", " + text_of(p, p.cut.frames));
      const PatchMesh mesh = make_patch_mesh(p);
      const Release r = make_release(mesh, p);
      ASSERT_EQ(r.order.size(), mesh.pairs.size());
      EXPECT_EQ(std::set<int>(r.order.begin(), r.order.end()).size(), mesh.pairs.size());
      EXPECT_EQ(r.released.front(), 0);
      EXPECT_EQ(r.times.front(), 0);
      EXPECT_EQ(r.position.front(), r.start);
      EXPECT_EQ(r.times.size(), r.released.size());
      EXPECT_EQ(r.position.size(), r.released.size());
      EXPECT_TRUE(std::is_sorted(r.released.begin(), r.released.end(), std::less_equal<>()));
      EXPECT_TRUE(std::is_sorted(r.times.begin(), r.times.end(), std::less_equal<>()));
      EXPECT_NEAR(r.times.back(), r.length * p.cut.count + p.cut.branch, 1e-12);
      const auto before = [&](int a, int b) {
        const NodePair &x = mesh.pairs[a], &y = mesh.pairs[b];
        return std::tuple(x.incision, x.along, x.depth) < std::tuple(y.incision, y.along, y.depth);
      };
      EXPECT_TRUE(std::is_sorted(r.order.begin(), r.order.begin() + r.released.back(), before));
      int open = 0, columns = 0;  // counted anew from the pairs
      for (const NodePair& pair : mesh.pairs) {
        const bool branch = p.cut.branch > 0 && pair.incision == 1;
        const bool is_open = pair.depth < r.depth && (branch || std::abs(pair.along) < r.length / 2 - 1e-9);
        open += is_open;
        columns += is_open && pair.depth == 0;
      }
      EXPECT_EQ(r.released.back(), open);
      EXPECT_EQ(static_cast<int>(r.released.size()) - 1, p.cut.frames == FrameEvery::pair ? open : columns);
    }
}

TEST(Release, ThePositionIsThatOfTheFirstColumnStillClosedAndTimeItsWay) {
  for (const auto& [name, p] : shapes()) {
    SCOPED_TRACE(name);
    const PatchMesh mesh = make_patch_mesh(p);
    const Release r = make_release(mesh, p);
    for (std::size_t j = 1; j < r.released.size(); ++j) {
      const NodePair& last = mesh.pairs[r.order[r.released[j] - 1]];
      const std::vector<double>& lines = mesh.lines_along[last.incision];
      const auto here = std::find(lines.begin(), lines.end(), last.along);
      EXPECT_EQ(r.position[j], *(here + 1));
      const bool branch = p.cut.branch > 0 && last.incision == 1;
      EXPECT_NEAR(r.times[j], last.incision * r.length + r.position[j] - (branch ? 0 : r.start), 1e-12);
      if (j + 1 == r.released.size()) continue;
      const NodePair& next = mesh.pairs[r.order[r.released[j]]];
      EXPECT_TRUE(next.incision > last.incision || next.along == r.position[j]);
    }
  }
}

TEST(Release, WithAFrameForEveryPairTheTipMovesByFractionsOfAColumn) {
  Parameters p = small_patch();  // lines at -3, -2, ..., 3; two pairs in a column
  p.cut.frames = FrameEvery::pair;
  const Release r = make_release(make_patch_mesh(p), p);
  ASSERT_EQ(r.position.size(), 11u);
  EXPECT_EQ(r.position[1], -1.5);
  EXPECT_EQ(r.position[2], -1);
  EXPECT_EQ(r.times[1], 1.5);
  EXPECT_EQ(r.times[10], 6);
}

TEST(Release, ParallelCutsFollowOneAnother) {
  Parameters p = small_patch();
  p.cut.count = 3, p.cut.spacing = 1;
  const Release r = make_release(make_patch_mesh(p), p);
  EXPECT_EQ(r.released, (std::vector<int>{0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30}));
  EXPECT_EQ(r.times, (std::vector<double>{0, 2, 3, 4, 5, 6, 8, 9, 10, 11, 12, 14, 15, 16, 17, 18}));
  EXPECT_EQ(r.position[5], 3);
  EXPECT_EQ(r.position[6], -1);
}

TEST(Release, ABranchOpensFromItsJunction) {
  Parameters p = small_patch();
  p.cut.branch = 2;
  const PatchMesh mesh = make_patch_mesh(p);
  const Release r = make_release(mesh, p);
  EXPECT_EQ(r.times, (std::vector<double>{0, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_EQ(r.position, (std::vector<double>{-3, -1, 0, 1, 2, 3, 1, 2}));
  EXPECT_EQ(mesh.pairs[r.order[10]].along, 0);
  EXPECT_EQ(mesh.pairs[r.order[10]].incision, 1);
}

TEST(Release, TheCaseEndsAtTheNearestNodes) {
  Parameters p = even_piece();
  p.mesh.cut_length = 30, p.mesh.cut_depth = 4;
  for (const double size : {1.0, 1.3, 0.93})
    for (const double radius : {0.0, 20.0})
      for (double length = 2 * size; length <= 30; length += 0.37) {
        p.mesh.element_size = size, p.cut.radius = radius, p.cut.length = length;
        p.cut.depth = std::min(4.0, 0.51 * size + length / 9);
        check_consistency(p, "here");
        const PatchMesh mesh = make_patch_mesh(p);
        const Release r = make_release(mesh, p);
        const auto nearest = [](const std::vector<double>& lines, double place) {
          double least = 1e9;
          for (const double x : lines) least = std::min(least, std::abs(x - place));
          return least;
        };
        const std::vector<double>& lines = mesh.lines_along[0];
        EXPECT_NEAR(std::abs(r.start + length / 2), nearest(lines, -length / 2), 1e-12);
        EXPECT_NEAR(r.start + r.length, -r.start, 1e-12) << "stays centred";
        EXPECT_NEAR(std::abs(r.depth - p.cut.depth), nearest(mesh.lines_depth, p.cut.depth), 1e-12);
        EXPECT_GT(r.released.back(), 0);
        for (const double position : r.position)
          EXPECT_EQ(std::count(lines.begin(), lines.end(), position), 1) << "not even rounded";
        EXPECT_NEAR(r.times.back(), r.length, 1e-12);
      }
}

TEST(Release, RoundingLeavesAColumnAndARowToOpen) {
  Parameters p = even_piece();
  for (double size = 0.7; size < 1.5; size += 0.0137) {
    p.mesh.element_size = size;
    p.mesh.cut_length = 5 * size, p.cut.length = 2 * size;  // ends half-way between two nodes
    p.mesh.cut_depth = 3 * size * (1 + 2e-10), p.cut.depth = size / 2 * (1 + 1e-10);
    check_consistency(p, "here");
    const Release r = make_release(make_patch_mesh(p), p);
    EXPECT_GE(r.released.back(), 1) << size;
    EXPECT_NEAR(r.length, 3 * size, 1e-9) << size;
    EXPECT_NEAR(r.depth, size, 1e-9) << size;
  }
}

}  // namespace cleft
