// The amplitudes of two parallel cuts, as of cuts that meet, against the linear system that they solve: its
// coefficients come from the field's displacements alone, by differences and a fine integration through the
// depth, and it is solved by elimination.
#include "explorer/wound/mutual_relief.h"

#include <gtest/gtest.h>

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

/// What a field changes of the tension across a line along u, over the tension.
struct Influence {
  double ratio = 0;
  double six_layers_off = 0;  ///< at most: the composite midpoint rule's h^2 / 24 times the second derivative
};

Influence influence_of(const Field& field, double u, double v) {
  const auto strain = [&](double w, int axis) {
    constexpr double small = 1e-4;
    const double h = axis == 0 ? canonical.depth / 2 : small;  // along the other cut the mean over its depth
    Vec3 step;
    step[axis] = h;
    const Vec3 at{u, v, std::min(w, -small)};  // the skin's own upright strain is not asked for
    const Vec3 rise = field.displacement(at + step, Side::both, canonical.length) -
                      field.displacement(at - step, Side::both, canonical.length);
    return rise[axis] / (2 * h);
  };
  const double shear = tissue_young / (2 * (1 + tissue_poisson)),
               lame = 2 * shear * tissue_poisson / (1 - 2 * tissue_poisson);
  const auto stress = [&](double w) {
    return 2 * shear * strain(w, 1) + lame * (strain(w, 0) + strain(w, 1) + strain(w, 2));
  };
  constexpr int parts = 400;
  constexpr double h = 3. / parts;
  std::vector<double> samples;
  for (int i = 0; i < parts; ++i) samples.push_back(stress(-h * (i + 0.5)));
  double force = thickness * skin_young / (1 - skin_poisson * skin_poisson) *
                 (strain(0, 1) + skin_poisson * strain(0, 0));
  double bend = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    force += h * samples[i];
    if (i > 0 && i + 1 < samples.size())
      bend = std::max(bend, std::abs(samples[i - 1] - 2 * samples[i] + samples[i + 1]) / (h * h));
  }
  const double layer = canonical.depth / 6;
  return {force / (thickness * prestress),
          canonical.depth * layer * layer / 24 * bend / (thickness * prestress)};
}

/// The mean of values that are linear between stations, over twice the depth to each side within the path,
/// with weights that fall to 0 there.
double mean(const std::vector<double>& stations, const std::vector<double>& values, double s) {
  const Amplitude linear{stations, values};
  constexpr int parts = 2000;
  double sum = 0, weights = 0;
  for (int k = 0; k < parts; ++k) {
    const double part = (2. * k + 1) / parts - 1, there = s + part * 2 * canonical.depth;
    if (there < stations.front() || there > stations.back()) continue;
    sum += (1 - std::abs(part)) * linear.at(there), weights += 1 - std::abs(part);
  }
  return sum / weights;
}

/// By Gaussian elimination with pivots; each row ends with its right-hand side.
std::vector<double> solved(std::vector<std::vector<double>> rows) {
  const std::size_t n = rows.size();
  for (std::size_t k = 0; k < n; ++k) {
    const auto pivot =
        std::max_element(rows.begin() + static_cast<std::ptrdiff_t>(k), rows.end(),
                         [k](const auto& a, const auto& b) { return std::abs(a[k]) < std::abs(b[k]); });
    std::swap(rows[k], *pivot);
    for (std::size_t i = k + 1; i < n; ++i) {
      const double factor = rows[i][k] / rows[k][k];
      for (std::size_t j = k; j <= n; ++j) rows[i][j] -= factor * rows[k][j];
    }
  }
  std::vector<double> x(n);
  for (std::size_t k = n; k-- > 0;) {
    x[k] = rows[k][n];
    for (std::size_t j = k + 1; j < n; ++j) x[k] -= rows[k][j] * x[j];
    x[k] /= rows[k][k];
  }
  return x;
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

  std::vector<Amplitude> amplitudes() const { return relief_of_meeting_cuts({&wounds_[0], &wounds_[1]}, 30); }
  const Wound& wound(int i) const { return wounds_[i]; }

  Influence influence(std::size_t cut, double s) const {
    return influence_of(*fields_[1 - cut], canonical.start + s, y_[cut] - y_[1 - cut]);
  }

  /// A_i(s) - r_ij(s) A_j(s) = 1 at the stations of both, amplitudes being linear between them.
  std::vector<double> eliminated(const std::vector<Amplitude>& stations) const {
    const std::size_t n[2] = {stations[0].stations.size(), stations[1].stations.size()};
    std::vector<std::vector<double>> rows(n[0] + n[1], std::vector<double>(n[0] + n[1] + 1, 0));
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t k = 0; k < n[i]; ++k) {
        std::vector<double>& row = rows[i * n[0] + k];
        row.back() = 1, row[i * n[0] + k] += 1;
        const double s = stations[i].stations[k], r = influence(i, s).ratio;
        const std::vector<double>& others = stations[1 - i].stations;
        std::size_t next = 1;
        while (next + 1 < others.size() && others[next] < s) ++next;
        const double part = std::clamp((s - others[next - 1]) / (others[next] - others[next - 1]), 0., 1.);
        row[(1 - i) * n[0] + next - 1] -= r * (1 - part);
        row[(1 - i) * n[0] + next] -= r * part;
      }
    return solved(rows);
  }

  /// By how much amplitudes may be off: the layers' error, over 1 - |r|, and what 60 rounds leave of one.
  double tolerance(const std::vector<Amplitude>& amplitudes) const {
    double off = 0, largest = 0, strongest = 0;
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t k = 0; k < amplitudes[i].stations.size(); ++k) {
        const Influence one = influence(i, amplitudes[i].stations[k]);
        off = std::max(off, one.six_layers_off);
        strongest = std::max(strongest, std::abs(one.ratio));
        largest = std::max(largest, amplitudes[i].values[k]);
      }
    EXPECT_LT(strongest, 0.7);
    return off * largest / (1 - strongest) + std::pow((1 + strongest) / 2, 60) + 1e-6;
  }

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

/// Of a cut that relieves the other, and of one that adds to its tension: there rounds approach slowly.
class MutualRelief : public ::testing::TestWithParam<double> {};

TEST_P(MutualRelief, OfTwoEqualParallelCutsIsOneOverOneMinusTheInfluence) {
  const Field field = parabolic_field(GetParam());
  const TwoCuts two(field, -4, field, 4);  // four squares of the mesh apart: of the same stations
  const std::vector<Amplitude> found = two.amplitudes();
  ASSERT_EQ(found[0].stations.size(), found[1].stations.size());
  ASSERT_GT(found[0].stations.size(), 10u);
  const double tolerance = two.tolerance(found);
  double most = 0;
  for (const std::size_t i : {0u, 1u}) {
    std::vector<double> local;
    for (const double s : found[i].stations) local.push_back(1 / (1 - two.influence(i, s).ratio));
    for (std::size_t k = 0; k < found[i].stations.size(); ++k) {
      const double s = found[i].stations[k], expected = mean(found[i].stations, local, s);
      EXPECT_NEAR(found[i].values[k], expected, tolerance) << "cut " << i << " at " << s;
      most = std::max(most, std::abs(expected - 1));
    }
  }
  EXPECT_GT(most, 20 * tolerance) << "cuts that hardly feel each other would show nothing";
}

TEST_P(MutualRelief, OfTwoCutsOfDifferentFieldsSolvesTheirLinearSystem) {
  const Field strong = parabolic_field(GetParam()), weak = parabolic_field(0.4 * GetParam());
  const TwoCuts two(strong, -3.7, weak, 3.1);
  const std::vector<Amplitude> found = two.amplitudes();
  const std::vector<double> local = two.eliminated(found);
  const double tolerance = two.tolerance(found);
  const auto second = local.begin() + static_cast<std::ptrdiff_t>(found[0].values.size());
  const std::vector<double> of[] = {{local.begin(), second}, {second, local.end()}};
  for (const std::size_t i : {0u, 1u})
    for (std::size_t k = 0; k < of[i].size(); ++k)
      EXPECT_NEAR(found[i].values[k], mean(found[i].stations, of[i], found[i].stations[k]), tolerance)
          << "cut " << i << " at " << found[i].stations[k];
}

TEST(Leaning, IsAwayFromTheCutThatRelievesAndNoneBesideOneThatAdds) {
  const Field relieves = parabolic_field(3), adds = parabolic_field(-2);
  for (const Field* field : {&relieves, &adds}) {
    const TwoCuts two(*field, -4, *field, 4);
    const std::vector<Amplitude> found = two.amplitudes();
    const double tolerance = two.tolerance(found);
    for (std::size_t k = 0; k < found[0].stations.size(); ++k) {
      const double s = found[0].stations[k];
      // The second cut is at v > 0 of the first: there lips sink by a quarter of what it takes of the
      // tension.
      const double expected = 0.25 * std::min(0., two.influence(0, s).ratio * found[1].at(s));
      EXPECT_NEAR(found[0].leans[k], expected, tolerance) << s;
      EXPECT_NEAR(found[1].leans[k], -found[0].leans[k], 1e-6) << s;
    }
    if (field == &relieves) EXPECT_LT(found[0](15).lean, -20 * tolerance);
    if (field == &adds) EXPECT_EQ(found[0](15).lean, 0);
  }
}

TEST(Leaning, MovesLipsUprightAndAlongTheCutInProportionToTheirDisplacementAcross) {
  const Field field = parabolic_field(3);
  const TwoCuts two(field, -4, field, 4);
  const Relief relief({two.amplitudes()});
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
    // Shifts are linear between stations, of which leans and the way from the middle are a product.
    EXPECT_NEAR(norm(found - expected), 0, 2e-4) << found.x << ", " << found.y << ", " << found.z;
  };
  expect(relieved(0, 0, {0, 2, 0}), {0, 2 * a, 2 * lean});     // at v > 0, next to the other cut, it sinks
  expect(relieved(0, 0, {0, -2, 0}), {0, -2 * a, -2 * lean});  // beyond it rises
  expect(relieved(0, 0, {1, 0, 3}), {a, 0, 3 * a});
  expect(relieved(0, -2, {0, -2, 0}),
         {0, -2 * a, -2 * lean * std::exp(-1.)});  // two thirds of the depth away
  const double end = relief.amplitude(0, 0)(22.5).lean, of_end = now.amplitude(0, 22.5);
  expect(relieved(7.5, 0, {0, 2, 0}), {-0.5 * 2 * end, 2 * of_end, 2 * end});
  expect(now.relieved(5, {}, {1, 2, 3}), {1, 2, 3});  // a cut that is not known
}

INSTANTIATE_TEST_SUITE_P(RelievingAndAdding, MutualRelief, ::testing::Values(3., -2.));

}  // namespace
}  // namespace cleft
