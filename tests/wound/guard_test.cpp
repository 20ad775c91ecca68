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

/// The lips of a simulated cut part steeply next to its end: over the tenth of a millimetre between that
/// and the first edge that the cut divides by more than three times that. Where it is held for that, in skin
/// with another cut, the lips half a millimetre further on are not.
TEST(Guard, HoldsLipsNextToTheEndOfACutAlone) {
  const double first_edge = 0.105, start = -15 - first_edge;
  const BSplineBasis steep(
      3, {-30,         -30,         -30,         -30, -20, -16, start, start + 0.02, start + 0.05,
          start + 0.1, start + 0.2, start + 0.5, -14, -13, -11, -8,    -4,           0,
          5,           10,          13,          16,  20,  30,  30,    30,           30});
  for (const bool another : {false, true}) {
    Opened opened(grid(60, 80, -30, -40, 1));
    opened.field = in_tension(opening_field({start, 30, 3}, steep, 40, 6, 7.6),
                              {{"skin.prestress_u", 0.03}, {"skin.prestress_v", 0.03}});
    if (another) opened.cut(path_through({{start, 20, 0}, {14, 20, 0}}, up, 3), as_it_is());
    opened.cut(path_through({{start, -20.3, 0}, {14, -20.3, 0}}, up, 3), as_it_is());
    const auto wounds = opened.wounds();
    const Incision& cut = *opened.cuts.back();
    const auto& next = cut.chain()[1];
    ASSERT_NEAR(next.s, first_edge, 1e-9);
    const auto held = [&](int vertex) {
      const auto& changes = wounds->guard().changes();
      const auto change = std::ranges::find(changes, vertex, &Guard::Change::vertex);
      return change == changes.end() ? 0. : change->by;
    };
    const double opens = widest(*wounds, opened.cuts.size() - 1);
    EXPECT_EQ(held(next.left) > 0.01 * opens, another);
    for (const Incision::ChainVertex& c : cut.chain())
      if (c.s > 0.5) EXPECT_LT(std::max(held(c.left), held(c.right)), 0.01 * opens) << another << " " << c.s;
  }
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
    // For a hundredth of the way through the triangle, and a fortieth.
    struct Unsound {
      double at, for_a_while;
    };
    const double way = last - first;
    for (const Unsound& now :
         {Unsound{first + 0.42 * way, 0.005 * way}, {s_of[1] + 0.05 * way, 0.0125 * way}}) {
      const auto left = [&](int triangle, double s) {
        if (triangle != static_cast<int>(t)) return 1.;
        const double from = std::abs(s - now.at);
        return from < now.for_a_while ? GuardPassage::unsound : 0.1 + from / way;
      };
      int found = 0;
      for (const GuardPassage::Beside& one : passage.beside())
        passage.look(one, 0, left, [&](double s, double from, double to) {
          ++found;
          EXPECT_EQ(one.triangle, static_cast<int>(t));
          EXPECT_NEAR(s, now.at, now.for_a_while);
          EXPECT_LE(from, s);
          EXPECT_GE(to, s);
        });
      EXPECT_GE(found, 1) << t << ", " << now.at;
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
  const ScalpelPath first = path_through({{-15, 0.3, 0}, {15, 0.3, 0}}, up, 3),
                    across = path_through({{-10, -4, 0}, {10, 6, 0}}, up, 3),
                    into_first = path_through({{10, 10, 0}, {2, 0.2, 0}}, up, 3);
  for (const std::vector<ScalpelPath>& paths :
       {std::vector{first}, std::vector{first, across}, std::vector{first, into_first}}) {
    const std::size_t count = paths.size();
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
