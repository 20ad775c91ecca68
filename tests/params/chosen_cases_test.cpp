#include "params/run/chosen_cases.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "base/output_file.h"
#include "base/sealed_json.h"
#include "tests/support/temporary_folder.h"

namespace cleft {

namespace {

std::string adaptive(const std::string& ranges, const std::string& more = "") {
  return "[vary]\n" + ranges + "[sampling]\nmethod = 'adaptive'\nstart = 4\nmost = 20\nerror = 0.02\n" + more;
}
const std::string one_range = "'cut.depth' = { from = 2, to = 5 }\n";

std::string refusal_of(const std::string& text) {
  const TemporaryFolder folder;
  try {
    read_study(folder.write("study.toml", text));
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

/// A record of two batches of one parameter.
std::string record_of(const std::string& figure) {
  return sealed_text({{"version", 2},
                      {"figure", figure},
                      {"names", {"cut.depth"}},
                      {"batches",
                       {{{"cases", 4}, {"error", 0.2}, {"values", {{2.25}, {4.9}}}},
                        {{"cases", 6}, {"error", 0.05}, {"values", {{3.3}}}}}}});
}

}  // namespace

TEST(ChosenCases, AreThoseOfTheRecordAfterTheFirst) {
  const TemporaryFolder files;
  const Study study = read_study(files.write("study.toml", adaptive(one_range)));
  const StudyFolder folder = StudyFolder::create(files / "out", study);
  EXPECT_EQ(cases_of(study, folder).size(), 4u);
  write_text_file(files / "out/chosen.json", record_of("field"));
  const std::vector<Case> cases = cases_of(study, folder);
  ASSERT_EQ(cases.size(), 7u);
  EXPECT_EQ(cases[4].parameters.cut.depth, 2.25);
  EXPECT_EQ(cases[6].parameters.cut.depth, 3.3);
  EXPECT_EQ(chosen_cases(folder, study).batches[1].error, 0.05);

  // Those outside of a smaller range are left out; another figure has no batches yet.
  const Study narrow =
      read_study(files.write("narrow.toml", adaptive("'cut.depth' = { from = 2, to = 4 }\n")));
  EXPECT_EQ(cases_of(narrow, folder).size(), 6u);
  const Study other = read_study(files.write("other.toml", adaptive(one_range, "of = 'gape'\n")));
  EXPECT_EQ(cases_of(other, folder).size(), 4u);

  std::string damaged = record_of("field");
  damaged[damaged.find("2.25")] = '3';
  write_text_file(files / "out/chosen.json", damaged);
  EXPECT_THROW(cases_of(study, folder), FileError);
}

TEST(ChosenCases, HoldDerivativesByTheRangesUnlessTheFileSaysOtherwise) {
  const TemporaryFolder files;
  const std::string ranges = one_range +
                             "'tissue.young_modulus' = { from = 0.01, to = 0.03 }\n"
                             "'skin.bending_stiffness' = { from = 0, to = 0.1 }\n";
  const auto of = [&](const std::string& text) {
    return cases_of(read_study(files.write("study.toml", text))).at(0).sensitivities;
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(of(adaptive(ranges)), Names{"tissue.young_modulus"});  // of 0 bending there is none
  EXPECT_EQ(of("sensitivities = []\n" + adaptive(ranges)), Names{});
  EXPECT_EQ(of("sensitivities = ['skin.thickness']\n" + adaptive(ranges)), Names{"skin.thickness"});
  EXPECT_EQ(of("[case]\nmodel = 'finite'\n" + adaptive(ranges)), Names{});
  EXPECT_EQ(of("[vary]\n'tissue.young_modulus' = [0.01, 0.02]\n"), Names{});
}

TEST(ChosenCases, AreFewerAtATimeWhereTheyHoldDerivatives) {
  const TemporaryFolder files;
  const auto of = [&](const std::string& before, const std::string& more) {
    const SamplingSettings s =
        read_study(
            files.write("study.toml", before +
                                          "[vary]\n'tissue.young_modulus' = { from = 0.01, to = 0.03 }\n"
                                          "'cut.depth' = { from = 2, to = 5 }\n"
                                          "[sampling]\nmethod = 'adaptive'\nmost = 20\nerror = 0.02\n" +
                                          more))
            .sampling;
    return std::pair(s.count, s.batch);
  };
  EXPECT_EQ(of("", ""), std::pair(std::size_t{8}, std::size_t{4}));
  EXPECT_EQ(of("sensitivities = []\n", ""), std::pair(std::size_t{12}, std::size_t{8}));
  EXPECT_EQ(of("", "start = 5\nbatch = 3\n"), std::pair(std::size_t{5}, std::size_t{3}));
}

TEST(ChosenCases, AStudyThatWasBegunWithoutDerivativesGoesOnWithout) {
  const TemporaryFolder files;
  const std::string range = "'skin.thickness' = { from = 1, to = 2 }\n";
  const Study study = read_study(files.write("study.toml", adaptive(range)));
  const StudyFolder folder = StudyFolder::create(files / "out", study);
  EXPECT_EQ(cases_of(study, folder).at(0).sensitivities.size(), 1u);
  const auto with_record = [&](bool with) {
    nlohmann::ordered_json json = {{"version", 2}, {"figure", "field"}, {"names", {"skin.thickness"}}};
    if (with) json["sensitivities"] = {"skin.thickness"};
    json["batches"].push_back(
        {{"cases", with ? 4 : 6}, {"error", 0.2}, {"values", nlohmann::json::array({{1.3}})}});
    write_text_file(files / "out/chosen.json", sealed_text(json));
    return cases_of(study, folder);
  };
  for (const bool with : {false, true}) {
    const std::vector<Case> cases = with_record(with);
    ASSERT_EQ(cases.size(), with ? 5u : 7u);  // it may have had more first ones
    for (const Case& one : cases) EXPECT_EQ(one.sensitivities.size(), with ? 1u : 0u);
  }
  with_record(false);
  const Study said =
      read_study(files.write("said.toml", "sensitivities = ['skin.thickness']\n" + adaptive(range)));
  EXPECT_EQ(cases_of(said, folder).at(4).sensitivities.size(), 1u);
}

TEST(ChosenCases, EndWhereEveryCaseOfABatchFailed) {
  const TemporaryFolder files;
  const Study study = read_study(files.write("study.toml", adaptive(one_range)));
  const StudyFolder folder = StudyFolder::create(files / "out", study);
  for (const Case& one : cases_of(study, folder)) {
    const Attempt attempt = folder.begin(one.hash());
    folder.fail(attempt, "the mesh is empty");
  }
  EXPECT_EQ(choose_more(folder, study).choice, Choice::failed);
}

TEST(ChosenCases, TellHowManyMoreAreExpected) {
  // An error that falls with the square of the number.
  ChosenCases chosen;
  for (const int cases : {10, 20, 30}) chosen.batches.push_back({cases, 8. / (cases * cases), {}});
  EXPECT_NEAR(cases_for(chosen, 0.005).value(), 40, 1);
  chosen.batches.pop_back();
  EXPECT_FALSE(cases_for(chosen, 0.005));
  chosen.batches.push_back({30, 0.09, {}});  // it does not fall
  EXPECT_FALSE(cases_for(chosen, 0.005));
}

TEST(AdaptiveSampling, RefusesWhatItCannotUse) {
  EXPECT_EQ(refusal_of(adaptive(one_range)), "");
  const auto expect = [](const std::string& text, const std::string& part) {
    EXPECT_NE(refusal_of(text).find(part), std::string::npos) << refusal_of(text);
  };
  const TemporaryFolder folder;
  const auto first = [&](const std::string& text) {
    return read_study(folder.write("s.toml", text)).sampling.count;
  };
  const std::string settings = "[sampling]\nmethod = 'adaptive'\nerror = 0.1\nmost = ";
  EXPECT_EQ(first("[vary]\n" + one_range + settings + "40\n"), 12u);
  EXPECT_EQ(first("[vary]\n" + one_range + settings + "8\n"), 8u);
  expect(adaptive(""), "draws from ranges");
  expect(adaptive(one_range, "count = 7\n"), "takes start and most; remove count");
  expect(adaptive(one_range, "batch = 0\n"), "sampling.batch = 0");
  expect(adaptive(one_range, "of = 3\n"), "sampling.of");
  expect("[vary]\n" + one_range + "[sampling]\nmethod = 'adaptive'\nmost = 20\n", "sampling.error");
  expect("[vary]\n" + one_range + "[sampling]\nmethod = 'adaptive'\nerror = 0.1\n", "needs most = n");
  expect("[vary]\n" + one_range + "[sampling]\nmethod = 'adaptive'\nerror = 0.1\nstart = 9\nmost = 8\n",
         "at least start, 9");
  expect("[vary]\n" + one_range + "[sampling]\nmethod = 'sobol'\ncount = 4\nmost = 8\n",
         "is for method \"adaptive\"");
}

}  // namespace cleft
