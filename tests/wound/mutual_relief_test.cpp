// Two cuts of one skin: limits and symmetries of how they relieve each other. Against simulations they are
// compared in tests/truth, and the membrane against closed forms in cut_membrane_test.cpp.
#include "explorer/wound/mutual_relief.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>

#include "tests/incision/meshes.h"
#include "tests/support/recorded.h"

namespace cleft {
namespace {

using namespace testing;

const CanonicalCut canonical{-15, 30, 3};
constexpr double prestress = 0.03;

/// Opens as half an ellipse, half as wide when half is cut: in a sheet that nothing holds from below.
Field elliptic_field(double gape) {
  const BSplineBasis u = BSplineBasis::uniform(3, 32, -25, 25), v = BSplineBasis::broken(3, 16, -25, 0, 25),
                     w = BSplineBasis::uniform(3, 8, -6, 0), t = BSplineBasis::uniform(3, 12, 0, 30);
  const auto greville = [](const BSplineBasis& b, int i) {
    return (b.knots()[i + 1] + b.knots()[i + 2] + b.knots()[i + 3]) / 3;
  };
  std::vector<Vec3> c;
  for (int i = 0; i < u.size(); ++i)
    for (int j = 0; j < v.size(); ++j)
      for (int k = 0; k < w.size(); ++k)
        for (int l = 0; l < t.size(); ++l) {
          const double x = greville(u, i) - canonical.start, y = greville(v, j);
          const double height = std::max(0., 1 + greville(w, k) / canonical.depth);
          const double g = gape * std::sqrt(std::max(0., x * (greville(t, l) - x))) / canonical.length *
                           std::exp(-0.06 * std::abs(y)) * height * height;
          c.push_back({0.1 * g, j < v.size() / 2 ? -g : g, 0.1 * g});
        }
  Field field(u, v, w, t, std::move(c), canonical);
  field.parameters = recorded({{"skin.prestress_v", prestress}});
  return field;
}

/// Two straight cuts of a flat mesh, each as long as the field's.
class TwoCuts {
 public:
  using Ends = std::array<Vec3, 2>;
  TwoCuts(const Field& field, const Ends& first, const Ends& second)
      : mesh_(grid(60, 50, -60.3, -50.1, 2)),
        cuts_{made(first), made(second)},
        wounds_{Wound(*cuts_[0], field, 1), Wound(*cuts_[1], field, 1)} {}

  std::vector<Amplitude> amplitudes(double blade = 30) const {
    return mutual_relief({&wounds_[0], &wounds_[1]}, blade);
  }
  const Wound& wound(int i) const { return wounds_[i]; }

 private:
  std::unique_ptr<Incision> made(const Ends& ends) {
    IncisionOptions options;
    options.max_edge = 0;
    auto cut = std::make_unique<Incision>(mesh_, path_through({ends[0], ends[1]}, up, 3), options);
    cut->advance_to(30);
    return cut;
  }

  CutMesh mesh_;
  std::unique_ptr<Incision> cuts_[2];
  Wound wounds_[2];
};

TwoCuts::Ends along_x(double y, double x = 0) { return {Vec3{x - 15, y, 0}, Vec3{x + 15, y, 0}}; }

TEST(MutualRelief, CutsNextToEachOtherOpenAsOneTogether) {
  const Field field = elliptic_field(3);
  const std::vector<Amplitude> close = TwoCuts(field, along_x(-0.4), along_x(0.4)).amplitudes();
  for (const Amplitude& one : close) EXPECT_NEAR(one.at(15).across, 0.5, 0.02);
  double before = close[0].at(15).across;
  for (const double apart : {3., 8., 20., 60.}) {  // the further apart, the less they feel each other
    const double now = TwoCuts(field, along_x(-apart / 2), along_x(apart / 2)).amplitudes()[0].at(15).across;
    EXPECT_GT(now, before) << apart;
    EXPECT_LT(now, 1) << apart;
    before = now;
  }
  EXPECT_GT(before, 0.85);
}

TEST(MutualRelief, ACutOpensTheOneThatItLeadsOnTo) {
  const Field field = elliptic_field(3);
  const std::vector<Amplitude> found = TwoCuts(field, along_x(0, -16), along_x(0, 16)).amplitudes();
  EXPECT_GT(found[0].at(29).across, 1.2);
  EXPECT_GT(found[0].at(29).across, found[0].at(15).across + 0.1);
  EXPECT_GT(found[0].at(1).across, 1);
  EXPECT_NEAR(found[0].at(10).across, found[1].at(20).across, 1e-9);
  EXPECT_NEAR(found[0].at(29).lean, 0, 1e-9);
}

TEST(MutualRelief, ParallelCutsAreMirrorImages) {
  const Field field = elliptic_field(3);
  const std::vector<Amplitude> found = TwoCuts(field, along_x(-4), along_x(4)).amplitudes();
  for (const double s : {2., 9., 15., 26.}) {
    const Amplitude::Value here = found[0].at(s), there = found[1].at(s), back = found[0].at(30 - s);
    EXPECT_NEAR(here.across, there.across, 1e-9) << s;
    EXPECT_NEAR(here.across, back.across, 1e-9) << s;
    EXPECT_NEAR(here.slide, -there.slide, 1e-9) << s;
    EXPECT_NEAR(here.slide, -back.slide, 1e-9) << s;
    EXPECT_NEAR(here.lean, -there.lean, 1e-9) << s;
  }
  // The strip between them becomes longer: its lip of the first cut, at v > 0, moves on along at the end.
  EXPECT_GT(found[0].at(26).slide, 0.02);
  // And sinks.
  EXPECT_LT(found[0].at(15).lean, -0.05);
}

TEST(MutualRelief, BesideTheNewestItGrowsWithTheBlade) {
  const Field field = elliptic_field(3);
  const TwoCuts two(field, along_x(-4), along_x(4));
  double before = 1;
  for (const double blade : {0., 10., 20., 30.}) {
    const std::vector<Amplitude> found = two.amplitudes(blade);
    const double now = found[0].at(4).across;
    if (blade == 0)
      EXPECT_EQ(now, 1);
    else
      EXPECT_LT(now, before) << blade;
    ASSERT_EQ(found[0].stations, two.amplitudes(30)[0].stations);
    before = now;
  }
}

TEST(MutualRelief, CutsThatCrossAtARightAngleDoNotLean) {
  const Field field = elliptic_field(3);
  const TwoCuts two(field, along_x(0), {Vec3{0, -15, 0}, Vec3{0, 15, 0}});
  for (const Amplitude& one : two.amplitudes())
    for (const Amplitude::Value& value : one.values) EXPECT_NEAR(value.lean, 0, 1e-9);
}

TEST(MutualRelief, MovesLipsAlongAndUprightInProportionToTheirDisplacementAcross) {
  const Field field = elliptic_field(3);
  const TwoCuts two(field, along_x(-4), along_x(4));
  const Relief relief({two.amplitudes()});
  const Relief::At now = relief.at(1);
  const auto relieved = [&](double u, double v, const Vec3& alone) {
    ActiveVertex at;
    at.s = u - canonical.start, at.uvw = {u, v, 0};
    at.along = {1, 0, 0}, at.across = {0, 1, 0}, at.outward = {0, 0, 1};
    return now.relieved(0, BesideCut(at, two.wound(0)), alone);
  };
  const auto expect = [](const Vec3& found, const Vec3& expected) {
    EXPECT_NEAR(norm(found - expected), 0, 1e-12) << found.x << ", " << found.y << ", " << found.z;
  };
  const auto [across, slide, lean] = now.amplitude(0, 22.5);
  ASSERT_LT(lean, 0);
  ASSERT_GT(slide, 0);
  expect(relieved(7.5, 0, {0, 2, 0}), {2 * slide, 2 * across, 2 * lean});  // at v > 0 it sinks
  expect(relieved(7.5, 0, {0, -2, 0}), {-2 * slide, -2 * across, -2 * lean});
  expect(relieved(7.5, 0, {1, 0, 3}), {across, 0, 3 * across});
  expect(relieved(7.5, -2, {0, -2, 0}),
         {-2 * slide, -2 * across, -2 * lean * std::exp(-1.)});  // two thirds of the depth away
  expect(now.relieved(5, {}, {1, 2, 3}), {1, 2, 3});             // a cut that is not known
}

}  // namespace
}  // namespace cleft
