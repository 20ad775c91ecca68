// A small seeded part of cleft-stress-incision.
#include "tests/incision/stress/stress.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "explorer/io/mesh_file.h"
#include "tests/incision/meshes.h"

namespace cleft::stress {
namespace {

void expect_sound(const std::string& name, const SurfaceMesh& mesh, long paths, double refused,
                  bool good = true) {
  Plan plan;
  plan.good = good;
  plan.paths = paths;
  const Tally tally = stress(name, mesh, plan);
  std::string told;
  for (const std::string& violation : tally.first_violations) told += "\n  " + violation;
  for (const auto& [reason, count] : tally.reasons)
    told += "\n  refused " + std::to_string(count) + ": " + reason;
  EXPECT_EQ(tally.violations, 0) << told;
  EXPECT_LE(static_cast<double>(tally.refused), refused * static_cast<double>(paths)) << told;
}

TEST(Stress, GeneratedMeshes) {
  using namespace testing;
  expect_sound("plane", grid(30, 30, -15, -15, 1), 300, 0.01);
  expect_sound("sphere", sphere(4, 10), 300, 0.01);
  expect_sound("torus", ring(60, 24, 10, 4, true), 200, 0.01);
  expect_sound("cylinder", ring(40, 20, 10, 3, false), 200, 0.01);
}

TEST(Stress, LargeTrianglesWoundRoundByTheirOwnCuts) {
  Plan plan;
  plan.good = false;  // folds as sharp as a box's
  plan.paths = 60;
  const Tally tally = stress("octahedron", testing::sphere(1, 10), plan);
  EXPECT_EQ(tally.violations, 0);
  EXPECT_EQ(tally.poor - tally.squeezed, 0) << "3 where needles are left as they are";
  EXPECT_LE(tally.refused, 1);
}

TEST(Stress, LipsThatNearlyTouchAndPlacesWhereWoundsCross) {
  const auto expect_good = [](std::uint64_t seed, const std::vector<long>& paths) {
    Plan plan;
    plan.good = false;
    plan.seed = seed;
    plan.paths = 4166;
    plan.only = paths;
    const Tally tally = stress("octahedron", testing::sphere(1, 10), plan);
    EXPECT_EQ(tally.violations, 0);
    EXPECT_EQ(tally.poor - tally.squeezed, 0);
    EXPECT_EQ(tally.long_lips, 0);
    EXPECT_EQ(tally.refused, 0);
  };
  // Needles (292: of a path that closes on itself again and again); lips' vertices that drew the path to
  // themselves, so that it then ran along the lip (3316, 3874); and places where wounds cross (214, 742).
  expect_good(20, {214, 292, 742, 1072, 1579, 3316, 3874});
  // A lip's vertex ahead that drew the path to itself, so that it then turned back.
  expect_good(2, {1537});
}

TEST(Stress, FacesOrgansAndDefectiveMeshes) {
  namespace fs = std::filesystem;
  if (!fs::exists(CLEFT_SHARED_MESHES)) GTEST_SKIP() << CLEFT_SHARED_MESHES << " is absent";
  expect_sound("head", read_mesh(CLEFT_SHARED_MESHES "/faces/lee-perry-smith-12108.obj"), 60, 0.1);
  expect_sound("liver", read_mesh(CLEFT_SHARED_MESHES "/organs/liver-4384.obj"), 100, 0.1);
  expect_sound("cracked", read_mesh(CLEFT_SHARED_MESHES "/defective/liver-479-flipped.stl"), 100, 1, false);
}

TEST(Stress, APathThatTurnsIntoAnEdgeWhereItBegins) {
  const std::string head = CLEFT_SHARED_MESHES "/faces/lee-perry-smith-12108.obj";
  if (!std::filesystem::exists(head)) GTEST_SKIP() << CLEFT_SHARED_MESHES << " is absent";
  // Both ends of the edge lie on the path, but no straight piece leads past the first to the second.
  Plan plan;
  plan.seed = 20;
  plan.paths = 4167;
  plan.only = {297};
  const Tally tally = stress("lee-perry-smith-12108", read_mesh(head), plan);
  EXPECT_EQ(tally.refused, 0);
  EXPECT_EQ(tally.poor, 0);
}

}  // namespace
}  // namespace cleft::stress
