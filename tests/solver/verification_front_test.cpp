// The front of a cut in a mesh: openings are those of the cut as it was asked for, in coarse meshes too.
#include <gtest/gtest.h>

#include <cmath>

#include "params/meshed_cut.h"
#include "solver/companion.h"
#include "solver/cut_nodes.h"
#include "solver/patch_mesh.h"

namespace cleft {

namespace {

/// A slit of 16 mm in a sheet 25 times as wide, on next to nothing.
Parameters slit(TissueFormulation formulation, double poisson, double elements) {
  Parameters p;
  p.patch = {400, 400, 2};
  p.cut.length = 16, p.cut.depth = 1;
  p.mesh.grading = 1.1;
  // So many elements, of which parts are beyond the fronts, are as long as the size permits.
  p.tissue.formulation = formulation, p.tissue.poisson_ratio = poisson;
  p.mesh.element_size = 16 / (elements - 2 * front_parts(p).end) * (1 + 1e-9);
  p.skin.prestress = {0.01, 0.01, 0};
  p.tissue.young_modulus = 1e-6, p.foundation.stiffness = 1e-9, p.foundation.side_stiffness = 100;
  return p;
}

}  // namespace

/// In an endless sheet the middle opens by 4 a tension / E (Westergaard 1939). The sides, 25 half-lengths
/// away and held, cost less than 0.4 %. Of a cut that ends at its closed nodes 8 elements lack a tenth.
TEST(Front, ASlitOpensAsInAnEndlessSheetInAnyMesh) {
  for (const auto& [formulation, poisson] : {std::pair{TissueFormulation::displacement, 0.4},
                                             {TissueFormulation::mean_dilatation, 0.4},
                                             {TissueFormulation::mean_dilatation, 0.49}})
    for (const double elements : {8., 16.}) {
      Parameters p = slit(formulation, poisson, elements);
      const double expected = 4 * 8 * p.skin.prestress.vv / p.skin.young_modulus;
      constexpr double slack = 0.01;
      EXPECT_NEAR(gape_of(p, MPI_COMM_WORLD) / expected, 1, slack) << elements;
      p.mesh.front = MeshFront::nodes;
      EXPECT_LT(gape_of(p, MPI_COMM_WORLD) / expected, 1 - 4 * slack) << elements;
    }
}

/// Two sizes of elements through the depth agree within 1 %, where without the front's part they do not.
TEST(Front, TheOpeningDoesNotDependOnTheElementsInItsDepth) {
  for (const auto& [formulation, poisson] :
       {std::pair{TissueFormulation::displacement, 0.4}, {TissueFormulation::mean_dilatation, 0.49}}) {
    Parameters p;
    p.patch = {70, 60, 8};
    p.cut.length = 24, p.cut.depth = 3;
    p.tissue.formulation = formulation, p.tissue.poisson_ratio = poisson;
    std::vector<double> gapes;
    for (const double size : {2., 1.}) {
      p.mesh.element_size = size;
      gapes.push_back(gape_of(p, MPI_COMM_WORLD));
      p.mesh.front = MeshFront::nodes;
      gapes.push_back(gape_of(p, MPI_COMM_WORLD));
      p.mesh.front = MeshFront::effective;
    }
    const auto apart = [&](int a, int b) { return std::abs(gapes[a] / gapes[b] - 1); };
    EXPECT_LT(apart(0, 2), 0.01);
    EXPECT_GT(apart(1, 3), 0.015);
  }
}

/// The same under a tilted blade, with the formulation that its lips have.
TEST(Front, TheOpeningUnderATiltedBladeDoesNotDependOnTheElements) {
  Parameters p;
  p.patch = {50, 40, 8};
  p.cut.length = 16, p.cut.depth = 2.12, p.cut.tilt = 45, p.mesh.grading = 1.2;
  p.tissue.formulation = TissueFormulation::mean_dilatation;
  std::vector<double> gapes;
  for (const double size : {1., 0.7}) {
    p.mesh.element_size = size;
    gapes.push_back(gape_of(p, MPI_COMM_WORLD));
  }
  EXPECT_NEAR(gapes[0] / gapes[1], 1, 0.005);
}

/// Times and places are those of the fronts: the cut is as long and as deep as it was asked for.
TEST(Front, ACutEndsWhereItWasAskedTo) {
  for (const auto& [radius, tilt] : {std::pair{0., 0.}, {20., 0.}, {0., 45.}})
    for (const double branch : {0., 5.})
      for (const double size : {0.7, 1., 1.3, 2.}) {
        Parameters p;
        p.cut.length = 17, p.cut.depth = 2.5, p.cut.radius = radius, p.cut.branch = branch;
        p.cut.tilt = tilt;
        p.mesh.element_size = size;
        const PatchMesh mesh = make_patch_mesh(p);
        const Release release = make_release(mesh, p);
        EXPECT_NEAR(release.start, -8.5, 1e-12);
        EXPECT_NEAR(release.length, 17, 1e-12);
        EXPECT_NEAR(release.depth, 2.5, 1e-12);
        EXPECT_NEAR(release.times.back(), 17 + branch, 1e-12);
        const Vec3 start =
            radius > 0 ? Vec3{-20 * std::sin(8.5 / 20), 20 - 20 * std::cos(8.5 / 20), 0} : Vec3{-8.5, 0, 0};
        EXPECT_LT(norm(mesh.start - start), 1e-12);
        // All nodes that open are inside, and the next ones beyond, by the front's part of an element.
        const auto& lines = mesh.lines_along[0];
        EXPECT_NEAR(lines[0] + mesh.fronts.along, -8.5, 1e-12);
        EXPECT_NEAR(mesh.fronts.along / (lines[1] - lines[0]), front_parts(p).end, 1e-9);
        EXPECT_LE(lines[1] - lines[0], size * (1 + 1e-9));
        EXPECT_NEAR(mesh.lines_depth.back() - mesh.fronts.depth, 2.5, 1e-12);
        EXPECT_LE(mesh.lines_depth[1], size * (1 + 1e-9));
      }
}

}  // namespace cleft
