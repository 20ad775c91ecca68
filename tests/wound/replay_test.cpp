#include "explorer/wound/replay.h"

#include <gtest/gtest.h>

#include <memory>
#include <numbers>
#include <random>

#include "tests/incision/meshes.h"
#include "tests/support/allocations.h"
#include "tests/wound/fields.h"

namespace cleft {
namespace {

using namespace testing;

const CanonicalCut canonical{-5, 10, 3};

IncisionOptions unrefined() {
  IncisionOptions options;
  options.max_edge = 0;
  return options;
}

/// Any coefficients at all: nothing about the field helps the replay.
Field random_field(double length, double width) {
  Field field = opening_field(canonical, length, width, 6, 1);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> value(-1, 1);
  std::vector<Vec3> coefficients(field.coefficients().size());
  for (Vec3& c : coefficients) c = {value(random), value(random), value(random)};
  return {field.basis(0), field.basis(1), field.basis(2), field.basis(3), std::move(coefficients), canonical};
}

struct Straight {
  SurfaceMesh plane = grid(20, 16, -10, -8, 1);
  Incision incision{plane, path_through({{-5, 0, 0}, {5, 0, 0}}, up, canonical.depth), unrefined()};
  Straight() { incision.advance_to(10); }
};

/// The mean of a wave under weights that fall exponentially is known in closed form.
TEST(Replay, LiftsTheLipsUnderABladeWhoseTiltWaves) {
  constexpr double depth = 3, reach = 0.42 * depth, degrees = std::numbers::pi / 180, length = 40;
  const CanonicalCut cut{-20, length, depth};
  const auto field = std::make_shared<const Field>(opening_field(cut, 60, 40, 6, 2));
  for (const double wave : {16., 8.}) {
    const auto tilt = [&](double s) { return 10 * degrees * std::cos(2 * std::numbers::pi * s / wave); };
    std::vector<ScalpelPath::Point> points;
    for (double s = 0; s <= length; s += 0.25)
      points.push_back({{s - length / 2, 0, 0}, {0, -std::sin(tilt(s)), std::cos(tilt(s))}, depth});
    Incision incision(grid(60, 40, -30, -20, 1), ScalpelPath(points), unrefined());
    incision.advance_to(length);
    const double part = 1 / (1 + std::pow(2 * std::numbers::pi * reach / wave, 2));
    const VaryingField family(field, {{.s = 0, .field = field, .along = {1, 0, 0}, .tilt = 6}});
    for (const bool follows : {false, true}) {
      const VaryingField opened = follows ? family : VaryingField(*field);
      const IncisionVolume volume = [&] {
        IncisionVolume made(incision, opened, 1);
        made.opened_by(opened);
        return made;
      }();
      int lips = 0;
      for (const auto& c : incision.chain()) {
        if (c.left == c.right || c.s < 8 || c.s > length - 8) continue;
        const auto at = volume.locate(c.left);
        ASSERT_TRUE(at);
        const double expected =
            std::tan(2. / 3 * part * tilt(c.s)) - (follows ? std::tan(2. / 3 * 6 * degrees) : 0);
        EXPECT_NEAR(dot(at->across, at->outward), expected, 0.004) << wave << ", " << c.s;
        ++lips;
      }
      EXPECT_GT(lips, 10);
    }
  }
}

TEST(Replay, LiftsTheLipsOfCutsThatAreShorterThanDeepLess) {
  constexpr double depth = 3, tilt = 0.5;
  const Vec3 blade{0, -std::sin(tilt), std::cos(tilt)};
  const Field field = opening_field({-5, 10, depth}, 20, 16, 6, 2);
  for (const double length : {1.5, 6.}) {
    Incision incision(grid(40, 40, -5, -5, 0.25),
                      ScalpelPath({{{-length / 2, 0, 0}, blade, depth}, {{length / 2, 0, 0}, blade, depth}}),
                      unrefined());
    incision.advance_to(length);
    const IncisionVolume volume(incision, field, 1);
    int lips = 0;
    for (const auto& c : incision.chain()) {
      if (c.left == c.right) continue;
      const auto at = volume.locate(c.left);
      ASSERT_TRUE(at);
      EXPECT_NEAR(dot(at->across, at->outward), std::min(1., length / depth) * std::tan(2. / 3 * tilt), 1e-9);
      ++lips;
    }
    EXPECT_GT(lips, 1);
  }
}

TEST(Replay, IsTheFieldItselfOnAFlatPatch) {
  const Straight cut;
  const CutMesh& mesh = cut.incision.mesh();
  for (const Field& field : {opening_field(canonical, 20, 16, 6, 2), random_field(20, 16)}) {
    const Replay replay(Wound(cut.incision, field, 1));
    EXPECT_EQ(replay.active().size(), mesh.vertices().size());
    std::vector<Vec3> moved(mesh.vertices().size());
    for (double t = 0; t <= 10; t += 0.25) {
      replay.positions(t, moved);
      for (std::size_t i = 0; i < moved.size(); ++i) {
        const CutMesh::Vertex& v = mesh.vertices()[i];
        const bool on_skin = i < cut.plane.points.size() || v.depth_fraction == 0;
        const Vec3& p = v.position;
        ASSERT_TRUE(!on_skin || p.z == 0);
        Side side = v.kind == VertexKind::skin ? side_of(p.y) : side_of(v.kind);
        if (v.kind != VertexKind::skin && v.s >= t) side = Side::both;
        const Vec3 expected = p + field.displacement(p, side, t);
        ASSERT_LT(norm(moved[i] - expected), 1e-12) << "vertex " << i << " at t = " << t;
      }
    }
  }
}

/// Normalised parameters that follow the tip, any coefficients, and a fit good to 1e-3 of 1 mm.
Field tip_field() {
  const std::array<BSplineBasis, 4> bases{
      BSplineBasis(3, {0, 0, 0, 0, 1, 1, 1, 1.5, 2, 2, 2, 2.5, 3, 3, 3, 3}),
      BSplineBasis::broken(3, 10, -1, 0, 1), BSplineBasis(3, {-2, -2, -2, -2, -1, -1, -1, 0, 0, 0, 0}),
      BSplineBasis::uniform(3, 7, 0, 1)};
  std::mt19937 random(4);
  std::uniform_real_distribution<double> value(-1, 1);
  std::vector<Vec3> coefficients(12 * 10 * 7 * 7);
  for (Vec3& c : coefficients) c = {value(random), value(random), value(random)};
  Field field(
      make_parametrization("tip", {{{{-10, 10}, {-8, 8}, {-6, 0}, {0, 10}}}, canonical, {{0, 10}, {-5, 5}}}),
      bases, std::move(coefficients));
  field.report.largest_displacement = 1, field.report.spline_error = 1e-3;
  return field;
}

TEST(Replay, FollowsTheTipWithinTheToleranceOfContraction) {
  const Straight cut;
  const CutMesh& mesh = cut.incision.mesh();
  const Field field = tip_field();
  EXPECT_EQ(field.contraction_tolerance(), 1e-4);
  const Replay replay(Wound(cut.incision, field, 1));
  std::vector<Vec3> moved(mesh.vertices().size());
  std::vector<double> times{0, 10};
  for (double t = 0; t < 10; t += 0.0371) times.push_back(t);
  for (const auto& c : cut.incision.chain())  // when the tip passes a vertex, and just before and after
    for (const double away : {-1e-6, 0., 1e-6}) times.push_back(c.s + away);
  for (const double t : times) {
    replay.positions(t, moved);
    for (std::size_t i = 0; i < moved.size(); ++i) {
      const CutMesh::Vertex& v = mesh.vertices()[i];
      const Vec3& p = v.position;
      // Where rounding decides on which side of the cut's start it lies, the vertex jumps.
      if ((v.kind != VertexKind::skin && v.depth_fraction != 0) || std::abs(p.x + 5) < 1e-6) continue;
      Side side = v.kind == VertexKind::skin ? side_of(p.y) : side_of(v.kind);
      if (v.kind != VertexKind::skin && v.s >= t) side = Side::both;
      ASSERT_LE(norm(moved[i] - p - field.displacement(p, side, t)), 1.0001e-4)
          << "vertex " << i << " at t = " << t;
    }
  }
}

TEST(Replay, AllocatesNothing) {
  const Straight cut;
  for (const Field& field : {random_field(20, 16), tip_field()}) {
    const Replay replay(Wound(cut.incision, field, 1));
    std::vector<Vec3> moved(replay.vertex_count());
    const std::size_t before = allocations();
    for (double t = -1; t < 11; t += 0.1) replay.positions(t, moved);
    EXPECT_EQ(allocations(), before);
  }
}

TEST(Replay, WhatMovesLessThanTheDetailStaysAndAllElseIsAsItWas) {
  const Straight cut;
  const Field field = opening_field(canonical, 20, 16, 6, 2);
  const Replay whole(Wound(cut.incision, field, 1));
  std::vector<Vec3> moved(whole.vertex_count()), less(moved.size());
  EXPECT_EQ(whole.left_out(), 0u);
  std::size_t before = 0;
  for (const double detail : {1e-3, 0.05, 0.3}) {
    const Replay replay(Wound(cut.incision, field, 1), detail);
    EXPECT_GT(replay.left_out(), before);
    EXPECT_EQ(replay.left_out() + replay.active().size(), whole.active().size());
    before = replay.left_out();
    std::vector<bool> kept(moved.size());
    for (const ActiveVertex& a : replay.active()) kept[a.vertex] = true;
    for (double t = 0; t <= 10; t += 0.5) {
      whole.positions(t, moved), replay.positions(t, less);
      for (std::size_t i = 0; i < moved.size(); ++i)
        if (kept[i])
          ASSERT_EQ(less[i], moved[i]);
        else
          ASSERT_LE(norm(less[i] - moved[i]), detail);
    }
  }
}

TEST(Replay, AChosenFewMoveBitForBitAsBeforeAndNoneFurtherThanItsBound) {
  const Straight cut;
  const Replay whole(Wound(cut.incision, tip_field(), 1));  // has exceptions where the tip passes
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < whole.active().size(); ++i)
    if (i % 3 == 1 || i % 7 == 0) chosen.push_back(i);
  const Replay few = whole.of(chosen);
  EXPECT_EQ(few.left_out(), whole.active().size() - chosen.size());
  std::vector<Vec3> moved(whole.vertex_count()), less(moved.size()), expected(moved.size());
  for (double t = 0; t <= 10; t += 0.0371) {
    whole.positions(t, moved), few.positions(t, less);
    expected = whole.rest();
    for (const std::size_t i : chosen) {
      const std::size_t v = whole.active()[i].vertex;
      expected[v] = moved[v];
    }
    ASSERT_EQ(less, expected) << t;
    for (std::size_t i = 0; i < whole.active().size(); ++i) {
      const std::size_t v = whole.active()[i].vertex;
      ASSERT_LE(norm(moved[v] - whole.rest()[v]), whole.bound(i) * (1 + 1e-12)) << t;
    }
  }
}

TEST(Replay, TheChainAheadOfTheTipIsClosedAndBehindItOpen) {
  const Straight cut;
  const Replay replay(Wound(cut.incision, opening_field(canonical, 20, 16, 6, 2), 1));
  std::vector<Vec3> moved(replay.vertex_count());
  for (const double t : {0.0, 0.5, 3.0, 7.3, 10.0}) {
    replay.positions(t, moved);
    for (const auto& c : cut.incision.chain()) {
      if (c.left == c.right) continue;
      if (c.s >= t) {
        EXPECT_EQ(moved[c.left], moved[c.right]);
      } else {
        EXPECT_GT(moved[c.right].y - moved[c.left].y, 0.01);
      }
    }
  }
}

TEST(Replay, FollowsThePathsFrameAndTheMeshsUnits) {
  // The flat patch turned in space, in cm: displacements turn along.
  const Straight flat;
  const Vec3 a = normalized({1, 2, 2}), b = normalized(cross({0, 0, 1}, a)), c = cross(a, b);
  const auto turned = [&](const Vec3& p) { return 0.1 * (p.x * a + p.y * b + p.z * c) + Vec3{5, -7, 1}; };
  SurfaceMesh mesh = flat.plane;
  for (Vec3& p : mesh.points) p = turned(p);
  Incision incision(
      mesh,
      path_through(
          {turned({-5, 0, 0}), turned({5, 0, 0})}, [&](const Vec3&) { return c; }, canonical.depth / 10),
      unrefined());
  incision.advance_to(1);
  const Field field = opening_field(canonical, 20, 16, 6, 2);
  const Replay flat_replay(Wound(flat.incision, field, 1)), replay(Wound(incision, field, 10));
  ASSERT_EQ(replay.vertex_count(), flat_replay.vertex_count());
  std::vector<Vec3> flat_moved(replay.vertex_count()), moved(replay.vertex_count());
  for (const double t : {1.5, 6.5, 10.0}) {
    flat_replay.positions(t, flat_moved);
    replay.positions(t, moved);
    // v = 0 to rounding only: the spline is Lipschitz there, a slope of some gape / width.
    for (std::size_t i = 0; i < moved.size(); ++i) EXPECT_LT(norm(moved[i] - turned(flat_moved[i])), 1e-11);
  }
}

TEST(Replay, FadesOutBesideThePatch) {
  const Straight cut;
  const Field field = opening_field(canonical, 14, 8, 6, 2);  // smaller than the mesh
  const Replay replay(Wound(cut.incision, field, 1));
  EXPECT_LT(replay.active().size(), replay.vertex_count());
  for (const ActiveVertex& a : replay.active()) {
    const Vec3& p = replay.rest()[a.vertex];
    const bool inside = std::abs(p.x) <= 7 && std::abs(p.y) <= 4;
    EXPECT_EQ(a.weight == 1, inside);
    EXPECT_GT(a.weight, 0);
    EXPECT_LT(std::hypot(std::abs(p.x) - std::min(std::abs(p.x), 7.0),
                         std::abs(p.y) - std::min(std::abs(p.y), 4.0)),
              2);  // a quarter of the patch's width
  }
}

TEST(Replay, DoesNotReachThroughSpace) {
  // A sheet folded back under itself, 1 mm below: 10 mm of upper side beyond the cut, then the lower side.
  SurfaceMesh sheet = grid(40, 64, -20, -10, 0.5 * 2);
  for (Vec3& p : sheet.points) {
    const double beyond = p.y - 10;
    if (beyond > 0) p = {p.x, std::max(-40.0, 10 - std::max(0.0, beyond - 1)), -std::min(1.0, beyond)};
  }
  const SurfaceMesh flat = grid(40, 64, -20, -10, 1);
  Incision incision(sheet, path_through({{-5, 0.3, 0}, {5, 0.3, 0}}, up, 0.5));
  incision.advance_to(10);
  const Field field = opening_field(canonical, 20, 16, 6, 2);
  for (const ActiveVertex& a : IncisionVolume(incision, field, 1).active()) {
    if (a.vertex >= static_cast<int>(flat.points.size())) continue;
    EXPECT_LT(flat.points[a.vertex].y, 21) << "reached the lower side under the cut";
  }
}

TEST(Replay, LongPathsKeepBothEndsAndAreSteadyBetween) {
  const double length = 37;
  double before_u = -1e9, before_offset = 0;
  for (double s = -2; s <= length + 2; s += 0.01) {
    const CanonicalPlace place = canonical_place(s, length, canonical);
    EXPECT_GE(place.u, before_u);
    if (before_u > -1e8) {
      EXPECT_LE(place.u - before_u, 0.01 + 1e-9);
      EXPECT_LE(std::abs(place.time_offset - before_offset), 0.01 + 1e-9);
    }
    before_u = place.u, before_offset = place.time_offset;
    EXPECT_NEAR(place.time_offset, place.u - canonical.start - s, 1e-12);  // the blade passes at its own time
  }
  EXPECT_DOUBLE_EQ(canonical_place(3, length, canonical).u, -2);
  EXPECT_DOUBLE_EQ(canonical_place(20, length, canonical).u, 0);
  EXPECT_DOUBLE_EQ(canonical_place(length, length, canonical).u, 5);
  EXPECT_DOUBLE_EQ(canonical_place(6, 8, canonical).u, 1);
  EXPECT_DOUBLE_EQ(canonical_place(6, 8, canonical).time_offset, 0);
}

TEST(Replay, OnLongPathsEveryVertexHasATimeOfItsOwn) {
  Incision incision(grid(50, 16, -25, -8, 1), path_through({{-15, 0, 0}, {15, 0, 0}}, up, canonical.depth),
                    unrefined());
  incision.advance_to(30);
  for (const Field& field : {random_field(20, 16), tip_field()}) {
    const double tolerance = field.parametrization().moves() ? 1.0001e-4 : 1e-12;
    const Replay replay(Wound(incision, field, 1));
    std::vector<Vec3> moved(replay.vertex_count());
    for (double s = 0; s < 30; s += 0.617) {
      replay.positions(s, moved);
      for (const ActiveVertex& a : replay.active()) {
        const bool closed = a.on_cut && a.side != Side::both && a.s >= s;
        const Vec3 d =
            field.displacement(a.uvw, closed ? Side::both : a.side, std::clamp(s + a.time_offset, 0., 10.));
        const Vec3 expected =
            replay.rest()[a.vertex] + a.weight * (d.x * a.along + d.y * a.across + d.z * a.outward);
        if (std::abs(a.uvw.x + 5) < 1e-6 && field.parametrization().moves()) continue;  // see above
        ASSERT_LE(norm(moved[a.vertex] - expected), tolerance) << a.vertex << ' ' << s;
      }
    }
  }
}

TEST(Replay, ALongCutIsEquallyWideInItsMiddle) {
  const ScalpelPath path = path_through({{-15, 0, 0}, {15, 0, 0}}, up, canonical.depth);
  Incision incision(grid(50, 16, -25, -8, 1), path, unrefined());
  incision.advance_to(30);
  const Replay replay(Wound(incision, opening_field(canonical, 20, 16, 6, 2), 1));
  std::vector<Vec3> moved(replay.vertex_count());
  replay.positions(30, moved);
  double width = -1;
  for (const auto& c : incision.chain()) {
    const double gape = moved[c.right].y - moved[c.left].y;
    if (c.s < 5 || c.s > 25) continue;
    if (width < 0) width = gape;
    EXPECT_NEAR(gape, width, 1e-12);
  }
  EXPECT_GT(width, 0.1);
}

}  // namespace
}  // namespace cleft
