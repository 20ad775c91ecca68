// What `cleft solve` refuses, and what fails in it: a message with value and remedy, and no file.
#include <gtest/gtest.h>

#include <filesystem>

#include "base/error.h"
#include "params/parameters/table.h"
#include "solver/solve.h"
#include "tests/pipeline/commands.h"
#include "tests/support/temporary_folder.h"

namespace {

constexpr const char* small_case = R"([case]
patch.length = 10
patch.width = 6
patch.height = 3
cut.length = 6
cut.depth = 2
)";

class SolveRefuses : public testing::Test {
 protected:
  void expect(int exit_code, const Outcome& outcome, const std::vector<std::string>& parts) {
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.output;
    for (const std::string& part : parts)
      EXPECT_NE(outcome.output.find(part), std::string::npos)
          << "missing '" << part << "' in: " << outcome.output;
    EXPECT_EQ(out.entries(), 0) << "something was left behind";
  }
  void expect_refused(const std::vector<std::string>& options, const std::vector<std::string>& parts) {
    std::vector<std::string> arguments = {a_case, "--out", out / "x.h5"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    expect(2, run_cleft("solve", arguments), parts);
  }

  /// The same without the command, which takes its time to start.
  static void expect_wrong_options(const cleft::SolveOptions& options,
                                   const std::vector<std::string>& assignments,
                                   const std::vector<std::string>& parts) {
    cleft::Parameters p;
    for (const std::string& assignment : assignments) cleft::set_from_text(p, assignment, "test");
    try {
      cleft::check_options(p, options, "case.toml");
      ADD_FAILURE() << "not refused: " << parts.front();
    } catch (const cleft::InputError& e) {
      for (const std::string& part : parts)
        EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
    }
  }

  TemporaryFolder in, out;
  const std::string a_case = in.write("case.toml", small_case);
};

}  // namespace

TEST_F(SolveRefuses, PoissonRatiosThatLock) {
  expect_refused({"--set", "tissue.poisson_ratio=0.5"},
                 {"tissue.poisson_ratio = 0.5", "between 0 and 0.4999"});
  expect_refused({"--set", "tissue.poisson_ratio=0.495"},
                 {"tissue.poisson_ratio = 0.495", "above 0.49", "tissue.formulation = \"mean-dilatation\""});
}

TEST_F(SolveRefuses, SensitivitiesThatAreNone) {
  expect_refused(
      {"--sensitivities", "skin.young_modulus,skin.yung_modulus"},
      {"case.toml", "--sensitivities", "'skin.yung_modulus'", "did you mean 'skin.young_modulus'"});
  expect_refused({"--sensitivities", "cut.length"},
                 {"--sensitivities cut.length", "must be a number of skin, tissue or foundation"});
  for (const char* name : {"patch.height", "mesh.element_size", "cut.frames", "tissue.formulation"})
    expect_wrong_options({.sensitivities = {name}}, {},
                         {std::string("--sensitivities ") + name, "must be a number of skin"});
}

TEST_F(SolveRefuses, WhatHasNoDerivative) {
  expect_wrong_options({.sensitivities = {"skin.young_modulus"}}, {"cut.contact=true", "model=finite"},
                       {"--sensitivities", "set cut.contact to false, or model to \"small\""});
  expect_wrong_options({.unit_prestress = true, .sensitivities = {"skin.prestress_v"}}, {},
                       {"--sensitivities skin.prestress_v", "--unit-prestress", "leave one out"});
}

TEST_F(SolveRefuses, UnitSeriesOfWhatIsNotLinear) {
  expect_refused({"--unit-prestress", "--set", "cut.contact=true"},
                 {"case.toml", "--unit-prestress", "cut.contact = true", "set it to false"});
  expect_wrong_options({.unit_prestress = true, .sensitivities = {}}, {"skin.initial_stress_stiffness=true"},
                       {"--unit-prestress", "skin.initial_stress_stiffness = true", "set it to false"});
  expect_refused({"--unit-prestress", "--set", "skin.turning_stiffness=0.5"},
                 {"--unit-prestress", "skin.turning_stiffness = 0.5", "set it to 0"});
}

TEST_F(SolveRefuses, WhatTheFiniteModelDoesNotHave) {
  expect_refused({"--unit-prestress", "--set", "model=finite"},
                 {"case.toml", "--unit-prestress", "model = finite", "vary the prestress in a study"});
  expect_wrong_options({.method = cleft::Method::iterative, .sensitivities = {}}, {"model=finite"},
                       {"--method iterative", "model = finite", "--method direct"});
  expect_wrong_options({.sensitivities = {"skin.bending_stiffness"}}, {"model=finite"},
                       {"--sensitivities skin.bending_stiffness", "0", "set it above 0"});
  expect_refused({"--set", "model=finite", "--set", "skin.initial_stress_stiffness=true"},
                 {"skin.initial_stress_stiffness = true", "set it to false"});
  expect_refused({"--set", "model=finite", "--set", "skin.turning_stiffness=1"},
                 {"skin.turning_stiffness = 1", "set it to 0"});
  expect_refused({"--set", "skin.initial_stress_stiffness=true", "--set", "skin.turning_stiffness=0.5"},
                 {"skin.turning_stiffness = 0.5", "set it to 0, or that to false"});
  expect_refused({"--set", "skin.turning_stiffness=1.5"}, {"skin.turning_stiffness = 1.5", "1"});
  expect_refused({"--set", "model=finite", "--set", "tissue.law=st-venant-kirchhoff", "--set",
                  "tissue.formulation=mean-dilatation"},
                 {"tissue.law = st-venant-kirchhoff", "set tissue.law to \"neo-hookean\""});
}

TEST_F(SolveRefuses, ContactByIterations) {
  expect_wrong_options({.method = cleft::Method::iterative, .sensitivities = {}}, {"cut.contact=true"},
                       {"--method iterative", "set cut.contact to false", "--method direct"});
}

TEST_F(SolveRefuses, SeveralCasesWithoutANameEach) {
  std::filesystem::create_directory(in / "other");
  const std::string other = in.write("other/case.toml", small_case);
  expect(2, run_cleft("solve", {a_case, other, "--out", out.path()}),
         {"other/case.toml", "another case is called case.h5 too", "rename one"});
  const std::string third = in.write("third.toml", small_case);
  expect(2, run_cleft("solve", {a_case, third, "--out", out / "x.h5"}),
         {"--out", "x.h5", "must be a folder that exists", "2 cases"});
}

TEST_F(SolveRefuses, MistakesOfAllCasesAtOnce) {
  const std::string bad = in.write("bad.toml", small_case + std::string("skin.thickness = -1\n"));
  const std::string worse = in.write("worse.toml", small_case + std::string("skin.thicknes = 1\n"));
  expect(2, run_cleft("solve", {a_case, bad, worse, "--out", out.path()}),
         {"bad.toml", "skin.thickness = -1", "worse.toml", "did you mean 'skin.thickness'"});
}

/// Springs that vanish against the tissue in rounding; on several ranks none waits for another.
TEST_F(SolveRefuses, APatchThatNothingHolds) {
  const std::vector<std::string> arguments = {a_case, "--out", out / "x.h5", "--set",
                                              "tissue.young_modulus=1e14"};
  const std::vector<std::string> parts = {"x.h5", "not positive definite",
                                          "are the springs and moduli large enough"};
  expect(1, run_cleft("solve", arguments), parts);
  expect(1, cleft_on_ranks("solve", 2, arguments), parts);
}

/// Skin that is pulled fifteen times as hard as it is stiff, on next to nothing.
TEST_F(SolveRefuses, FiniteStrainsWithoutAnEquilibrium) {
  expect(1,
         run_cleft("solve",
                   {a_case, "--out", out / "x.h5", "--set", "model=finite", "--set", "skin.law=neo-hookean",
                    "--set", "skin.prestress_v=2", "--set", "tissue.young_modulus=0.0002", "--set",
                    "foundation.stiffness=0.0001", "--set", "foundation.side_stiffness=0.0001"}),
         {"x.h5", "frame ", "mm cut), at ", "% of what it releases", "the tangent is indefinite",
          "The element that has shrunk most", "is at (u, v, w) = ", "Raise skin.bending_stiffness"});
}

/// The factor balances the forces to rounding all the same.
TEST_F(SolveRefuses, DisplacementsThatRoundingWouldChange) {
  const std::vector<std::string> arguments = {a_case, "--out", out / "x.h5", "--set",
                                              "skin.young_modulus=1e10"};
  const std::vector<std::string> parts = {"x.h5", "rounding would change the displacements by",
                                          "too many orders of magnitude", "bring the moduli"};
  expect(1, run_cleft("solve", arguments), parts);
  expect(1, cleft_on_ranks("solve", 2, arguments), parts);
}
