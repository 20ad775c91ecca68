// A small study, solved and encoded by the commands, against cases that it does not hold.
#include <gtest/gtest.h>

#include <filesystem>

#include "base/quantiles.h"
#include "base/text.h"
#include "encoder/field/file/field_file.h"
#include "tests/interpolate/held_out.h"
#include "tests/interpolate/made_study.h"
#include "tests/pipeline/commands.h"
#include "tests/support/temporary_folder.h"

namespace cleft {

namespace {

namespace fs = std::filesystem;

constexpr const char* body = R"(
[case]
patch.length = 16
patch.width = 10
patch.height = 4
cut.length = 8
cut.depth = 1.5
mesh.element_size = 1
[encode]
tolerance = 0.02
)";

/// The text of a study of these values, each a list.
std::string study_of(const std::string& name, const std::string& vary) {
  return "name = \"" + name + "\"\n" + body + "[sampling]\nmethod = \"list\"\n[vary]\n" + vary;
}

/// Studies are solved once for all tests.
class InterpolatedStudy : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    place_ = new TemporaryFolder;
    solve("train", R"(
"tissue.young_modulus" = [0.01, 0.01, 0.01, 0.02, 0.02, 0.02, 0.04, 0.04, 0.04]
"cut.depth" = [1.2, 1.7, 2.4, 1.2, 1.7, 2.4, 1.2, 1.7, 2.4]
"skin.prestress_v" = [0.02, 0.05, 0.03, 0.04, 0.02, 0.05, 0.03, 0.04, 0.02]
)");
    solve("held", R"(
"tissue.young_modulus" = [0.013, 0.017, 0.03]
"cut.depth" = [2, 1.4, 2.1]
"skin.prestress_v" = [0.03, 0.045, 0.025]
)");
    solve("tensions", R"(
"skin.prestress_u" = [0.01, 0.03, 0.02]
"skin.prestress_v" = [0.03, 0.01, 0.02]
"skin.prestress_uv" = [0, 0, 0.01]
)");
    solve("tension", R"(
"skin.prestress_u" = [0.04]
"skin.prestress_v" = [0.05]
"skin.prestress_uv" = [-0.02]
)");
    solve("stiff", "\"tissue.young_modulus\" = [0.005, 0.02, 0.08]\n",
          "sensitivities = [\"tissue.young_modulus\"]\n");
    solve("stiff_held", "\"tissue.young_modulus\" = [0.007, 0.012, 0.03, 0.055]\n");
    const std::string bends = "\"cut.curvature\" = [-0.12, -0.06, 0, 0.06, 0.12]\n";
    solve("bends", bends);
    solve("bends_held", "\"cut.curvature\" = [-0.09, 0.036]\n");
    solve("mirrored", bends + R"("cut.mirrored" = ["true", "true", "true", "true", "true"])");
  }
  static void TearDownTestSuite() { delete place_; }

  static void solve(const std::string& name, const std::string& vary, const std::string& before = "") {
    const std::string file = place_->write(name + ".toml", before + study_of(name, vary));
    expect_success(run_cleft("run", {file, "--out", folder(name)}));
  }
  static std::string folder(const std::string& name) { return *place_ / name; }

  static TemporaryFolder* place_;
};
TemporaryFolder* InterpolatedStudy::place_ = nullptr;

}  // namespace

TEST_F(InterpolatedStudy, IsAsGoodAsItSays) {
  const auto members = read_members(folder("train"));
  const StudyInterpolator study{CommonCases(members)};
  const auto list = compare_held_out(study, members, folder("held"));
  ASSERT_EQ(list.size(), 3u);
  for (const HeldOut& one : list) {
    EXPECT_LE(one.error, 2 * one.estimate);
    EXPECT_LT(one.error, one.nearest);
    EXPECT_EQ(one.outside, 0);
  }
  EXPECT_LE(median(of_each(list, [](const HeldOut& one) { return one.estimate / one.error; })), 3);
}

TEST_F(InterpolatedStudy, DerivativesHelpWhereCasesAreFew) {
  auto members = read_members(folder("stiff"));
  for (const StudyMember& member : members) EXPECT_EQ(member.field.by_parameter.size(), 1u);
  const StudyInterpolator study{CommonCases(members)};
  EXPECT_TRUE(study.regression().covariance().name.ends_with(" with derivatives"));
  const auto with = compare_held_out(study, members, folder("stiff_held"));
  for (StudyMember& member : members) member.field.by_parameter.clear();
  const StudyInterpolator values{CommonCases(members)};
  const auto without = compare_held_out(values, members, folder("stiff_held"));
  ASSERT_EQ(with.size(), 4u);
  for (const HeldOut& one : with) EXPECT_LE(one.error, 2 * one.estimate);
  // Against the simulations' frames, and against fields fitted to them, without the fits' own errors.
  const auto worst = [](const std::vector<HeldOut>& list, auto figure) {
    const auto figures = of_each(list, figure);
    return *std::max_element(figures.begin(), figures.end());
  };
  const auto error = [](const HeldOut& one) { return one.error; };
  const auto against_field = [](const HeldOut& one) { return one.against_field; };
  EXPECT_LT(worst(with, error), worst(without, error));
  EXPECT_LT(worst(with, against_field), 0.5 * worst(without, against_field));
}

/// In canonical coordinates, which bend with the cut. On meshes as coarse as these ones the fields next to
/// the ends differ by chance: compared are openings between them.
TEST_F(InterpolatedStudy, CutsThatBendOtherwiseOpenAsSimulated) {
  const auto members = read_members(folder("bends"));
  const StudyInterpolator study{CommonCases(members)};
  const auto opening = [](const Field& field, double u) {
    return field.displacement({u, 0, 0}, Side::right, 8) - field.displacement({u, 0, 0}, Side::left, 8);
  };
  for (const StudyMember& held : read_members(folder("bends_held"))) {
    const double curvature = held.field.parameters.number("cut.curvature").value();
    const Field between = study.at({{"cut.curvature", curvature}});
    double largest = 0, off = 0, off_another = 0;
    for (double u = -3; u <= 3; u += 0.25) {
      const Vec3 simulated = opening(held.field, u);
      largest = std::max(largest, norm(simulated));
      off = std::max(off, norm(opening(between, u) - simulated));
      off_another = std::max(off_another, norm(opening(members[0].field, u) - simulated));
    }
    EXPECT_LT(off, 0.02 * largest) << curvature;
    EXPECT_GT(off_another, 0.05 * largest) << curvature;
  }
}

TEST_F(InterpolatedStudy, MirrorImagesStandForCasesThatWereNotSolved) {
  const auto members = read_members(folder("mirrored"));
  EXPECT_EQ(members.size(), 3u) << "of five, two of which are images";
  double quantum = 0;  // fits of mirror images differ by the rounding of their unknowns
  for (const auto& [name, field] : members)
    quantum = std::max(quantum, field.quantum / field.report.largest_displacement);
  const StudyInterpolator halved(folder("mirrored")), whole(folder("bends"));
  EXPECT_EQ(halved.cases().size(), whole.cases().size());
  for (const double curvature : {-0.12, -0.09, 0.036, 0.06, 0.12}) {
    const auto at = [](const StudyInterpolator& study, double k) { return study.at({{"cut.curvature", k}}); };
    const Field expected = at(whole, curvature);
    EXPECT_LT(distance_of(at(halved, curvature), expected), 2 * quantum) << curvature;
    EXPECT_GT(distance_of(at(halved, -curvature), expected), 8 * quantum) << curvature;
  }
}

TEST_F(InterpolatedStudy, PrestressesSuperpose) {
  const auto members = read_members(folder("tensions"));
  const StudyInterpolator study{CommonCases(members)};
  EXPECT_EQ(study.features().loading(), Loading::superposed);
  EXPECT_EQ(study.features().size(), 0);
  const auto list = compare_held_out(study, members, folder("tension"));
  ASSERT_EQ(list.size(), 1u);
  // All that is off are the fits' own errors, in a sum of (1, 3, -2) of them; the nearest case is off by a
  // half.
  EXPECT_LE(list[0].error, list[0].estimate);
  EXPECT_EQ(list[0].outside, 0);
  EXPECT_GT(list[0].nearest, 0.4);
}

TEST_F(InterpolatedStudy, FolderAndStudyFileGiveTheSameField) {
  const std::string set = "tissue.young_modulus=0.02,cut.depth=2,skin.prestress_v=0.03";
  expect_success(run_cleft("interpolate", {folder("train"), "--set", set, "--out", *place_ / "a.dffd"}));
  expect_success(
      run_cleft("interpolate", {folder("train") + "/study.dffd", "--set", set, "--out", *place_ / "b.dffd"}));
  const Field a = read_field(*place_ / "a.dffd"), b = read_field(*place_ / "b.dffd");
  EXPECT_EQ(a.interpolation->method, b.interpolation->method);
  EXPECT_EQ(a.interpolation->estimated_error, b.interpolation->estimated_error);
  ASSERT_EQ(a.coefficients().size(), b.coefficients().size());
  for (std::size_t n = 0; n < a.coefficients().size(); ++n)
    ASSERT_EQ(a.coefficients()[n], b.coefficients()[n]);
  EXPECT_NEAR(a.cut().depth, 2, 1e-12);
  EXPECT_EQ(a.parameters->skin.prestress.vv, 0.03);
  EXPECT_NE(expect_success(run_cleft("info", {*place_ / "a.dffd"})).output.find("estimated_error"),
            std::string::npos);
  expect_success(run_cleft("check", {*place_ / "a.dffd"}));
}

TEST_F(InterpolatedStudy, OutsideIsAWarning) {
  const Outcome far = expect_success(run_cleft(
      "interpolate", {folder("train"), "--set", "tissue.young_modulus=0.08,cut.depth=2,skin.prestress_v=0.03",
                      "--out", *place_ / "far.dffd"}));
  EXPECT_NE(far.output.find("warning: these parameters lie outside the study, by 0.5 of its spread"),
            std::string::npos)
      << far.output;
  EXPECT_NEAR(read_field(*place_ / "far.dffd").interpolation->outside, 0.5, 1e-3);
}

TEST_F(InterpolatedStudy, WrongInputIsNamedAndNothingIsWritten) {
  const std::string train = folder("train"),
                    good = "tissue.young_modulus=0.02,cut.depth=2,skin.prestress_v=0.03";
  const std::string out = *place_ / "none.dffd", text = place_->write("text.dffd", "no field");
  const std::vector<std::tuple<std::string, std::string, std::string>> wrong = {
      {train, "tissue.young_modulus=0.02,cut.dept=2,skin.prestress_v=0.03", "did you mean 'cut.depth'?"},
      {train, "tissue.young_modulus=-1,cut.depth=2,skin.prestress_v=0.03", "must be greater than 0 MPa"},
      {train, "tissue.young_modulus=x,cut.depth=2,skin.prestress_v=0.03", "'x' is not a number"},
      {train, "tissue.young_modulus=0.02,cut.depth=2", "skin.prestress_v varies in this study"},
      {train, good + ",patch.length=21", "it is 16 in all cases"},
      {train, good + ",cut.depth=2.1", "given twice"},
      {train, "cut.depth", "expected NAME=VALUE"},
      {train, "tissue.young_modulus=0.02,cut.depth=2,skin.prestress_v=-0.03",
       "a membrane carries tension only"},
      {folder("tension"), "skin.prestress_v=0.03", "one case"},
      {*place_ / "absent", good, "no such study folder or study.dffd"},
      {text, good, "text.dffd"}};
  for (const auto& [study, set, part] : wrong) {
    const Outcome outcome = run_cleft("interpolate", {study, "--set", set, "--out", out});
    EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
    EXPECT_NE(outcome.output.find(part), std::string::npos) << outcome.output;
    EXPECT_FALSE(fs::exists(out));
  }
  const Outcome no_place =
      run_cleft("interpolate", {train, "--set", good, "--out", *place_ / "absent/new.dffd"});
  EXPECT_EQ(no_place.exit_code, 2) << no_place.output;
}

}  // namespace cleft
