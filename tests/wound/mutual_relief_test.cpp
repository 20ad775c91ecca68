// How lips lean beside another cut, against the shear of its field by differences of displacements.
#include "explorer/wound/mutual_relief.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/incision/meshes.h"
#include "tests/support/recorded.h"

namespace cleft {
namespace {

using namespace testing;

const CanonicalCut canonical{-15, 30, 3};
constexpr double prestress = 0.03, thickness = 1.5, skin_young = 0.2, skin_poisson = 0.4, tissue_young = 0.2,
                 tissue_poisson = 0.3;

/// Opens as half an ellipse; across the cut displacements fall off exponentially, and from the skin to the
/// bottom of the cut as a parabola, which one layer does not integrate.
Field parabolic_field(double gape) {
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
  field.parameters = recorded({{"skin.prestress_v", prestress},
                               {"skin.thickness", thickness},
                               {"skin.young_modulus", skin_young},
                               {"skin.poisson_ratio", skin_poisson},
                               {"tissue.young_modulus", tissue_young},
                               {"tissue.poisson_ratio", tissue_poisson}});
  return field;
}

/// By how much further a field moves the skin across a line along u than what is as deep as the cut, and how
/// much more that rises across the line: the mean over half the depth to each side.
double shear_of(const Field& field, double u, double v) {
  constexpr int parts = 60;
  constexpr double h = 1e-4;
  const auto moved = [&](double across, double w) {
    return field.displacement({u, across, w}, Side::both, canonical.length);
  };
  double sum = 0;
  for (int i = 0; i < parts; ++i) {
    const double across = v + canonical.depth * ((i + 0.5) / parts - 0.5);
    sum += (moved(across, 0).y - moved(across, -canonical.depth).y) / parts;
    for (int k = 0; k < parts; ++k) {
      const double w = -canonical.depth * (k + 0.5) / parts;
      sum += canonical.depth / parts * (moved(across + h, w).z - moved(across - h, w).z) / (2 * h) / parts;
    }
  }
  return sum;
}

/// Two cuts along x, each as long as the fields', of a flat mesh.
class TwoCuts {
 public:
  TwoCuts(const Field& first, double y, const Field& second, double other_y)
      : mesh_(grid(40, 30, -40.3, -30.1, 2)),
        y_{y, other_y},
        fields_{&first, &second},
        cuts_{made(y), made(other_y)},
        wounds_{Wound(*cuts_[0], first, 1), Wound(*cuts_[1], second, 1)} {}

  std::vector<Amplitude> amplitudes() const {
    return mutual_relief({&wounds_[0], &wounds_[1]}, {30}).front();
  }
  const Wound& wound(int i) const { return wounds_[i]; }

 private:
  std::unique_ptr<Incision> made(double y) {
    IncisionOptions options;
    options.max_edge = 0;
    auto cut = std::make_unique<Incision>(mesh_, path_through({{-15, y, 0}, {15, y, 0}}, up, 3), options);
    cut->advance_to(30);
    return cut;
  }

  CutMesh mesh_;
  double y_[2];
  const Field* fields_[2];
  std::unique_ptr<Incision> cuts_[2];
  Wound wounds_[2];
};

TEST(Leaning, IsWithTheShearOfTheOtherCutAndNoneOfFieldsThatDoNotOpen) {
  const Field opens = parabolic_field(3), closes = parabolic_field(-2);
  // 8 mm apart, and 4, a depth and a third, where they lean more beside a shallow cut.
  for (const auto& [field, apart, leaning] : {std::tuple{&opens, 8., 1.2},
                                              {&closes, 8., 1.2},
                                              {&opens, 4., 1.2 * (1 + 0.95 * (thickness / 3 - 0.3))}}) {
    const TwoCuts two(*field, -apart / 2, *field, apart / 2);
    const std::vector<Amplitude> found = two.amplitudes();
    for (std::size_t k = 0; k < found[0].stations.size(); ++k) {
      const double s = found[0].stations[k], u = canonical.start + s;
      const double opening = field->displacement({u, 0, 0}, Side::right, 30).y -
                             field->displacement({u, 0, 0}, Side::left, 30).y;
      const double toward_end = std::min(1., std::sqrt(std::min(s, 30 - s) / (0.6 * canonical.depth)));
      // The second cut is at v > 0 of the first: there lips sink.
      const double expected =
          opening > 0 ? leaning * toward_end * shear_of(*field, u, -apart) * found[1].at(s) / opening : 0;
      EXPECT_NEAR(found[0].leans[k], std::max(-1., expected), 0.01 * std::abs(expected)) << s;
      EXPECT_NEAR(found[1].leans[k], -found[0].leans[k], 1e-6) << s;
    }
    if (field == &opens) EXPECT_LT(found[0](15).lean, -0.1);
    if (field == &closes) EXPECT_EQ(found[0](15).lean, 0);
  }
}

/// A cut that leaves another one to its left leans its lips as one that leaves it to its right.
TEST(Leaning, IsAlikeBesideBranchesToBothSides) {
  const Field field = parabolic_field(3);
  std::array<Amplitude, 2> found;
  for (const int side : {0, 1}) {
    CutMesh mesh{grid(40, 30, -40.3, -30.1, 2)};
    const double up_or_down = side == 0 ? 1 : -1;
    IncisionOptions options;
    options.max_edge = 0;
    Incision main(mesh, path_through({{-15, 0, 0}, {15, 0, 0}}, up, 3), options);
    main.advance_to(30);
    Incision branch(mesh, path_through({{-0.05, -0.1 * up_or_down, 0}, {6, 12 * up_or_down, 0}}, up, 3),
                    options);
    branch.advance_to(branch.path().length());
    Wound of_main(main, field, 1), of_branch(branch, field, 1);
    ASSERT_TRUE(of_branch.opens_into(of_main, false));
    of_branch.volume.opens_into(main, false);
    found[side] = mutual_relief({&of_main, &of_branch}, {branch.path().length()}).front()[0];
  }
  double largest = 0;
  for (double s = 1; s < 30; s += 1) {
    largest = std::max(largest, std::abs(found[0](s).lean));
    EXPECT_NEAR(found[1](s).lean, -found[0](s).lean, 0.01) << s;
  }
  EXPECT_GT(largest, 0.1);
}

TEST(Leaning, MovesLipsUprightAndAlongTheCutInProportionToTheirDisplacementAcross) {
  const Field field = parabolic_field(3);
  const TwoCuts two(field, -4, field, 4);
  const Relief relief(two.amplitudes());
  const Relief::At now = relief.at(1);
  const auto relieved = [&](double u, double v, const Vec3& alone) {
    ActiveVertex at;
    at.s = u - canonical.start, at.uvw = {u, v, 0};
    at.along = {1, 0, 0}, at.across = {0, 1, 0}, at.outward = {0, 0, 1};
    return now.relieved(0, BesideCut(at, two.wound(0)), alone);
  };
  const double a = now.amplitude(0, 15), lean = relief.amplitude(0, 0)(15).lean;
  ASSERT_LT(lean, 0);
  const auto expect = [](const Vec3& found, const Vec3& expected) {
    EXPECT_NEAR(norm(found - expected), 0, 1e-4) << found.x << ", " << found.y << ", " << found.z;
  };
  ASSERT_NEAR(relief.amplitude(0, 0)(15).shift, 0, 1e-4);
  expect(relieved(0, 0, {0, 2, 0}), {0, 2 * a, 2 * lean});     // at v > 0, next to the other cut, it sinks
  expect(relieved(0, 0, {0, -2, 0}), {0, -2 * a, -2 * lean});  // beyond it rises
  expect(relieved(0, 0, {1, 0, 3}), {a, 0, 3 * a});
  expect(relieved(0, -2, {0, -2, 0}),
         {0, -2 * a, -2 * lean * std::exp(-1.)});  // two thirds of the depth away
  const Amplitude::At end = relief.amplitude(0, 0)(22.5);
  EXPECT_GT(end.shift, 0.01);  // toward the end, where the strip becomes longer
  expect(relieved(7.5, 0, {0, 2, 0}), {2 * end.shift, 2 * end.value, 2 * end.lean});
  expect(now.relieved(5, {}, {1, 2, 3}), {1, 2, 3});  // a cut that is not known
}

}  // namespace
}  // namespace cleft
