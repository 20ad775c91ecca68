#include "params/study.h"

#include <gtest/gtest.h>

#include <set>

#include "base/error.h"
#include "tests/support/temporary_folder.h"

namespace cleft {

namespace {

std::string message_of(const std::string& text) {
  const TemporaryFolder folder;
  try {
    cases_of(read_study(folder.write("study.toml", text)));
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

}  // namespace

TEST(Study, GridTakesEveryCombination) {
  const TemporaryFolder folder;
  const Study study = read_study(folder.write("s.toml", R"(
name = "forearm"
[case]
skin.thickness = 2
[vary]
"tissue.young_modulus" = [0.01, 0.02, 0.04]
skin.prestress_v = { from = 0.01, to = 0.05, count = 5 }
[encode]
control_points = [20, 12, 8, 10]
)"));
  const std::vector<Case> cases = cases_of(study);
  ASSERT_EQ(cases.size(), 15u);
  std::set<std::pair<double, double>> seen;
  std::set<std::string> hashes;
  for (const Case& one : cases) {
    EXPECT_EQ(one.parameters.skin.thickness, 2);
    seen.insert({one.parameters.tissue.young_modulus, one.parameters.skin.prestress_v});
    hashes.insert(one.hash());
  }
  EXPECT_EQ(seen.size(), 15u);
  EXPECT_EQ(hashes.size(), 15u);
  EXPECT_TRUE(seen.contains({0.04, 0.05})) << "the range's end must be exact";
}

TEST(Study, ListPairsTheValues) {
  const TemporaryFolder folder;
  const auto cases = cases_of(read_study(folder.write(
      "s.toml", "[vary]\n'skin.thickness' = [1, 2]\n'cut.depth' = [3, 4]\n[sampling]\nmethod = 'list'\n")));
  ASSERT_EQ(cases.size(), 2u);
  EXPECT_EQ(cases[1].parameters.skin.thickness, 2);
  EXPECT_EQ(cases[1].parameters.cut.depth, 4);
}

TEST(Study, EveryMistakeIsToldAtOnce) {
  const std::string text = message_of(
      "[case]\nskin.thicknes = 1\npatch.height = -2\n[encode]\ncontrol_points = [3, 12, 8, "
      "10]\n[vary]\n'cut.frames' = ['row']\n");
  for (const char* part :
       {"line 2: unknown parameter 'skin.thicknes' (did you mean 'skin.thickness'?)",
        "line 3: patch.height = -2: must be greater than 0 mm", "line 5: 3 control points along u",
        "line 7: cut.frames = row: must be \"column\" or \"pair\""})
    EXPECT_NE(text.find(part), std::string::npos) << "missing: " << part << "\nin: " << text;
}

TEST(Study, BadFilesAreRefused) {
  EXPECT_NE(message_of("[case\n"), "");
  EXPECT_NE(message_of("[cases]\n").find("did you mean 'case'"), std::string::npos);
  EXPECT_NE(message_of("case = 3\n"), "");
  EXPECT_NE(message_of("[vary]\n'skin.thickness' = []\n"), "");
  EXPECT_NE(message_of("[vary]\n'skin.thickness' = { from = 1, to = 2 }\n"), "");
  EXPECT_NE(message_of("[vary]\n'skin.thickness' = [1, 2]\n'cut.depth' = [3]\n[sampling]\nmethod = 'list'\n"),
            "");
  EXPECT_NE(message_of("[sampling]\nmethod = 'grit'\n").find("did you mean 'grid'"), std::string::npos);
  EXPECT_NE(message_of("[encode]\ntolerence = 0.1\n"), "");
}

TEST(Study, ACaseThatDoesNotFitIsNamed) {
  EXPECT_NE(message_of("[vary]\n'cut.length' = [10, 70]\n").find("cut.length = 70"), std::string::npos);
}

TEST(Case, ItsFileResolvesToTheSameCase) {
  const TemporaryFolder folder;
  Case one;
  one.parameters.tissue.young_modulus = 1.0 / 3;
  one.parameters.cut.frames = "pair";
  one.encode.control_points = {20, 12, 8, 10};
  const Case again = read_case(folder.write("case.toml", case_file_text(one)), {});
  EXPECT_EQ(again.hash(), one.hash());
  EXPECT_NE(again.hash(), Case().hash());
}

TEST(Case, EncodingAgainIsNotSolvingAgain) {
  Case one, other;
  other.encode.control_points = {20, 12, 8, 10};
  EXPECT_NE(one.hash(), other.hash());
  EXPECT_EQ(solve_hash(one.parameters), solve_hash(other.parameters));
}

TEST(Case, SetOverridesTheFile) {
  const TemporaryFolder folder;
  const std::string file = folder.write("case.toml", "[case]\nskin.thickness = 1\n");
  EXPECT_EQ(read_case(file, {"skin.thickness=2.5"}).parameters.skin.thickness, 2.5);
}

TEST(Study, ACaseThatStandsTwiceIsNamed) {
  EXPECT_NE(message_of("[vary]\n'skin.thickness' = [1, 2, 1]\n").find("stands twice"), std::string::npos);
}

TEST(Study, TooManyCasesAreRefusedBeforeTheyAreMade) {
  EXPECT_NE(message_of("[vary]\n'skin.thickness' = { from = 1, to = 2, count = 100000000 }\n"), "");
  EXPECT_NE(message_of("[vary]\n'skin.thickness' = { from = 1, to = 2, count = 10000 }\n"
                       "'cut.depth' = { from = 1, to = 2, count = 10000 }\n"),
            "");
  EXPECT_NE(message_of("[vary]\n'skin.thickness' = { from = 1, to = 2, count = 3, cuont = 4 }\n"), "");
  EXPECT_NE(message_of("[encode]\ncontrol_points = [4294967322, 16, 9, 16]\n"), "");
}

TEST(Case, AStudyIsNoCase) {
  const TemporaryFolder folder;
  EXPECT_THROW(read_case(folder.write("s.toml", "[vary]\n'skin.thickness' = [1, 2]\n"), {}), InputError);
}

}  // namespace cleft
