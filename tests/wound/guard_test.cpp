// The guard of the skin: what it replaces, that nothing turns over or tears with it, and that the rest stays.
#include "explorer/guard/guard.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>

#include "explorer/guard/guard_search.h"
#include "explorer/guard/mean_value.h"
#include "explorer/wound/guard_passage.h"
#include "explorer/wound/live_wounds.h"
#include "explorer/wound/replayed_wounds.h"
#include "tests/incision/meshes.h"
#include "tests/wound/fields.h"

namespace cleft {
namespace {

using namespace testing;

TEST(MeanValues, ReproduceEveryPlaceInAFlatRing) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> part(0, 1);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<Vec3> ring;
    for (int i = 0; i < 7; ++i) {
      const double angle = 2 * std::numbers::pi * (i + 0.8 * part(random)) / 7, radius = 0.5 + part(random);
      ring.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
    }
    const Vec3 place{0.1 * part(random), 0.1 * part(random), 0};
    const std::vector<double> weights = mean_value_weights(place, ring);
    Vec3 mean;
    double sum = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      EXPECT_GT(weights[i], 0);
      mean += weights[i] * ring[i], sum += weights[i];
    }
    EXPECT_NEAR(sum, 1, 1e-12);
    EXPECT_LT(norm(mean - place), 1e-12);
  }
}

TEST(MeanValues, OfAPlaceOnAnEdgeAreThoseOfItsEnds) {
  const std::vector<Vec3> ring{{-1, 0, 0}, {3, 0, 0}, {1, 4, 0}};
  const std::vector<double> weights = mean_value_weights({0, 0, 0}, ring);
  EXPECT_NEAR(weights[0], 0.75, 1e-6);
  EXPECT_NEAR(weights[1], 0.25, 1e-6);
  EXPECT_NEAR(weights[2], 0, 1e-6);
}

TEST(Guard, TakesSharesOfWhatVerticesDoWithoutIt) {
  Guard guard;
  guard.replace(0, std::vector<Guard::Share>{{0, 0.5}}, 1);
  guard.replace(2, std::vector<Guard::Share>{{0, 0.25}, {1, 0.75}}, 1);
  guard.sort();
  const std::vector<Vec3> rest{{0, 0, 0}, {10, 0, 0}, {20, 0, 0}, {30, 0, 0}},
      own{{1, 0, 0}, {2, 4, 0}, {9, 9, 9}, {3, 3, 3}};
  std::vector<Vec3> positions;
  for (std::size_t v = 0; v < rest.size(); ++v) positions.push_back(rest[v] + own[v]);
  guard.apply(0, 0, rest.data(), positions.data());
  EXPECT_EQ(positions, (std::vector<Vec3>{{0.5, 0, 0}, {12, 4, 0}, {21.75, 3, 0}, {33, 3, 3}}));
  for (int v = 0; v < 4; ++v)
    EXPECT_EQ(rest[v] + guard.displacement(v, [&](int u) { return own[u]; }), positions[v]);
  guard.forget(1);
  EXPECT_TRUE(guard.moves(0));
  EXPECT_FALSE(guard.moves(2));
}

TEST(GuardMoments, ReduceADisplacementWhileTheBladePasses) {
  GuardMoments moments;
  moments.hold(2, 1, {4, 5, 0.5, 2, 1});
  moments.hold(2, 1, {4.5, 4.5, 0.25, 0.5, 0.5});
  moments.sort();
  // The least of the two, each linear before and after it.
  const std::pair<double, double> parts[] = {{1, 1},      {2, 1},   {3, 0.75},   {4, 0.5}, {4.25, 0.5},
                                             {4.5, 0.25}, {5, 0.5}, {5.5, 0.75}, {6, 1},   {7, 1}};
  for (const auto& [s, is] : parts) {
    EXPECT_DOUBLE_EQ(moments.part(2, 1, s), is) << s;
    EXPECT_EQ(moments.part(2, 0, s), 1);
    EXPECT_EQ(moments.part(1, 1, s), 1);
    const std::vector<Vec3> rest{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    std::vector<Vec3> now{{0, 1, 0}, {1, 1, 0}, {2, 8, 0}};
    moments.apply(1, s, rest.data(), now.data());
    EXPECT_EQ(now[1], (Vec3{1, 1, 0}));
    EXPECT_LT(norm(now[2] - Vec3{2, 8 * is, 0}), 1e-14) << s;
  }
}

SurfaceMesh plate_with_slivers() { return with_slivers(grid(60, 40, -30, -20, 1)); }

/// Skin triangles that have turned over or shrunk to a fifth, and edges whose ends have moved apart by more
/// than twice their length, at many times.
int unsound(const ReplayedWounds& wounds, int times) {
  const CutMesh& mesh = wounds[0].incision->mesh();
  std::vector<Vec3> now(wounds.vertex_count());
  int found = 0;
  for (int k = 1; k <= times; ++k) {
    wounds.positions(wounds.duration() * k / times, now);
    for (std::size_t t = 0; t < mesh.triangles().size(); ++t) {
      if (!mesh.is_skin(static_cast<int>(t))) continue;
      const auto& v = mesh.triangle(static_cast<int>(t)).vertex;
      const auto& rest = wounds.rest();
      const Vec3 before = cross(rest[v[1]] - rest[v[0]], rest[v[2]] - rest[v[0]]),
                 after = cross(now[v[1]] - now[v[0]], now[v[2]] - now[v[0]]);
      found += dot(before, after) <= 0 || norm(after) < 0.2 * norm(before);
      for (int i = 0; i < 3; ++i) {
        const int a = v[i], b = v[(i + 1) % 3];
        const double jump = norm((now[b] - rest[b]) - (now[a] - rest[a]));
        found += jump > 2 * norm(rest[b] - rest[a]) + 0.05;
      }
    }
    for (std::size_t cut = 0; cut < wounds.size(); ++cut)
      for (const auto& c : wounds[cut].incision->chain())
        found += dot(now[c.right] - now[c.left], wounds[cut].incision->path().at(c.s).across) < -0.05;
  }
  return found;
}

double widest(const ReplayedWounds& wounds, std::size_t cut) {
  std::vector<Vec3> now(wounds.vertex_count());
  wounds.positions(wounds.duration(), now);
  double widest = 0;
  for (const auto& c : wounds[cut].incision->chain())
    widest = std::max(widest, norm(now[c.right] - now[c.left]));
  return widest;
}

Field pulled() {
  return in_tension(opening_field({-15, 30, 3}, 60, 40, 6, 3),
                    {{"skin.prestress_u", 0.01}, {"skin.prestress_v", 0.03}, {"skin.prestress_uv", 0}});
}

/// Several cuts in one mesh, opened.
struct Opened {
  Field field = pulled();
  CutMesh mesh;
  std::vector<std::unique_ptr<Incision>> cuts;
  explicit Opened(const SurfaceMesh& surface) : mesh(surface) {}
  void cut(const ScalpelPath& path, const IncisionOptions& options = {}) {
    cuts.push_back(std::make_unique<Incision>(mesh, path, options));
    cuts.back()->advance_to(path.length());
  }
  std::unique_ptr<ReplayedWounds> wounds() const {
    std::vector<Wound> all;
    all.reserve(cuts.size());
    for (const auto& one : cuts) all.emplace_back(*one, field, 1);
    return std::make_unique<ReplayedWounds>(std::move(all));
  }
};

IncisionOptions as_it_is() {
  IncisionOptions options;
  options.max_edge = 0;
  return options;
}

TEST(Guard, IsNotNeededByACutThroughWellShapedTriangles) {
  Opened opened(grid(60, 40, -30, -20, 1));
  opened.cut(path_through({{-15, 0.3, 0}, {15, 0.3, 0}}, up, 3), as_it_is());
  const auto wounds = opened.wounds();
  EXPECT_TRUE(wounds->guard().empty());
  EXPECT_EQ(unsound(*wounds, 17), 0);
}

TEST(Guard, KeepsSliversWithoutHoldingTheLips) {
  Opened regular(grid(60, 40, -30, -20, 1)), opened(plate_with_slivers());
  for (Opened* one : {&regular, &opened})
    one->cut(path_through({{-15, 0.3, 0}, {15, 0.3, 0}}, up, 3), as_it_is());
  const auto wounds = opened.wounds();
  EXPECT_FALSE(wounds->guard().empty());
  EXPECT_EQ(unsound(*wounds, 17), 0);
  EXPECT_TRUE(wounds->validity(true).front().unsound.empty());
  EXPECT_GT(widest(*wounds, 0), 0.98 * widest(*regular.wounds(), 0));
  const Validity v = wounds->validity(true).front();
  EXPECT_EQ(static_cast<std::size_t>(v.guarded_vertices), wounds->guard().changes().size());
  EXPECT_GT(v.guarded, 0);
}

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
  Incision incision(mesh, path_through({{2.5, 4.86, 0}, {7.5, 4.86, 0}}, up, 3), as_it_is());
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

/// The blade goes on to the end of a path on which the mesh could not be cut further. The guard was found for
/// other displacements than those shown then: the other cuts had less tension left.
TEST(Guard, IsFoundForWhatIsShownWhereACutHasStopped) {
  constexpr double stops = 8;
  const auto two = [](double length, double cut) {
    auto opened = std::make_unique<Opened>(grid(60, 40, -30, -20, 1));
    opened->cut(path_through({{-15, -2, 0}, {15, -2, 0}}, up, 3));
    opened->cuts.push_back(std::make_unique<Incision>(
        opened->mesh, path_through({{-15, 2, 0}, {length - 15, 2, 0}}, up, 3), IncisionOptions{}));
    opened->cuts.back()->advance_to(cut);
    return opened;
  };
  const auto stopped = two(30, stops), shorter = two(stops, stops), whole = two(30, 30);
  const auto wounds = stopped->wounds();
  const double reached = (*wounds)[1].reached();
  ASSERT_NEAR(reached, stops, 0.5);
  ASSERT_NEAR(wounds->duration(), 60, 1e-9);
  for (const double s : {2., 5., 10.}) {
    const double is = wounds->amplitude(0, s, {1, 30});
    EXPECT_EQ(is, wounds->amplitude(0, s, {1, reached}));
    EXPECT_NEAR(is, shorter->wounds()->amplitude(0, s, {1, stops}), 0.05);
    EXPECT_LT(whole->wounds()->amplitude(0, s, {1, 30}), is - 0.1);
  }
  std::vector<Vec3> at_stop(wounds->vertex_count()), at_end(at_stop.size());
  wounds->positions(30 + reached, at_stop);
  wounds->positions(60, at_end);
  EXPECT_EQ(at_stop, at_end);
}

TEST(Guard, KeepsTheSkinBetweenCutsHalfAMillimetreApart) {
  Opened opened(grid(60, 40, -30, -20, 1));
  for (const double y : {-0.25, 0.25}) opened.cut(path_through({{-15, y, 0}, {15, y, 0}}, up, 3));
  opened.cut(path_through({{-10, -5, 0}, {10, 5, 0}}, up, 3));
  const auto wounds = opened.wounds();
  EXPECT_FALSE(wounds->guard().empty());
  EXPECT_EQ(unsound(*wounds, 23), 0);
  EXPECT_GT(widest(*wounds, 2), 0.9);
}

/// Triangles are looked at while the blade passes them, however small they are, and where little is left of
/// one the least of it is searched for: also between a corner, where it is looked at twice, and the next
/// look.
TEST(GuardPassage, FindsWhatIsUnsoundForAMoment) {
  Opened opened(grid(60, 40, -30, -20, 1));
  opened.cut(path_through({{-15, 0.3, 0}, {15, 0.3, 0}}, up, 3));
  const Wound wound(*opened.cuts[0], opened.field, 1);
  std::vector<std::pair<int, double>> vertices;
  for (const ActiveVertex& a : wound.volume.active()) vertices.emplace_back(a.vertex, a.s);
  const GuardPassage passage(wound, vertices, 0.6);
  const auto& skin = opened.mesh;
  int near = 0;
  for (std::size_t t = 0; t < skin.triangles().size(); ++t) {
    const auto& v = skin.triangle(static_cast<int>(t)).vertex;
    std::array<double, 3> s_of;
    double across = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      s_of[i] = skin.position(v[i]).x + 15;
      across = std::max(across, std::abs(skin.position(v[i]).y - 0.3));
    }
    std::ranges::sort(s_of);
    const double first = s_of[0], last = s_of[2];
    if (!skin.is_skin(static_cast<int>(t)) || across > 1 || first < 2 || last > 28) continue;
    ++near;
    // For a fortieth of the way through the triangle.
    const double for_a_while = 0.0125 * (last - first);
    for (const double at : {first + 0.42 * (last - first), s_of[1] + 0.05 * (last - first)}) {
      const auto left = [&](int triangle, double s) {
        if (triangle != static_cast<int>(t)) return 1.;
        const double from = std::abs(s - at);
        return from < for_a_while ? GuardPassage::unsound : 0.1 + from / (last - first);
      };
      int found = 0;
      for (const GuardPassage::Beside& one : passage.beside())
        passage.look(one, 0, left, [&](double s, double from, double to) {
          ++found;
          EXPECT_EQ(one.triangle, static_cast<int>(t));
          EXPECT_NEAR(s, at, for_a_while);
          EXPECT_LE(from, s);
          EXPECT_GE(to, s);
        });
      EXPECT_GE(found, 1) << t << ", " << at;
    }
  }
  EXPECT_GT(near, 100);
}

/// A field that turns its own patch over is left to do so, and what it turns is named.
TEST(Guard, NamesWhatTurnsOverInSpiteOfIt) {
  Opened opened(grid(60, 40, -30, -20, 1));
  opened.field = opening_field({-15, 30, 3}, 60, 40, 6, 60);
  opened.cut(path_through({{-15, 0.3, 0}, {15, 0.3, 0}}, up, 3), as_it_is());
  const auto wounds = opened.wounds();
  const Validity v = wounds->validity(true).front();
  const auto& rest = wounds->rest();
  std::vector<Vec3> now(wounds->vertex_count());
  const auto turned = [&](const Vec3& place, double t) {
    wounds->positions(t, now);
    for (const CutMesh::Triangle& triangle : opened.mesh.triangles()) {
      const auto& c = triangle.vertex;
      if (triangle.region != Region::skin ||
          norm(1. / 3 * (rest[c[0]] + rest[c[1]] + rest[c[2]]) - place) > 1e-9)
        continue;
      const Vec3 before = cross(rest[c[1]] - rest[c[0]], rest[c[2]] - rest[c[0]]),
                 after = cross(now[c[1]] - now[c[0]], now[c[2]] - now[c[0]]);
      return dot(before, after) < 0 || norm(after) < 0.2 * norm(before);
    }
    return false;
  };
  std::size_t at_the_end = 0, named = 0;
  for (const CutMesh::Triangle& triangle : opened.mesh.triangles()) {
    const auto& c = triangle.vertex;
    const Vec3 middle = 1. / 3 * (rest[c[0]] + rest[c[1]] + rest[c[2]]);
    if (triangle.region != Region::skin || !turned(middle, wounds->duration())) continue;
    ++at_the_end;
    named += std::any_of(v.unsound.begin(), v.unsound.end(),
                         [&](const Validity::Unsound& u) { return norm(u.place - middle) < 1e-9; });
  }
  EXPECT_GT(at_the_end, 0u);
  EXPECT_EQ(named, at_the_end);
  for (const Validity::Unsound& u : v.unsound) {
    EXPECT_TRUE(u.torn || turned(u.place, u.blade_at)) << u.place.x << " " << u.place.y;
    EXPECT_NEAR(u.at, u.place.x + 15, 1.5);
  }
  ASSERT_FALSE(v.warnings.empty());
  EXPECT_NE(v.warnings[0].find(std::to_string(v.unsound.size()) + " triangles of the skin turn over"),
            std::string::npos);
}

TEST(GuardMoments, LeaveOutWhatOthersCover) {
  GuardMoments moments;
  moments.hold(2, 0, {4, 5, 0.5, 2, 1});
  moments.hold(2, 0, {4, 4.5, 0.75, 0.5, 0.5});  // covered by the first
  EXPECT_EQ(moments.count(), 1u);
  moments.hold(2, 0, {4, 4.5, 0.75, 2, 3});  // ends later
  EXPECT_EQ(moments.count(), 2u);
  moments.hold(2, 0, {3.5, 8, 0.25, 2, 1});  // covers both
  EXPECT_EQ(moments.count(), 1u);
  EXPECT_EQ(moments.part(2, 0, 4), 0.25);
}

TEST(Guard, LeavesOutNothingThatItMoves) {
  Opened opened(plate_with_slivers());
  opened.cut(path_through({{-15, 0.3, 0}, {15, 0.3, 0}}, up, 3), as_it_is());
  const auto wounds = opened.wounds();
  const ReplayedWounds::Level level = wounds->level(0.1);
  ASSERT_GT(level.left_out(), 0u);
  std::vector<Vec3> all(wounds->vertex_count()), some(all.size());
  for (const double t : {3., 11., 30.}) {
    wounds->positions(t, all), wounds->positions(t, level, some);
    for (const int v : wounds->guard().vertices()) EXPECT_EQ(all[v], some[v]);
  }
}

TEST(Guard, IsTheSameLiveBitForBit) {
  const Field field = pulled();
  const SurfaceMesh plate = plate_with_slivers();
  const ScalpelPath paths[] = {path_through({{-15, 0.3, 0}, {15, 0.3, 0}}, up, 3),
                               path_through({{-10, -4, 0}, {10, 6, 0}}, up, 3)};
  for (const std::size_t count : {1, 2}) {
    CutMesh mesh(plate);
    std::vector<std::unique_ptr<Incision>> cuts;
    LiveWounds live;
    for (std::size_t k = 0; k < count; ++k) {
      cuts.push_back(std::make_unique<Incision>(mesh, paths[k], IncisionOptions{}));
      live.follow();  // the mesh near the path may have been refined
      live.add(Wound(*cuts.back(), field, 1), 500);
      for (double s = 0.7; cuts.back()->tip() < paths[k].length(); s += 0.7) {
        cuts.back()->advance_to(s);
        live.follow();
        live.move_to_tips();
        live.relieve();
      }
      while (!live.guard_skin()) live.move_to_tips();
      EXPECT_FALSE(live.guard().empty());
      EXPECT_FALSE(live.guard_skin());
    }
    std::vector<Wound> all;
    all.reserve(cuts.size());
    for (const auto& one : cuts) all.emplace_back(*one, field, 1);
    const ReplayedWounds replayed(std::move(all));
    EXPECT_EQ(live.guard().vertices(), replayed.guard().vertices());
    ASSERT_EQ(live.guard().changes().size(), replayed.guard().changes().size());
    for (std::size_t i = 0; i < live.guard().changes().size(); ++i)
      EXPECT_EQ(live.guard().changes()[i].by, replayed.guard().changes()[i].by);
    std::vector<Vec3> now(replayed.vertex_count());
    replayed.positions(replayed.duration(), now);
    for (std::size_t v = 0; v < now.size(); ++v) {
      const Vec3 is = replayed.rest()[v] + live.displacement(static_cast<int>(v));
      if (count == 1)
        ASSERT_EQ(is, now[v]) << v;
      else  // cuts are added in another order, and their relief is rounded otherwise
        ASSERT_LT(norm(is - now[v]), 1e-13) << v;
    }
  }
}

}  // namespace
}  // namespace cleft
