// From a surface and a path to the fields of a study of that very body.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/text.h"
#include "tests/pipeline/commands.h"
#include "tests/support/temporary_folder.h"

namespace cleft {

namespace {

/// A cylinder of 30 mm around u, 60 mm long, a third of a turn; the path along it.
void write_cylinder(const TemporaryFolder& folder) {
  constexpr int along = 20, around = 24;
  constexpr double radius = 30;
  std::string mesh;
  for (int i = 0; i <= along; ++i)
    for (int j = 0; j <= around; ++j) {
      const double angle = (j - around / 2.0) * 0.1;
      mesh += "v " + shortest(3. * i - 30) + " " + shortest(radius * std::sin(angle)) + " " +
              shortest(radius * std::cos(angle)) + "\n";
    }
  for (int i = 0; i < along; ++i)
    for (int j = 1; j <= around; ++j) {
      const int a = i * (around + 1) + j, b = a + around + 1;
      mesh += "f " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(b + 1) + "\nf " +
              std::to_string(a) + " " + std::to_string(b + 1) + " " + std::to_string(a + 1) + "\n";
    }
  folder.write("cylinder.obj", mesh);
  folder.write("path.csv", "x,y,z,nx,ny,nz,depth\n-8,0,30,0,0,1,2\n0,0,30,0,0,1,2\n8,0,30,0,0,1,2\n");
}

}  // namespace

TEST(BodyStudy, ItsCasesAreSimulatedEncodedAndReplayedOnThatBody) {
  const TemporaryFolder folder;
  write_cylinder(folder);
  const std::string mesh = folder / "cylinder.obj", path = folder / "path.csv", out = folder / "out";
  expect_success(run_cleft("body", {"--mesh", mesh, "--path", path, "--out", folder / "wrist.h5", "--set",
                                    "mesh.element_size=1"}));
  const std::string study =
      folder.write("study.toml", "[body]\nfile = 'wrist.h5'\n[vary]\n'skin.prestress_v' = [0.02, 0.03]\n");
  expect_success(run_cleft("run", {study, "--out", out}));
  // The folder stands for itself.
  std::filesystem::remove(folder / "wrist.h5");
  const nlohmann::json status = figures_of(expect_success(run_cleft("status", {out, "--json"})));
  EXPECT_EQ(status.at("published"), 2);
  expect_success(run_cleft("check", {out}));

  // The second case's field on that cylinder, against its simulation there.
  const std::string field = status.at("cases").at(1).at("case").get<std::string>();
  const nlohmann::json cut = figures_of(expect_success(
      run_cleft("cut", {"--mesh", mesh, "--path", path, "--field", out + "/cases/" + field + "/case.dffd",
                        "--simulate", "--set", "mesh.element_size=1", "--set", "skin.prestress_v=0.03",
                        "--out", folder / "cut.vtp", "--json"})));
  EXPECT_LT(cut.at("simulated").at("replay").at("opening_off_by").get<double>(), 0.1);

  // What is found in a field is looked up in its simulation, whose nodes are in space.
  const nlohmann::json found =
      figures_of(expect_success(run_cleft("find", {out, "--where", "gape > 0.5", "--json"})));
  ASSERT_EQ(found.at("found").size(), 2U);
  for (const auto& one : found.at("found")) EXPECT_EQ(one.at("confirmed"), true) << one;
}

TEST(BodyStudy, WhatTheBodyFixesDoesNotVary) {
  const TemporaryFolder folder;
  folder.write("wrist.h5", "not read");
  for (const std::string name : {"cut.length", "skin.curvature_u", "mesh.element_size"}) {
    const std::string study =
        folder.write("study.toml", "[body]\nfile = 'wrist.h5'\n[vary]\n'" + name + "' = [0.02, 0.03]\n");
    const Outcome outcome = run_cleft("run", {study, "--out", folder / "out"});
    EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
    EXPECT_NE(outcome.output.find("vary." + name + ": has no effect with [body]"), std::string::npos)
        << outcome.output;
    EXPECT_FALSE(std::filesystem::exists(folder / "out"));
  }
}

}  // namespace cleft
