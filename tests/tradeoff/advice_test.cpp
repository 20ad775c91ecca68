// Advice for a small case against what the advised setting truly does.
#include "tradeoff/advice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "params/study.h"
#include "tests/pipeline/commands.h"
#include "tests/support/temporary_folder.h"
#include "tradeoff/chain.h"

namespace cleft {

namespace {

constexpr const char* small_case = R"(
name = "small"
[case]
cut.length = 12
cut.depth = 2
patch = { height = 5 }
foundation.stiffness = 0.02
foundation.side_stiffness = 0.02
[vary]
"skin.prestress_v" = [0.02, 0.04]
)";

TEST(Advice, KeepsItsErrorAgainstAMuchFinerSimulationOfAWiderPatch) {
  const TemporaryFolder folder;
  const std::string toml = folder.write("study.toml", small_case), out = folder / "advised.toml";
  const double asked = 0.25;
  expect_success(run_cleft("advise", {toml, "--error", "0.25", "--out", out}));
  const Study study = read_study(out);
  ASSERT_EQ(cases_of(study).size(), 2u);
  {
    const Case one = cases_of(study)[1];
    const Chain chain(one.parameters, folder.path());
    const Chain::Encoded encoded = chain.encoded(one.encode.tolerance);
    Parameters fine = one.parameters;
    fine.mesh.element_size /= 3;
    fine.patch.length += fine.patch.width, fine.patch.width *= 2;
    const Chain truth(fine, folder.path());
    EXPECT_LE(opening_error(encoded.field, truth.opening()), asked);
    EXPECT_EQ(one.parameters.foundation.stiffness, 0.02);  // all else stays
  }
}

TEST(Advice, LessErrorCostsMore) {
  const TemporaryFolder folder;
  Parameters p;
  p.cut.length = 12, p.cut.depth = 2, p.patch.height = 5, p.foundation = {0.02, 0.02};
  const std::vector<CaseModel> models(1, CaseModel(p, folder.path(), [](const std::string&) {}));
  double nodes = 0, seconds = 0;
  for (const double error : {0.4, 0.3, 0.2, 0.15}) {
    const Expectation e = expectation(models, advise(models, {.error = error}));
    EXPECT_LE(e.total, error);
    EXPECT_GE(e.nodes, nodes);
    EXPECT_GE(e.seconds, seconds);
    nodes = e.nodes, seconds = e.seconds;
  }
  // Every goal that cannot be had is named.
  const auto refused = [&](const Goals& goals, const std::string& why) {
    try {
      advise(models, goals);
      ADD_FAILURE() << why;
    } catch (const std::exception& e) {
      EXPECT_NE(std::string(e.what()).find(why), std::string::npos) << e.what();
    }
  };
  refused({.error = 1e-3}, "--error 0.001: out of reach");
  refused({.error = 0.2, .frame_ms = 1e-6}, "--frame-ms");
  // What replays leave alone counts for both lips.
  const CaseModel& model = models.front();
  Setting setting = advise(models, {.error = 0.3});
  EXPECT_EQ(setting.detail, 0);
  const double whole = model.expectation(setting).total;
  setting.detail = 0.01 * model.largest_opening();
  EXPECT_NEAR(model.expectation(setting).total, whole + 0.02, 1e-12);
}

TEST(Advice, ToldWhatIsWrong) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& text, const std::string& error, const std::string& why) {
    const Outcome outcome =
        run_cleft("advise", {folder.write("s.toml", text), "--error", error, "--out", folder / "out.toml"});
    EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
    EXPECT_NE(outcome.output.find(why), outcome.output.npos) << outcome.output;
    EXPECT_FALSE(std::filesystem::exists(folder / "out.toml"));
  };
  refused("[case]\ncut.radius = 40\n", "0.1", "one straight, upright cut");
  refused("[vary]\n\"mesh.element_size\" = [1, 2]\n", "0.1", "mesh.element_size");
  refused("[case]\n", "0", "--error 0");
}

TEST(Advice, AStudysFileKeepsAllButWhatWasChosen) {
  const TemporaryFolder folder;
  const Study study = read_study(folder.write("s.toml", small_case));
  const std::string text = with_settings(study, {{"patch.length", 33.3}, {"mesh.element_size", 0.1}}, 0.05);
  EXPECT_EQ(text.find("0.1000000"), text.npos) << text;
  const Study changed = read_study(folder.write("t.toml", text));
  EXPECT_EQ(changed.name, "small");
  EXPECT_EQ(changed.base.parameters.patch.length, 33.3);
  EXPECT_EQ(changed.base.parameters.patch.height, 5);
  EXPECT_EQ(changed.base.parameters.mesh.element_size, 0.1);
  EXPECT_EQ(changed.base.encode.tolerance, 0.05);
  ASSERT_EQ(changed.vary.size(), 1u);
  EXPECT_EQ(changed.vary[0].values, study.vary[0].values);
}

}  // namespace

}  // namespace cleft
