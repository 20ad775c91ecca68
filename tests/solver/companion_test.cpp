// Expected errors of mesh and patch, against finer meshes and wider patches.
#include "solver/companion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "solver/solve.h"
#include "tests/support/temporary_folder.h"

namespace cleft {

namespace {

/// Where the error goes as a power of the elements' size between a half and two, what a ratio of two changes
/// tells this part of it at least, and at most.
const double least = 2 * (1 - std::sqrt(0.5)), most = 1.5;

double change(double from, double to) { return std::abs(to - from) / from; }

}  // namespace

/// A cut of two elements: twice as long ones leave it no node to open.
TEST(Companion, ACutOfTwoElementsIsComparedWithHalfAsLongOnes) {
  Parameters p;
  p.cut.length = 2, p.cut.depth = 1;
  const double gape = gape_of(p, MPI_COMM_WORLD);
  const ErrorEstimate estimate = expected_error(p, gape, MPI_COMM_WORLD);
  ASSERT_TRUE(estimate.expected) << estimate.obstacle;
  EXPECT_EQ(estimate.obstacle, "");
  Parameters fine = p;
  fine.patch.length = fine.patch.width = 12;
  const double coarse = gape_of(fine, MPI_COMM_WORLD);
  fine.mesh.element_size = 0.2;
  const double error = change(coarse, gape_of(fine, MPI_COMM_WORLD));
  EXPECT_GT(error, 0.05);
  EXPECT_GT(estimate.expected->mesh, least * error);
  EXPECT_LT(estimate.expected->mesh, most * error);
  Parameters wide = p;
  wide.patch.length = wide.patch.width = 400;
  const double patch_error = change(gape, gape_of(wide, MPI_COMM_WORLD));
  EXPECT_LT(patch_error, 2 * estimate.expected->patch);
}

/// The finite model's own series in other meshes and patches say the same as companions of the small one.
TEST(Companion, TheFiniteModelErrsByTheSamePartOfTheOpening) {
  const TemporaryFolder folder;
  Parameters p;
  p.model = Model::finite;
  p.cut.length = 12, p.cut.depth = 2, p.patch = {30, 24, 5}, p.mesh.element_size = 1.5;
  const auto solved = [&](const Parameters& parameters, bool estimate) {
    SolveOptions options;
    options.estimate = estimate;
    return solve_cases({{parameters, folder / "case.h5"}}, options, MPI_COMM_WORLD, [](const auto&) {})
        .front();
  };
  const SolveReport report = solved(p, true);
  ASSERT_TRUE(report.estimate.expected) << report.failure << report.estimate.obstacle;
  Parameters other = p;
  other.mesh.element_size *= 2;
  const double coarse = solved(other, false).gape;
  other.patch.length *= 2, other.patch.width *= 2;
  const double wide = solved(other, false).gape;
  EXPECT_NEAR(report.estimate.expected->mesh, change(report.gape, coarse), 0.02);
  EXPECT_NEAR(report.estimate.expected->patch, std::abs(wide - coarse) / report.gape, 0.02);
  EXPECT_GT(report.estimate.expected->patch, 0.04);
}

/// Fine at the cut and coarse away from it: elements half as long alone would leave most of the error.
/// Against quadratic ones.
TEST(Companion, ElementsThatGrowAreSeen) {
  Parameters p;
  p.cut.length = 20, p.cut.depth = 3, p.patch = {60, 50, 8};
  p.mesh.element_size = 0.8, p.mesh.grading = 1.4;
  const double gape = gape_of(p, MPI_COMM_WORLD);
  const ErrorEstimate estimate = expected_error(p, gape, MPI_COMM_WORLD);
  ASSERT_TRUE(estimate.expected) << estimate.obstacle;
  Parameters fine = p;
  fine.mesh.elements = ElementOrder::quadratic;
  fine.mesh.element_size = 1.5, fine.mesh.grading = 1.4;
  const double error = change(gape_of(fine, MPI_COMM_WORLD), gape);
  EXPECT_GT(error, 0.01);
  EXPECT_GT(estimate.expected->mesh, least * error) << error;
  EXPECT_LT(estimate.expected->mesh, 2 * error) << error << " " << estimate.expected->mesh;
}

/// A branch of one and a half elements on a long cut.
TEST(Companion, WhatCannotBeEstimatedIsSaid) {
  Parameters p;
  p.cut.branch = 1.5;
  const ErrorEstimate estimate = expected_error(p, 5, MPI_COMM_WORLD);
  EXPECT_FALSE(estimate.expected);
  EXPECT_NE(estimate.obstacle.find("twice as long do not fit the cut"), std::string::npos)
      << estimate.obstacle;
  EXPECT_NE(estimate.obstacle.find("half the mesh.element_size"), std::string::npos) << estimate.obstacle;
}

}  // namespace cleft
