// The skin alone against slits, strips and strings in closed form.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/solver/small_patch.h"
#include "tests/solver/verification_support.h"
#include "tests/support/even_piece.h"

namespace cleft {

namespace {

constexpr double tension = 0.02;  // MPa

/// A sheet with a slit of half-length a, ten times as wide, with elements of 1 mm at the slit: the sides
/// held, all nodes in plane, and the nodes below tied to those above.
struct Slit {
  Slit(double half_length, const Parameters& material) : a(half_length), p(material) {
    p.patch.length = p.patch.width = 20 * a, p.patch.height = 2;
    p.cut.length = 2 * a, p.cut.depth = 1;
    p.mesh.grading = 1.1;
    mesh = sheet_of(make_patch_mesh(p), p.patch.height);
  }

  /// Of the middle, under equal tension along both axes with the thickness of the skin.
  double opening() const {
    Parameters sheet = p;
    sheet.foundation.stiffness = none, sheet.foundation.side_stiffness = 0;
    sheet.skin.prestress.uu = sheet.skin.prestress.vv = tension;
    const PatchSystem system(mesh, sheet, MPI_COMM_WORLD);
    Conditions conditions(system);
    const int count = static_cast<int>(mesh.points.size()) / 2;
    for (int n = 0; n < count; ++n) {
      const Vec3& at = mesh.points[n];
      const bool held = std::max(std::abs(at.x), std::abs(at.y)) == 10 * a;
      for (int axis = 0; axis < 3; ++axis) {
        conditions.tie(n + count, n, axis);
        if (held || axis == 2) conditions.fix(n, axis);
      }
    }
    const Eigen::VectorXd u = conditions.solve(system.load(sheet.skin));
    for (const NodePair& pair : mesh.pairs)
      if (pair.along == 0) return u[system.unknown(pair.right, 1)] - u[system.unknown(pair.left, 1)];
    return 0;
  }

  double a;
  Parameters p = even_piece();
  PatchMesh mesh;
};

Parameters bare() {
  Parameters p = even_piece();
  p.tissue.young_modulus = p.skin.young_modulus = p.foundation.stiffness = none;
  p.foundation.side_stiffness = 0;
  p.skin.prestress = {};
  return p;
}

}  // namespace

TEST(Skin, SlitOpensAsInAnEndlessSheet) {
  Parameters p = bare();
  p.skin.young_modulus = 0.13;
  const auto deviation = [&](double a) {
    return Slit(a, p).opening() / (4 * tension / p.skin.young_modulus * a) - 1;
  };
  const double coarse = deviation(2), middle = deviation(4), fine = deviation(8);
  // A program of its own, half of the sheet in triangles of 1 mm all over, halved in the same way, found
  // -22.6, -12.1 and -6.5 %; the larger triangles far from the slit change that by less than half a point.
  EXPECT_NEAR(coarse, -0.226, 0.005);
  EXPECT_NEAR(middle, -0.121, 0.005);
  EXPECT_NEAR(fine, -0.065, 0.005);
  // Tips as sharp as sqrt(r) cost O(h). What remains is the held sides and the next order: that program finds
  // -1.0 % here, -1.6 % from slits twice as long, and with sides twice as far away +0.3 %.
  EXPECT_NEAR(2 * fine - middle, -0.010, 0.005);
}

TEST(Skin, PlaneStrainOfTheTissueIsPlaneStressOfAStifferSkin) {
  // E / (1 - nu^2) and nu / (1 - nu) of the tissue give Griffith's opening 4 (1 - nu^2) sigma a / E.
  Parameters tissue = bare(), skin = bare();
  tissue.tissue.young_modulus = 0.02, tissue.tissue.poisson_ratio = 0.3;
  skin.skin.young_modulus = 0.02 / (1 - 0.09), skin.skin.poisson_ratio = 0.3 / 0.7;
  skin.skin.thickness = tissue.skin.thickness = 2;  // as high as the sheet
  const double opening = Slit(4, tissue).opening();
  EXPECT_NEAR(opening / Slit(4, skin).opening(), 1, 1e-10);
  EXPECT_NEAR(opening / (4 * 0.91 * tension / 0.02 * 4), 1, 0.15);  // as above: O(h)
}

TEST(Skin, LongCutOnConsistentSpringsGapesAsDerived) {
  // A strip one element wide, free where the cut is, on springs; narrowing across is prevented (plane strain
  // along the cut). With unknowns u_0, u_1, ... along the strip, c = E' t / h for a strip of unit width:
  //   (c + k h / 3) u_0 - (c - k h / 6) u_1 = N,   u_m = u_0 exp(-m theta),
  // and inside 2 (c + k h / 3) u_m - (c - k h / 6) (u_(m-1) + u_(m+1)) = 0.
  Parameters p = bare();
  p.skin.young_modulus = 0.13, p.foundation.stiffness = 0.005, p.skin.prestress.vv = tension;
  p.patch.height = 1;
  const double h = 0.6, k = p.foundation.stiffness, t = p.skin.thickness;
  constexpr int length = 400;  // elements: over 35 decay lengths
  const PatchMesh mesh = box_mesh(p.tissue.formulation, {0, h}, even_lines(0, length * h, length), {-1, 0});
  const PatchSystem system(mesh, p, MPI_COMM_WORLD);
  Conditions conditions(system);
  for (int n = 0; n < static_cast<int>(mesh.points.size()); ++n) {
    conditions.fix(n, 0), conditions.fix(n, 2);
    const int row = static_cast<int>(std::lround(mesh.points[n].y / h));
    conditions.tie(n, 2 * row, 1);  // the four nodes at one v move as one
  }
  const Eigen::VectorXd u = conditions.solve(system.load(p.skin));
  const double gape = 2 * u[system.unknown(0, 1)];

  const double stiff = p.skin.young_modulus / (1 - 0.16) * t / h, force = t * tension;
  const auto derived = [&](double own, double other) {  // part of a spring at its node, and at the next one
    const double theta = std::acosh((stiff + own * k * h) / (stiff - other * k * h));
    return 2 * force / (stiff + own * k * h - (stiff - other * k * h) * std::exp(-theta));
  };
  const double consistent = derived(1. / 3, 1. / 6), lumped = derived(1. / 2, 0);
  // Tissue of the modulus `none` and rounding: 1e-14 times a condition number of about 1e2.
  EXPECT_NEAR(gape / consistent, 1, 1e-10);
  // Against the continuum, 2 N / sqrt(E' t k): the expansions in k h^2 / (E' t) end here after the first
  // term.
  const double order = k * h / stiff, continuum = 2 * force / std::sqrt(stiff * h * k);
  EXPECT_NEAR(consistent / continuum - 1, -order / 24, order * order);
  EXPECT_NEAR(lumped / continuum - 1, -order / 8, order * order);
  EXPECT_GT(order / 12, 1e-4) << "the test could not tell lumped springs";
}

TEST(Skin, PrestressHoldsAStringUnderLoad) {
  // w = q x (L - x) / (2 N) at the nodes: linear elements are exact there.
  Parameters p = bare();
  p.skin.prestress = {tension, 0.5 * tension, 0.3 * tension};
  p.skin.initial_stress_stiffness = true;
  p.patch.height = 1;
  constexpr int length = 12;
  const PatchMesh mesh = box_mesh(p.tissue.formulation, even_lines(0, length, length), {0, 1}, {-1, 0});
  const PatchSystem system(mesh, p, MPI_COMM_WORLD);
  const Eigen::VectorXd areas = areas_of_nodes(mesh, mesh.skin);
  const double pressure = 1e-4;
  Conditions conditions(system);
  Eigen::VectorXd load = Eigen::VectorXd::Zero(system.size());
  for (int n = 0; n < static_cast<int>(mesh.points.size()); ++n) {
    const int column = static_cast<int>(mesh.points[n].x);
    load[system.unknown(n, 2)] = pressure * areas[n];
    conditions.fix(n, 0), conditions.fix(n, 1);
    conditions.tie(n, column, 2);
  }
  conditions.fix(0, 2), conditions.fix(length, 2);
  const Eigen::VectorXd w = conditions.solve(load);
  const double force = p.skin.thickness * tension, middle = pressure * length * length / (8 * force);
  for (int i = 0; i <= length; ++i)
    EXPECT_NEAR(w[system.unknown(i, 2)], pressure * i * (length - i) / (2 * force), 1e-10 * middle);
}

TEST(Skin, PrestressHasTheEnergyOfASlope) {
  Parameters p = bare();
  p.patch = {10, 6, 3}, p.cut.length = 6, p.cut.depth = 2;
  p.skin.prestress = {0.011, 0.03, 0.007};
  const PatchMesh mesh = make_patch_mesh(p);
  const PatchSystem without(mesh, p, MPI_COMM_WORLD);
  p.skin.turning_stiffness = 0.5;
  const PatchSystem turning(mesh, p, MPI_COMM_WORLD);
  p.skin.turning_stiffness = 0, p.skin.initial_stress_stiffness = true;
  const PatchSystem with(mesh, p, MPI_COMM_WORLD);
  const double a = 0.3, b = -0.7;
  const double energy = p.skin.thickness * 10 * 6 / 2 * (0.011 * a * a + 2 * 0.007 * a * b + 0.03 * b * b);
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::VectorXd u = Eigen::VectorXd::Zero(with.size());
    for (int n = 0; n < static_cast<int>(mesh.points.size()); ++n)
      u[with.unknown(n, axis)] = a * mesh.points[n].x + b * mesh.points[n].y;
    const Eigen::VectorXd force = with.multiply(u) - without.multiply(u);
    EXPECT_NEAR(u.dot(force) / 2 / energy, 1, 1e-12);  // a sum of some hundred terms
    const Eigen::VectorXd out_of_plane = turning.multiply(u) - without.multiply(u);
    EXPECT_NEAR(u.dot(out_of_plane) / 2 / energy, axis == 2 ? 0.5 : 0, 1e-12);
  }
}

}  // namespace cleft
