// Shaped patches from a case file to a field, through the commands.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "base/text.h"
#include "encoder/field/file/field_file.h"
#include "explorer/io/mesh_file.h"
#include "tests/pipeline/commands.h"
#include "tests/support/flat_plate.h"
#include "tests/support/temporary_folder.h"

namespace cleft {

namespace {

constexpr const char* coarse = R"(
[case]
patch.length = 50
patch.width = 50
patch.height = 6
cut.length = 14
cut.depth = 3
mesh.element_size = 2
)";

struct Fitted {
  double gape;
  Field field;
};

Fitted fitted(const std::vector<std::string>& settings) {
  const TemporaryFolder folder;
  folder.write("case.toml", coarse);
  std::vector<std::string> arguments = {folder / "case.toml", "--out", folder / "case.h5", "--json",
                                        "--no-estimate"};
  for (const std::string& one : settings) arguments.insert(arguments.end(), {"--set", one});
  const Outcome solved = expect_success(run_cleft("solve", arguments));
  expect_success(run_cleft("encode", {folder / "case.h5", "--out", folder / "case.dffd"}));
  return {figures_of(solved)["gape_mm"], read_field(folder / "case.dffd")};
}

}  // namespace

/// Fields of shapes are as good as that of the box, and over its domain.
TEST(Shapes, AreFittedAsWellAsTheBox) {
  const Fitted box = fitted({});
  const std::vector<std::vector<std::string>> shapes = {
      {"cut.curvature=-0.1"},
      {"cut.tilt=30"},
      {"skin.curvature_v=0.033"},
      {"skin.curvature_uv=0.02"},
      {"cut.curvature=0.04", "cut.tilt=20", "skin.curvature_u=0.02", "skin.curvature_v=-0.02",
       "skin.curvature_uv=0.01", "patch.slope=-0.15", "patch.bottom=bone"}};
  for (const auto& settings : shapes) {
    SCOPED_TRACE(settings.front());
    const Fitted one = fitted(settings);
    EXPECT_LT(one.field.report.node_error, 0.01);
    EXPECT_LT(one.field.report.spline_error, 2 * box.field.report.spline_error);
    EXPECT_LT(one.field.report.gape_error, 2 * box.field.report.gape_error + 0.01);
    EXPECT_EQ(one.field.report.false_gap, 0);
    EXPECT_GT(one.gape, 0.6 * box.gape);
    for (const int axis : {0, 1}) {
      EXPECT_EQ(one.field.domain(axis).front, box.field.domain(axis).front);
      EXPECT_EQ(one.field.domain(axis).back, box.field.domain(axis).back);
    }
  }
}

TEST(Shapes, RanksGiveTheSameSnapshot) {
  const TemporaryFolder folder;
  folder.write("case.toml", std::string(coarse) + "cut.curvature = 0.05\nskin.curvature_v = 0.03\n");
  const auto solve = [&](const std::string& out) -> std::vector<std::string> {
    return {folder / "case.toml", "--out", folder / out, "--json", "--no-estimate"};
  };
  const auto one = figures_of(expect_success(run_cleft("solve", solve("one.h5"))));
  const auto two = figures_of(expect_success(cleft_on_ranks("solve", 2, solve("two.h5"))));
  EXPECT_NEAR(two["gape_mm"].get<double>(), one["gape_mm"].get<double>(), 1e-9);
  expect_success(run_cleft("check", {folder / "two.h5"}));
}

/// A snapshot of a tilted cut that an earlier version solved has no coordinates.
TEST(Shapes, WithoutCoordinatesAreRefused) {
  const TemporaryFolder folder;
  folder.write("case.toml", std::string(coarse) + "cut.radius = 30\ncut.tilt = 20\n");
  expect_success(run_cleft("solve", {folder / "case.toml", "--out", folder / "case.h5", "--no-estimate"}));
  const Outcome refused = run_cleft("encode", {folder / "case.h5", "--out", folder / "case.dffd"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.output.find("cut.curvature makes a curved cut to encode"), std::string::npos)
      << refused.output;
}

/// The last nodes of a closed cut are its first ones: it ends beyond the largest u of any node.
TEST(ClosedCut, IsEncodedToTheToleranceAtEveryNode) {
  const TemporaryFolder folder;
  write_mesh(folder / "plate.stl", flat_plate(41, 41));
  std::string path = "x,y,z,nx,ny,nz\n";
  for (int i = 0; i <= 36; ++i) {
    const double angle = 2 * std::numbers::pi * (i % 36) / 36;
    path += shortest(15 * std::cos(angle)) + "," + shortest(7 * std::sin(angle)) + ",0,0,0,1\n";
  }
  folder.write("path.csv", path);
  folder.write("case.toml", "[case]\nmesh.element_size = 2.5\n");
  const std::string body = folder / "body.h5", snapshot = folder / "case.h5", field = folder / "case.dffd";
  expect_success(
      run_cleft("body", {"--mesh", folder / "plate.stl", "--path", folder / "path.csv", "--out", body}));
  expect_success(run_cleft("solve", {folder / "case.toml", "--mesh", body, "--out", snapshot}));
  expect_success(run_cleft("encode", {snapshot, "--out", field, "--tolerance", "0.05"}));
  EXPECT_LE(read_field(field).report.node_error, 0.05);
}

}  // namespace cleft
