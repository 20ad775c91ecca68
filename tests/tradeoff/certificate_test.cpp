// Bounds of what is shown between the cases of a study that is run.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/pipeline/commands.h"
#include "tests/support/temporary_folder.h"

namespace cleft {

namespace {

/// Of one mesh, but for its depth. Fields with few control points: errors of interpolation and of fits.
constexpr const char* certified_study = R"(
name = "certified"
keep_snapshots = "none"
[case]
cut.length = 8
cut.depth = 2
patch = { length = 24, width = 16, height = 5 }
mesh = { element_size = 1.5, grading = 1.4 }
foundation.stiffness = 0.02
[encode]
control_points = [12, 10, 7, 8]
[vary]
"tissue.young_modulus" = [0.01, 0.02, 0.04]
"skin.poisson_ratio" = [0.3, 0.45]
)";

constexpr const char* points = "tissue.young_modulus,skin.poisson_ratio\n0.014,0.37\n0.03,0.42\n0.01,0.3\n";

}  // namespace

class Certified : public ::testing::Test {
 protected:
  std::string run_study(const std::string& text) const {
    const std::string toml = folder_.write("study.toml", text), study = folder_ / "study";
    expect_success(run_cleft("run", {toml, "--out", study}));
    return study;
  }
  TemporaryFolder folder_;
};

TEST_F(Certified, BoundsHoldAndAreNear) {
  const std::string study = run_study(certified_study);
  const auto found = figures_of(expect_success(
      run_cleft("certify", {study, "--points", folder_.write("points.csv", points), "--solve", "--json"})));
  ASSERT_EQ(found.size(), 3u);
  for (const auto& one : found) {
    const double most = one.at("bound_over_error_at_most");
    EXPECT_LT(most, 10) << one;
    EXPECT_LT(one.at("closed_pairs_moved_mm").get<double>(), 1e-9);
    for (const auto& frame : one.at("frames")) {
      if (frame.at("length_cut_mm").get<double>() == 0) continue;
      const double bound = frame.at("bound"), error = frame.at("error");
      EXPECT_GE(bound, error * (1 - 1e-9)) << one;
      EXPECT_LE(bound, most * error) << one;
    }
    const auto& last = one.at("frames").back();
    EXPECT_GT(last.at("error").get<double>(), 1e-4 * last.at("size").get<double>());  // of the fit
    EXPECT_LT(last.at("error").get<double>(), 0.6 * last.at("size").get<double>());
  }
  const Outcome text = expect_success(
      run_cleft("certify", {study, "--set", "tissue.young_modulus=0.03,skin.poisson_ratio=0.42"}));
  EXPECT_NE(text.output.find("when all is cut the error is at most"), std::string::npos) << text.output;

  for (const auto& [arguments, expected] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{study}, "--set or --points is missing"},
           {{study, "--set", "tissue.young_modulus=0.03"}, "skin.poisson_ratio varies in this study"},
           {{study, "--set", "tissue.young_modulu=0.03"}, "did you mean 'tissue.young_modulus'?"}}) {
    const Outcome outcome = run_cleft("certify", arguments);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
    EXPECT_NE(outcome.output.find(expected), std::string::npos) << outcome.output;
  }
}

TEST_F(Certified, StudiesWithContactAreRefused) {
  std::string text = certified_study;
  text.insert(text.find("[encode]"), "cut.contact = true\n");
  const std::string study = run_study(text);
  const Outcome outcome =
      run_cleft("certify", {study, "--set", "tissue.young_modulus=0.03,skin.poisson_ratio=0.42"});
  EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
  EXPECT_NE(outcome.output.find("cut.contact = true: forces of contact are not known"), std::string::npos)
      << outcome.output;
}

}  // namespace cleft
