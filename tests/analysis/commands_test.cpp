// cleft analyze, fit and find with aims, as a user runs them.
#include "tests/pipeline/commands.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/text.h"
#include "encoder/field/file/field_file.h"
#include "encoder/field/file/study_file.h"
#include "explorer/analysis/figure.h"
#include "tests/analysis/made_cases.h"
#include "tests/support/temporary_folder.h"

namespace cleft {

class QuestionsToAStudy : public ::testing::Test {
 protected:
  QuestionsToAStudy() {
    std::vector<StudyCase> cases;
    for (const CaseParameters& values : drawn(24, 1)) {
      const std::string name = "case" + std::to_string(cases.size());
      write_field(folder_ / (name + ".dffd"), made_field(values));
      cases.push_back({name, folder_ / (name + ".dffd"), {}});
    }
    write_study(study(), study_records(cases));
  }
  std::string study() const { return folder_ / "study.dffd"; }

  TemporaryFolder folder_;
};

namespace {

void expect_refused(const std::string& command, const std::vector<std::string>& arguments,
                    const std::string& text) {
  const Outcome outcome = run_cleft(command, arguments);
  EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
  EXPECT_NE(outcome.output.find(text), std::string::npos) << outcome.output;
}

}  // namespace

TEST_F(QuestionsToAStudy, AreAnalyzed) {
  // The motion is proportional to the tension, and nearly so to what the tissue yields.
  const auto found = figures_of(expect_success(run_cleft(
      "analyze", {study(), "--of", "v(2, -5, 0)", "--given", "cut.depth=normal(3.5, 0.01)", "--json"})));
  EXPECT_EQ(found.at("cases"), 24);
  double sum = 0;
  for (const auto& one : found.at("parameters")) {
    sum += one.at("first_order").at("value").get<double>();
    if (one.at("name") == "cut.depth") {
      EXPECT_LT(one.at("total").at("value").get<double>(), 0.01);
    }
  }
  EXPECT_GT(sum, 0.9);
  EXPECT_LT(found.at("interpolation_error").at("median").get<double>(),
            0.01 * found.at("deviation").get<double>());
  const Outcome text = expect_success(run_cleft("analyze", {study(), "--of", "gape"}));
  EXPECT_NE(text.output.find("skin.prestress_v"), std::string::npos) << text.output;
}

TEST_F(QuestionsToAStudy, AreFitted) {
  const Field truth =
      made_field({{"cut.depth", 3.2}, {"skin.prestress_v", 0.03}, {"tissue.young_modulus", 0.02}});
  std::string table = "u,v,w,du,dv\n";
  for (const char* point : {"2,-5,0", "6,4,0", "-4,3,-2", "1,-6,-1"}) {
    const auto at = [&](const char* name) {
      return shortest(Figure(std::string(name) + "(" + point + ")").of(truth));
    };
    table += std::string(point) + "," + at("u") + "," + at("v") + "\n";
  }
  const std::string measured = folder_.write("measured.csv", table), draws = folder_ / "draws.csv";
  const auto found = figures_of(expect_success(
      run_cleft("fit", {study(), "--to", measured, "--deviation", "0.005", "--out", draws, "--json"})));
  EXPECT_GT(found.at("misfit_probability").get<double>(), 0.01);
  for (const auto& one : found.at("parameters")) {
    const double value = truth.parameters.number(one.at("name").get<std::string>()).value();
    EXPECT_LT(one.at("interval_90").at(0).get<double>(), value) << one;
    EXPECT_GT(one.at("interval_90").at(1).get<double>(), value) << one;
  }
  EXPECT_EQ(read_csv(draws).columns.size(), 3u);
  EXPECT_GT(read_csv(draws).rows.size(), 1000u);
}

TEST_F(QuestionsToAStudy, AreOptimised) {
  const auto found = figures_of(expect_success(run_cleft(
      "find", {study(), "--minimize", "skin.prestress_v", "--where", "gape > 5", "--certain", "--json"})));
  const auto& optimum = found.at("optimum");
  EXPECT_TRUE(optimum.at("holds_within_errors").get<bool>());
  CaseParameters values;
  for (const auto& [name, value] : optimum.at("values").items()) values[name] = value.get<double>();
  EXPECT_GT(Figure("gape").of(made_field(values)), 5);  // in truth
  values["skin.prestress_v"] *= 0.98;
  EXPECT_LT(Figure("gape").of(made_field(values)), 5);
  ASSERT_FALSE(found.at("cases").empty());
  EXPECT_LT(values["skin.prestress_v"],
            found.at("cases")[0].at("values").at("skin.prestress_v").get<double>());

  const auto several = figures_of(expect_success(
      run_cleft("find", {study(), "--maximize", "gape", "--maximize", "tissue.young_modulus", "--json"})));
  EXPECT_FALSE(several.contains("optimum"));
  EXPECT_GT(several.at("cases").size(), 2u);
  EXPECT_LT(several.at("cases").size(), 24u);
  const Outcome text = expect_success(run_cleft("find", {study(), "--maximize", "gape"}));
  EXPECT_NE(text.output.find("its field: cleft interpolate"), std::string::npos) << text.output;
  const Outcome lines = expect_success(
      run_cleft("find", {study(), "--maximize", "gape", "--maximize", "tissue.young_modulus"}));
  for (const auto& one : several.at("cases"))
    EXPECT_NE(lines.output.find(one.at("name").get<std::string>() + " (" + one.at("hash").get<std::string>() +
                                ")\n"),
              std::string::npos)
        << lines.output;
  const Outcome nowhere =
      expect_success(run_cleft("find", {study(), "--maximize", "gape", "--where", "cut.depth > 50"}));
  EXPECT_NE(nowhere.output.find("nowhere between the cases"), std::string::npos) << nowhere.output;
}

TEST_F(QuestionsToAStudy, WithoutSenseAreRefused) {
  expect_refused("find", {study()}, "--where is missing");
  expect_refused("find", {study(), "--minimize", "gap"}, "there is no figure 'gap'");
  expect_refused("find", {study(), "--minimize", "gape", "--where", "t > 3"}, "nothing is named 't'");
  expect_refused("find", {study(), "--minimize", "gape", "--maximize", "gape"}, "give one of both");
  expect_refused("find", {study(), "--minimize", "gape", "--certain"}, "with a --where");
  expect_refused("analyze", {study(), "--of", "gap"}, "there is no figure 'gap'");
  expect_refused("analyze", {study(), "--given", "cut.dept=uniform(1, 2)"}, "did you mean 'cut.depth'?");
  expect_refused("analyze", {study(), "--given", "cut.depth=uniform(2, 1)"}, "expected uniform(from, to)");
  expect_refused("analyze", {folder_ / "absent"}, "absent");
  expect_refused("analyze", {folder_ / "case0.dffd"}, "holds 1 case;");
  expect_refused("fit", {study(), "--to", folder_.write("a.csv", "u,gape\n0,3\n")}, "--deviation");
  expect_refused("fit", {study(), "--to", folder_.write("b.csv", "u,gap\n0,3\n")}, "did you mean 'gape'?");
  const std::string gapes = folder_.write("d.csv", "u,gape,deviation\n0,3,0.1\n");
  expect_refused("fit", {study(), "--to", gapes, "--to", folder_.write("e.csv", "force,dent\n1,2\n")},
                 "needs the column radius");
  expect_refused("fit",
                 {study(), "--to", gapes, "--to", folder_.write("f.csv", "tension,deviation\n1,0.1\n")},
                 "skin.edges");
  expect_refused(
      "fit", {study(), "--to", folder_.write("c.csv", "u,gape\n0,3\n"), "--deviation", "1", "--out", study()},
      "study.dffd");
}

}  // namespace cleft
