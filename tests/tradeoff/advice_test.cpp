// Advice for a small case against what the advised setting truly does.
#include "tradeoff/advice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <limits>
#include <vector>

#include "base/error.h"
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
cut.depth = 1
patch = { height = 2.5 }
foundation.stiffness = 0.02
foundation.side_stiffness = 0.02
[vary]
"skin.prestress_v" = [0.02, 0.04]
)";

/// Of finite strains, which are right, whatever model was chosen.
TEST(Advice, KeepsItsErrorAgainstAMuchFinerSimulationOfAWiderPatch) {
  const TemporaryFolder folder;
  const std::string toml = folder.write("study.toml", small_case), out = folder / "advised.toml";
  const double asked = 0.3;
  expect_success(run_cleft("advise", {toml, "--error", "0.3", "--out", out}));
  const Study study = read_study(out);
  ASSERT_EQ(cases_of(study).size(), 2u);
  {
    const Case one = cases_of(study)[1];
    const Chain chain(one.parameters, folder.path());
    const Chain::Encoded encoded = chain.encoded(one.encode.tolerance);
    Parameters fine = one.parameters;
    fine.model = Model::finite;
    fine.mesh.element_size /= 2;
    fine.patch.length += fine.patch.width / 2, fine.patch.width *= 1.5;
    const Chain truth(fine, folder.path());
    EXPECT_LE(opening_error(encoded.field, truth.opening()), asked);
    EXPECT_EQ(one.parameters.foundation.stiffness, 0.02);  // all else stays
  }
}

/// The cheapest setting with elements of one kind that keeps an error, found by trying all. Its cost is that
/// which was measured: which kind of elements is the cheaper one may depend on what else the machine does.
Setting cheapest(const std::vector<CaseModel>& models, double error, ElementOrder elements) {
  Setting best;
  double seconds = std::numeric_limits<double>::infinity();
  for (Setting setting : models.front().settings()) {
    setting.grading = advised_grading(elements, error);
    const auto keeps_error = [&](double tolerance) {
      setting.tolerance = tolerance;
      return tolerance <= error / 2 && expectation(models, setting).total <= error;
    };
    if (setting.elements != elements || expectation(models, setting).seconds >= seconds ||
        std::none_of(std::begin(tolerances), std::end(tolerances), keeps_error))
      continue;
    best = setting, seconds = expectation(models, setting).seconds;
  }
  EXPECT_TRUE(std::isfinite(seconds));
  return best;
}

TEST(Advice, LessErrorCostsMore) {
  const TemporaryFolder folder;
  Parameters p;
  p.cut.length = 12, p.cut.depth = 1, p.patch.height = 2.5, p.foundation = {0.02, 0.02};
  const std::vector<CaseModel> models(1, CaseModel(
                                             p, folder.path(), [](const std::string&) {}, {}, true));
  const auto nodes = [&](const Setting& setting) { return expectation(models, setting).nodes; };
  double nodes_of_linear = 0, nodes_of_quadratic = 0, seconds = 0;
  for (const double error : {0.4, 0.3, 0.2, 0.15, 0.05}) {
    const Setting advised = advise(models, {.error = error}),
                  linear = cheapest(models, error, ElementOrder::linear),
                  quadratic = cheapest(models, error, ElementOrder::quadratic);
    const Expectation e = expectation(models, advised);
    EXPECT_LE(e.total, error);
    EXPECT_EQ(e.seconds,
              std::min(expectation(models, linear).seconds, expectation(models, quadratic).seconds));
    EXPECT_GE(e.seconds, seconds);
    EXPECT_GE(nodes(linear), nodes_of_linear);
    EXPECT_GE(nodes(quadratic), nodes_of_quadratic);
    seconds = e.seconds, nodes_of_linear = nodes(linear), nodes_of_quadratic = nodes(quadratic);
  }
  // Linear elements need fewer nodes for a large error, quadratic ones for a small one.
  EXPECT_GT(nodes(cheapest(models, 0.3, ElementOrder::quadratic)),
            4 * nodes(cheapest(models, 0.3, ElementOrder::linear)));
  const Setting chosen = cheapest(models, 0.05, ElementOrder::quadratic);
  EXPECT_LT(nodes(chosen), nodes_of_linear);
  // Against finer ones.
  Setting fine = chosen;
  fine.element_size /= 1.5;
  const Chain::Encoded encoded = Chain(applied(chosen, p), folder.path()).encoded(chosen.tolerance);
  EXPECT_LE(opening_error(encoded.field, Chain(applied(fine, p), folder.path()).opening()), 0.05);
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
  EXPECT_EQ(advise(models, {.error = 0.2}).grading, 1.3);
  EXPECT_EQ(applied({.element_size = 1, .grading = 1.15}, p).mesh.grading, 1.15);
  EXPECT_LT(advised_grading(ElementOrder::linear, 0.01), advised_grading(ElementOrder::linear, 0.02));
  refused({.error = 0.2, .frame_ms = 1e-6}, "--frame-ms");
  // What replays leave alone counts for both lips.
  const CaseModel& model = models.front();
  Setting setting = advise(models, {.error = 0.3});
  EXPECT_EQ(setting.detail, 0);
  const double whole = model.expectation(setting).total;
  setting.detail = 0.01 * model.largest_opening();
  EXPECT_NEAR(model.expectation(setting).total, whole + 0.02, 1e-12);
}

/// An error of the model that is the same everywhere.
ModelError made_model_error(double error) {
  return {.error = Samples(sampled(1,
                                   [&](double, double) {
                                     return Vec3{0, error, 0};
                                   })),
          .ratio = 1,
          .finite = {{500, 1}, {2000, 10}},
          .small_rise = 1,
          .finite_rise = 0.5};
}

TEST(Advice, TheModelIsChosenByItsError) {
  const TemporaryFolder folder;
  Parameters p;
  p.cut.length = 12, p.cut.depth = 1, p.patch.height = 2.5, p.foundation = {0.02, 0.02};
  const auto quiet = [](const std::string&) {};
  const std::vector<CaseModel> models(
      1, CaseModel(p, folder.path(), quiet, {.error = made_model_error(0.15), .choose = true}));
  // Finite strains cost more, and are taken only where small ones cannot keep the error.
  EXPECT_EQ(advise(models, {.error = 0.5}).model, Model::small);
  const Setting finite = advise(models, {.error = 0.155});
  EXPECT_EQ(finite.model, Model::finite);
  EXPECT_THROW(advise(models, {.error = 0.155, .model = Model::small}), InputError);
  Setting setting = finite;
  setting.model = Model::small;
  const Expectation small = models.front().expectation(setting), large = models.front().expectation(finite);
  EXPECT_NEAR(small.model, 0.15, 1e-12);
  EXPECT_EQ(large.model, 0);
  EXPECT_GT(small.total, 0.15);
  EXPECT_EQ(small.dominating(), "model");
  EXPECT_GT(large.seconds, small.seconds);
  EXPECT_EQ(large.mesh, small.mesh);
  // Where the model is the case's own its error is told, and not counted.
  setting.model = {};
  const Expectation own = models.front().expectation(setting);
  EXPECT_NEAR(own.model, 0.15, 1e-12);
  EXPECT_FALSE(own.model_counts);
  EXPECT_EQ(own.total, large.total);
}

/// What is not linear begins with the square of the load: over the opening, in proportion to it.
TEST(ModelErrorOfACase, GrowsInProportionToWeakTension) {
  const TemporaryFolder folder;
  Parameters p;
  p.cut.length = 12, p.cut.depth = 1, p.patch.height = 2.5, p.foundation = {0.02, 0.02};
  const auto error = [&](double tension) {
    p.skin.prestress = {tension, 2 * tension, 0};
    const ModelError one = model_error(p, folder.path(), [](const std::string&) {});
    EXPECT_GT(one.small_rise, one.finite_rise);
    EXPECT_LT(std::abs(one.ratio - 1), size_of(one.error));
    EXPECT_GT(one.finite.back().nodes, one.finite.front().nodes);
    EXPECT_GT(one.finite.front().seconds, 0);
    return size_of(one.error);
  };
  const double weak = error(2e-4), twice = error(4e-4);
  EXPECT_LT(weak, 0.01);
  EXPECT_NEAR(twice / weak, 2, 0.1);  // the next term is of the size of the error itself
}

TEST(Advice, SaysWhyAModelCannotBeChosen) {
  const TemporaryFolder folder;
  const std::string stiffened = folder.write("stiffened.toml",
                                             "[case]\ncut = { length = 12, depth = 2 }\n"
                                             "skin.turning_stiffness = 0.5\npatch.height = 5\n"),
                    out = folder / "out.toml";
  const std::string said =
      expect_success(run_cleft("advise", {stiffened, "--error", "0.2", "--out", out})).output;
  for (const char* part : {"skin under tension resists turning anyway", "small strains are off by another",
                           "which is not in the error of 0.2"})
    EXPECT_NE(said.find(part), said.npos) << said;
  EXPECT_EQ(read_study(out).base.parameters.model, Model::small);
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
  EXPECT_EQ(changed.base.parameters.patch.height, 2.5);
  EXPECT_EQ(changed.base.parameters.mesh.element_size, 0.1);
  EXPECT_EQ(changed.base.encode.tolerance, 0.05);
  ASSERT_EQ(changed.vary.size(), 1u);
  EXPECT_EQ(changed.vary[0].values, study.vary[0].values);
}

}  // namespace

}  // namespace cleft
