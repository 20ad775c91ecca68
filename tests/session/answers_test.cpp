// Questions to the study as a whole, against what the study was made of.
#include <cstdlib>

#include "base/text.h"
#include "explorer/study/case_figures.h"
#include "params/study.h"
#include "tests/session/session_fixture.h"

namespace cleft {
namespace {

/// A folder with a study of three by three cases, made once.
const std::string& study_of_nine() {
  static const TemporaryFolder folder;
  static const std::string study = [] {
    for (const double prestress : {0.02, 0.035, 0.05})
      for (const double modulus : {0.01, 0.025, 0.04}) {
        const std::string name = "case" + shortest(prestress) + "-" + shortest(modulus),
                          place = folder / ("study/cases/" + name);
        std::filesystem::create_directories(place);
        Field field = synthetic_field(100 * prestress + 10 * modulus);
        field.parameters = recorded({{"skin.prestress_v", prestress}, {"tissue.young_modulus", modulus}});
        field.case_hash = name;
        write_field(place + "/case.dffd", field);
        write_text_file(place + "/manifest.json", "{}");
      }
    return folder / "study";
  }();
  return study;
}

class Answers : public SessionTest {
 protected:
  Answers() { setenv("CLEFT_BIN", CLEFT_BIN, 1); }
  void open() { say("open " + study_of_nine()); }
};

/// Gapes of the study are in proportion to 100 p + 10 E, over p from .02 to .05 and E from .01 to .04: of two
/// uniform terms over 3 and .3, the first makes 9 / 9.09 of the variance, and they do not interact.
TEST_F(Answers, SharesOfTheVarianceAreThoseOfTheSum) {
  EXPECT_NE(refused("analyze").find("no study is open"), std::string::npos);
  open();
  say("analyze");
  EXPECT_EQ(state().analyzed, "gape");
  const StudyAnalysis* found = session_.cases().known_analysis("gape");
  ASSERT_TRUE(found);
  ASSERT_EQ(found->effects.size(), 2u);
  EXPECT_EQ(found->effects[0].name, "skin.prestress_v");
  EXPECT_NEAR(found->effects[0].first, 9 / 9.09, 0.02);
  EXPECT_NEAR(found->effects[1].total, 0.09 / 9.09, 0.02);
  EXPECT_NE(answers_.find("skin.prestress_v: 9"), std::string::npos) << answers_;
  EXPECT_EQ(session_.cases().known_analysis("displacement"), nullptr);
  const std::string before = state_to_json(state());
  EXPECT_NE(refused("analyze gap").find("gap"), std::string::npos);
  EXPECT_EQ(state_to_json(state()), before);
  EXPECT_EQ(state_from_json(before).analyzed, "gape");
}

TEST_F(Answers, WhatFitsIsShown) {
  open();
  // The opening of p = .04, E = .02, which p = .041, E = .01 has too: only the sum is known.
  const double opening = gape(synthetic_field(4.2), 0, 30);
  write_text_file(folder_ / "measured.csv", "u,gape,deviation\n0," + std::to_string(opening) + ",0.02\n");
  say("fit " + folder_ / "measured.csv");
  const double p = state().parameters.at("skin.prestress_v"),
               modulus = state().parameters.at("tissue.young_modulus");
  EXPECT_NEAR(100 * p + 10 * modulus, 4.2, 0.1);
  ASSERT_TRUE(session_.between()) << "and not simulated";
  EXPECT_NEAR(gape(*session_.field(), 0, 30), opening, 0.1);
  EXPECT_NE(answers_.find("tell little of tissue.young_modulus"), std::string::npos) << answers_;
  EXPECT_NE(refused("fit " + folder_ / "gone.csv").find("gone.csv"), std::string::npos);
}

TEST_F(Answers, WhatIsBestIsShown) {
  open();
  say("maximize gape where skin.prestress_v < 0.03");
  EXPECT_NEAR(state().parameters.at("skin.prestress_v"), 0.03, 1e-5);
  EXPECT_EQ(state().parameters.at("tissue.young_modulus"), 0.04);
  ASSERT_TRUE(session_.between());
  EXPECT_NE(answers_.find("the greatest gape between the cases is at"), std::string::npos) << answers_;
  say("minimize skin.prestress_v where gape > 500");
  EXPECT_NE(answers_.find("nowhere between the cases does 'gape > 500' hold"), std::string::npos) << answers_;
  EXPECT_NE(refused("minimize gap").find("there is no figure 'gap'"), std::string::npos);
}

TEST_F(Answers, AWaitThatIsCancelledEndsTheCommand) {
  open();
  session_.tell_progress_to([](const std::string&, double) { return false; });
  EXPECT_NE(refused("analyze displacement").find("cancelled"), std::string::npos);
  EXPECT_EQ(session_.cases().known_analysis("displacement"), nullptr);
}

TEST_F(Answers, NextCasesAreAStudyFile) {
  write_text_file(folder_ / "study.toml",
                  "name = \"two\"\n[case]\ncut.length = 34\n\n[sampling]\nmethod = \"sobol\"\ncount = 12\n"
                  "[vary]\n\"tissue.young_modulus\" = { from = 0.01, to = 0.03 }\n"
                  "[encode]\ntolerance = 0.02\n");
  StudyProposal proposal;
  proposal.cases = {{{"tissue.young_modulus", 0.0123}, {"skin.thickness", 1.25}},
                    {{"tissue.young_modulus", 0.0271}, {"skin.thickness", 1.75}}};
  write_text_file(folder_ / "next.toml", study_of(folder_ / "study.toml", proposal));
  const Study next = read_study(folder_ / "next.toml");
  const std::vector<Case> cases = cases_of(next);
  ASSERT_EQ(cases.size(), 2u);
  EXPECT_EQ(cases[0].parameters.tissue.young_modulus, 0.0123);
  EXPECT_EQ(cases[1].parameters.tissue.young_modulus, 0.0271);
  EXPECT_EQ(cases[1].parameters.skin.thickness, 1.75);
  EXPECT_EQ(cases[1].parameters.cut.length, 34);
  EXPECT_TRUE(next.base.sensitivities.empty());
  write_text_file(folder_ / "study.toml",
                  "[sampling]\nmethod = \"adaptive\"\nerror = 0.01\nmost = 40\n"
                  "[vary]\n\"tissue.young_modulus\" = { from = 0.01, to = 0.03 }\n"
                  "\"skin.thickness\" = { from = 1, to = 2 }\n");
  write_text_file(folder_ / "next.toml", study_of(folder_ / "study.toml", proposal));
  EXPECT_EQ(read_study(folder_ / "next.toml").base.sensitivities,
            read_study(folder_ / "study.toml").base.sensitivities)
      << "those that adaptive sampling takes by itself";
  EXPECT_FALSE(read_study(folder_ / "next.toml").base.sensitivities.empty());
  open();
  EXPECT_NE(refused("propose 3").find("study.toml"), std::string::npos) << "the folder has none";
}

}  // namespace
}  // namespace cleft
