// What the guard of the skin finds from displacements: what it holds for good, and what it leaves to moments.
#include "explorer/guard/guard_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "explorer/incision/incision.h"
#include "tests/incision/meshes.h"

namespace cleft {
namespace {

using namespace testing;

/// Of a field that draws edges apart, and turns nothing over.
const GuardSearch::ByField draws_apart{
    [](int, std::size_t) { return false; }, [](int, int, double) { return true; },
    [](int, int, double) { return true; }, [](int, std::size_t) { return false; }};

/// A vertex 0.04 mm beside an edge makes a sliver, in skin that bends; once the vertex nears the edge, too.
TEST(GuardSearch, LeavesSliversThatHardlyBend) {
  SurfaceMesh plate = grid(10, 10, 0, 0, 1);
  constexpr int middle = 60;
  Vec3 edge;
  for (const auto& t : plate.triangles)
    if (t[0] == middle) {
      edge = 0.5 * (plate.points[t[1]] + plate.points[t[2]]);
      plate.points[middle] = edge + 0.04 * normalized(plate.points[middle] - edge);
      break;
    }
  const CutMesh mesh(plate);
  for (const bool nears : {false, true}) {
    GuardSearch search(mesh, 0.05, draws_apart);
    std::vector<std::pair<int, Vec3>> moved;
    moved.reserve(121);
    for (int v = 0; v < 121; ++v) {
      const Vec3 p = mesh.position(v) - mesh.position(middle);
      moved.push_back({v, {0, 0, 3 + 0.02 * squared_norm(p)}});
    }
    if (nears) moved[middle].second += 0.5 * (edge - mesh.position(middle));
    search.add(moved, true);
    ASSERT_TRUE(search.find());
    EXPECT_EQ(search.result().moves(middle), nears);
  }
}

/// A cut that passes 0.14 mm beside vertices makes slivers with a corner on a lip between the other two. What
/// turns such a sliver over for a moment costs the lip nothing for good; what does so for good moves it.
TEST(GuardSearch, TiesLipsToSliversOnlyForGood) {
  CutMesh mesh(grid(10, 10, 0, 0, 1));
  IncisionOptions options;
  options.max_edge = 0;
  Incision incision(mesh, path_through({{2.5, 4.86, 0}, {7.5, 4.86, 0}}, up, 3), options);
  incision.advance_to(incision.path().length());
  int lip = -1;
  Vec3 across;  // from the longest edge to the corner between its ends
  for (std::size_t t = 0; t < mesh.triangles().size() && lip < 0; ++t) {
    if (!mesh.is_skin(static_cast<int>(t))) continue;
    const auto& v = mesh.triangle(static_cast<int>(t)).vertex;
    for (int i = 0; i < 3; ++i) {
      const Vec3 a = mesh.position(v[(i + 1) % 3]), b = mesh.position(v[(i + 2) % 3]);
      const Vec3 along = normalized(b - a), from = mesh.position(v[i]) - a;
      const double part = dot(from, along) / norm(b - a);
      const VertexKind kind = mesh.vertex(v[i]).kind;
      if ((kind != VertexKind::left_lip && kind != VertexKind::right_lip) || part < 0.5 || part > 0.99)
        continue;
      across = from - dot(from, along) * along;
      if (norm(across) < 0.15 * norm(b - a)) lip = v[i];
    }
  }
  ASSERT_GE(lip, 0);
  for (const bool for_good : {false, true}) {
    GuardSearch search(mesh, 0.05, draws_apart);
    for (const bool lasting : {false, true}) {
      std::vector<std::pair<int, Vec3>> moved;
      for (std::size_t v = 0; v < mesh.vertices().size(); ++v)
        moved.push_back({static_cast<int>(v), {0, 8, 0}});
      if (!lasting || for_good) moved[static_cast<std::size_t>(lip)].second -= 2 * across;
      search.add(moved, lasting);
    }
    ASSERT_TRUE(search.find());
    EXPECT_EQ(search.result().moves(lip), for_good);
    EXPECT_EQ(search.remaining().empty(), for_good) << "what is left to moments";
  }
}

/// As at an X, where the second cut's lips beside the first one move into each other for a moment.
TEST(GuardSearch, HoldsLipsForGoodOnlyIfTheyPassEachOtherForGood) {
  const CutMesh mesh(grid(10, 10, 0, 0, 1));
  constexpr int left = 60, right = 61;
  for (const bool for_good : {false, true}) {
    GuardSearch search(mesh, 0.05, draws_apart);
    search.add_pair(left, right, {1, 0, 0});
    for (const bool lasting : {false, true}) {
      std::vector<std::pair<int, Vec3>> moved;
      moved.reserve(121);
      for (int v = 0; v < 121; ++v) moved.push_back({v, {0, 1, 0}});
      if (!lasting || for_good) moved[left].second.x = 0.05, moved[right].second.x = -0.05;
      search.add(moved, lasting);
    }
    ASSERT_TRUE(search.find());
    const Guard guard = search.result();
    EXPECT_EQ(guard.moves(left), for_good);
    EXPECT_EQ(guard.moves(right), for_good);
    const auto remaining = search.remaining();
    EXPECT_EQ(std::any_of(remaining.begin(), remaining.end(),
                          [](const GuardSearch::Remaining& r) { return r.one == -1 && r.time == 0; }),
              !for_good);
  }
}

/// Between two times lips may pass each other that do so at neither of them: where they change much, or all
/// but pass each other already.
TEST(GuardSearch, TellsWhichLipsMayPassEachOtherBetweenTimes) {
  const CutMesh mesh(grid(10, 10, 0, 0, 1));
  constexpr int left = 60, right = 61;
  GuardSearch search(mesh, 0.05, draws_apart);
  search.add_pair(left, right, {1, 0, 0});
  const double open[] = {0.5, 0.5, 0.49, -0.03, -0.03, 0.5, 0};
  for (const double by : open) {
    std::vector<std::pair<int, Vec3>> moved;
    moved.reserve(121);
    for (int v = 0; v < 121; ++v) moved.push_back({v, {0, 1, 0}});
    moved[left].second.x = -by / 2, moved[right].second.x = by / 2;
    search.add(moved, true);
  }
  ASSERT_TRUE(search.find());
  std::vector<std::size_t> times;
  for (const GuardSearch::Remaining& one : search.sudden())
    if (one.one == -1) times.push_back(one.time);
  EXPECT_EQ(times, (std::vector<std::size_t>{0, 3, 4, 5, 6}));
  EXPECT_EQ(search.corners(-1).front(), left);
  EXPECT_TRUE(search.is_passed(-1, {0.06, 0, 0}, {0, 0, 0}));
  EXPECT_FALSE(search.is_passed(-1, {0.03, 0, 0}, {0, 0, 0}));
}

/// A vertex at the edge of the mesh follows its neighbour further than the skin around does. That the
/// neighbour turns a triangle over for a moment is no reason to hold both back for good, as means of what is
/// around do.
TEST(GuardSearch, HoldsNothingForGoodForWhatIsUnsoundForAMoment) {
  const CutMesh mesh(grid(10, 10, 0, 0, 1));
  constexpr int at_edge = 55, next = 56;
  for (const bool passes : {false, true}) {
    GuardSearch search(mesh, 0.05, draws_apart);
    if (passes) search.add({{next, {1.5, 0, 0}}}, false);
    search.add({{at_edge, {1.2, 0, 0}}, {next, {0.6, 0, 0}}}, true);
    ASSERT_TRUE(search.find());
    EXPECT_TRUE(search.result().empty()) << passes;
    EXPECT_EQ(search.remaining().empty(), !passes) << "what is left to moments";
  }
}

/// A field that turns much of its own patch over is left to do so. What several cuts turn together, none of
/// them does alone: then the skin is held.
TEST(GuardSearch, BlamesTheFieldOfASingleCutAlone) {
  const CutMesh mesh(grid(10, 10, 0, 0, 1));
  for (const bool alone : {true, false}) {
    GuardSearch search(
        mesh, 0.05,
        {[](int, std::size_t) { return true; }, [](int, int, double) { return true; },
         [](int, int, double) { return true; }, [](int, std::size_t) { return false; }, alone});
    std::vector<std::pair<int, Vec3>> moved;
    moved.reserve(121);
    for (int v = 0; v < 121; ++v) moved.push_back({v, {v % 2 == 0 ? 1.5 : -1.5, 0, 0}});
    search.add(moved, true);
    ASSERT_EQ(search.find(), !alone);
    if (alone) continue;
    EXPECT_TRUE(search.is_excused());
    search.hold_excused();
    EXPECT_FALSE(search.result().empty());
  }
}

}  // namespace
}  // namespace cleft
