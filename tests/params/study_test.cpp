#include "params/study.h"

#include <gtest/gtest.h>

#include <set>

#include "base/error.h"
#include "params/solve_hash.h"
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

TEST(StudyFile, OptionsOfSbatchAreLongOptions) {
  const TemporaryFolder folder;
  const auto read = [&](const std::string& list) {
    return read_study(folder.write("s.toml", "[slurm]\noptions = [" + list + "]\n")).slurm.options.size();
  };
  EXPECT_EQ(read("'--mem=4G', '--exclusive'"), 2u);
  for (const char* wrong : {"'/path/evil.sh'", "'-n4'", "'--'", "'--mem', '4G'", "'--wrap=evil'", "''"})
    EXPECT_THROW(read(wrong), InputError) << wrong;
}

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
    seen.insert({one.parameters.tissue.young_modulus, one.parameters.skin.prestress.vv});
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
  EXPECT_NE(message_of("[encode]\ntolerence = 0.1\n").find("did you mean 'tolerance'"), std::string::npos);
}

TEST(Study, EncodeTakesAToleranceBetweenItsBounds) {
  const TemporaryFolder folder;
  const auto tolerance_of = [&](const std::string& value) {
    return read_study(folder.write("s.toml", "[encode]\ntolerance = " + value + "\n")).base.encode.tolerance;
  };
  EXPECT_EQ(EncodeSettings().tolerance, 0.01);
  EXPECT_EQ(tolerance_of("0.003"), 0.003);
  EXPECT_EQ(tolerance_of("1e-9"), 1e-9);
  for (const char* value : {"0", "-0.1", "9e-10", "1", "1.5", "nan", "inf"})
    EXPECT_NE(message_of(std::string("\n[encode]\ntolerance = ") + value + "\n")
                  .find("line 3: encode.tolerance = "),
              std::string::npos)
        << value;
  EXPECT_NE(message_of("[encode]\ntolerance = 'fine'\n").find("must be a number"), std::string::npos);
}

TEST(Study, SaysHowItsFileIsPacked) {
  TemporaryFolder folder;
  const std::string vary = "[vary]\n'skin.thickness' = [1, 2]\n";
  EXPECT_EQ(read_study(folder.write("s.toml", vary)).pack_error, 0);
  EXPECT_EQ(read_study(folder.write("s.toml", "pack_error = 0.015\n" + vary)).pack_error, 0.015);
  for (const char* value : {"0", "0.00009", "0.11", "-1", "nan", "inf"})
    EXPECT_NE(message_of(std::string("pack_error = ") + value + "\n" + vary).find("line 1: pack_error = "),
              std::string::npos)
        << value;
  EXPECT_NE(message_of("pack_error = 'low'\n" + vary).find("must be a number"), std::string::npos);
}

TEST(Study, EncodeTakesEitherAToleranceOrControlPoints) {
  const std::string text = message_of("[encode]\ntolerance = 0.01\ncontrol_points = [20, 12, 8, 10]\n");
  EXPECT_NE(text.find("line 3: encode.control_points and encode.tolerance: give one of them"),
            std::string::npos)
      << text;
}

TEST(Study, ControlPointsMayComeWithARegularisation) {
  const TemporaryFolder folder;
  const std::string points = "[encode]\ncontrol_points = [20, 12, 8, 10]\n";
  const Case plain = read_study(folder.write("p.toml", points)).base,
             held = read_study(folder.write("s.toml", points + "regularisation = 3e-5\n")).base;
  EXPECT_FALSE(plain.encode.regularisation);
  EXPECT_EQ(held.encode.regularisation, 3e-5);
  EXPECT_EQ(held.encode.arguments(),
            (std::vector<std::string>{"--parametrization", "front", "--control-points", "20,12,8,10",
                                      "--regularisation", "3e-05"}));
  EXPECT_NE(plain.hash(), held.hash());
  EXPECT_EQ(plain.snapshot_hash(), held.snapshot_hash());
  EXPECT_EQ(read_study(folder.write("c.toml", case_file_text(held))).base.hash(), held.hash());
  for (const char* value : {"0", "-1", "1", "1e-11", "nan"})
    EXPECT_NE(
        message_of(points + "regularisation = " + value + "\n").find("line 3: encode.regularisation = "),
        std::string::npos)
        << value;
  EXPECT_NE(message_of(points + "regularisation = 'weak'\n").find("must be a number"), std::string::npos);
  EXPECT_NE(message_of("[encode]\nregularisation = 3e-5\n").find("line 2: encode.regularisation needs"),
            std::string::npos);
}

TEST(Study, TheLeastControlPointsDependOnTheParametrization) {
  const std::string tip = "[encode]\nparametrization = 'tip'\n",
                    fixed = "[encode]\nparametrization = 'fixed'\n";
  EXPECT_EQ(message_of(tip + "control_points = [10, 8, 7, 4]\n"), "");
  EXPECT_EQ(message_of(fixed + "control_points = [4, 8, 4, 4]\n"), "");
  for (const char* few : {"[9, 8, 7, 4]", "[10, 7, 7, 4]", "[10, 8, 6, 4]", "[10, 8, 7, 3]"}) {
    const std::string points = std::string("control_points = ") + few + "\n";
    EXPECT_NE(message_of(tip + points).find("line 3: "), std::string::npos) << few;
    EXPECT_NE(message_of("[encode]\n" + points).find("line 2: "), std::string::npos) << "tip is the default";
  }
  for (const char* few : {"[3, 8, 4, 4]", "[4, 7, 4, 4]", "[4, 8, 3, 4]", "[4, 8, 4, 3]"})
    EXPECT_NE(message_of(fixed + "control_points = " + few + "\n").find("line 3: "), std::string::npos)
        << few;
  EXPECT_NE(message_of("[encode]\ncontrol_points = [1000, 1000, 10, 10]\n").find("in all"),
            std::string::npos);
  for (const char* other : {"'tips'", "3", "''"})
    EXPECT_NE(message_of(std::string("[encode]\nparametrization = ") + other + "\n")
                  .find("must be \"front\", \"tip\" or \"fixed\""),
              std::string::npos)
        << other;
}

TEST(Study, ACaseThatDoesNotFitIsNamed) {
  EXPECT_NE(message_of("[vary]\n'cut.length' = [10, 170]\n").find("cut.length = 170"), std::string::npos);
}

TEST(Case, ItsBodyIsPartOfWhatItIs) {
  const TemporaryFolder folder;
  folder.write("a \"b\".h5", "one body");
  const std::string study = folder.write("s.toml", "[body]\nfile = 'a \"b\".h5'\n");
  const Case one = read_case(study, {});
  EXPECT_EQ(one.body, folder / "a \"b\".h5");
  EXPECT_NE(one.hash(), Case().hash());
  EXPECT_EQ(read_case(folder.write("case.toml", case_file_text(one)), {}).hash(), one.hash());
  folder.write("a \"b\".h5", "another body");
  EXPECT_NE(read_case(study, {}).hash(), one.hash());
}

TEST(Study, ABodyThatIsMissingIsNamed) {
  EXPECT_NE(message_of("[body]\nfile = 'none.h5'\n").find("body.file = none.h5: there is no "),
            std::string::npos);
  EXPECT_NE(message_of("[body]\n").find("needs file"), std::string::npos);
  EXPECT_NE(message_of("[body]\nfiles = 'a.h5'\n").find("did you mean 'file'"), std::string::npos);
}

TEST(Case, ItsFileResolvesToTheSameCase) {
  const TemporaryFolder folder;
  Case one;
  one.parameters.tissue.young_modulus = 1.0 / 3;
  one.parameters.cut.frames = FrameEvery::pair;
  one.encode.control_points = {20, 12, 8, 10};
  const Case again = read_case(folder.write("case.toml", case_file_text(one)), {});
  EXPECT_EQ(again.hash(), one.hash());
  EXPECT_NE(again.hash(), Case().hash());

  one.encode = {"fixed", 1.0 / 300, {}};
  const Case fixed = read_case(folder.write("case.toml", case_file_text(one)), {});
  EXPECT_EQ(fixed.hash(), one.hash());
  EXPECT_EQ(fixed.encode.tolerance, 1.0 / 300);
  EXPECT_EQ(fixed.encode.parametrization, "fixed");
}

TEST(Case, EncodingAgainIsNotSolvingAgain) {
  Case points, tolerance, fixed;
  points.encode.control_points = {20, 12, 8, 10};
  tolerance.encode.tolerance = 0.02;
  fixed.encode.parametrization = "fixed";
  std::set<std::string> hashes;
  for (const Case& one : {Case(), points, tolerance, fixed}) {
    hashes.insert(one.hash());
    EXPECT_EQ(solve_hash(one.parameters), solve_hash(Case().parameters));
  }
  EXPECT_EQ(hashes.size(), 4u);
}

TEST(Case, ItsSensitivitiesBelongToTheSnapshot) {
  const TemporaryFolder folder;
  Case one;
  EXPECT_EQ(one.snapshot_hash(), solve_hash(one.parameters));
  one.sensitivities = {"tissue.young_modulus", "skin.prestress_v"};
  EXPECT_NE(one.snapshot_hash(), solve_hash(one.parameters));
  EXPECT_NE(one.hash(), Case().hash());
  const Case again = read_case(folder.write("case.toml", case_file_text(one)), {});
  EXPECT_EQ(again.sensitivities, one.sensitivities);
  EXPECT_EQ(again.hash(), one.hash());
  const std::string vary = "[vary]\n'skin.thickness' = [1, 2]\n";
  EXPECT_EQ(message_of("sensitivities = ['tissue.young_modulus']\n" + vary), "");
  EXPECT_NE(message_of("sensitivities = ['tissue.yung_modulus']\n" + vary).find("tissue.young_modulus"),
            std::string::npos);
  EXPECT_NE(message_of("sensitivities = ['cut.length']\n" + vary).find("must be a number of skin"),
            std::string::npos);
  EXPECT_NE(message_of("sensitivities = 'cut.length'\n" + vary).find("must be a list of texts"),
            std::string::npos);
  const std::string contact = "sensitivities = ['skin.thickness']\n[case]\ncut.contact = 'true'\n";
  EXPECT_EQ(message_of(contact), "");
  EXPECT_NE(message_of(contact + "model = 'finite'\n").find("contact"), std::string::npos);
}

TEST(Case, ItsSettingsAreArgumentsOfTheEncoder) {
  EncodeSettings settings;
  EXPECT_EQ(settings.arguments(),
            (std::vector<std::string>{"--parametrization", "front", "--tolerance", "0.01"}));
  settings = {"fixed", 0.01, std::array{20, 12, 8, 10}};
  EXPECT_EQ(settings.arguments(),
            (std::vector<std::string>{"--parametrization", "fixed", "--control-points", "20,12,8,10"}));
}

TEST(Case, SetOverridesTheFile) {
  const TemporaryFolder folder;
  const std::string file = folder.write("case.toml", "[case]\nskin.thickness = 1\n");
  EXPECT_EQ(read_case(file, {"skin.thickness=2.5"}).parameters.skin.thickness, 2.5);
}

/// Over tilted blades displacements alone are too stiff; what a file says holds.
TEST(Study, TiltedCutsHaveMeanDilatationUnlessTheFileTells) {
  TemporaryFolder folder;
  const auto formulations = [&](const std::string& text) {
    folder.write("study.toml", text);
    std::string all;
    for (const Case& one : cases_of(read_study(folder / "study.toml")))
      all += one.parameters.tissue.formulation == TissueFormulation::mean_dilatation ? 'm' : 'd';
    return all;
  };
  const std::string tilts = "[vary]\n'cut.tilt' = [-30, -10, -9, 0, 9, 10, 30]\n";
  EXPECT_EQ(formulations(tilts), "mmdddmm");
  EXPECT_EQ(formulations("[case]\ntissue.formulation = 'displacement'\n" + tilts), "ddddddd");
  EXPECT_EQ(formulations("[vary]\n'cut.tilt' = [0, 30]\n'tissue.formulation' = ['displacement']\n"), "dd");
  EXPECT_EQ(formulations("[case]\nmodel = 'finite'\ntissue.law = 'st-venant-kirchhoff'\n" + tilts),
            "ddddddd");
  EXPECT_EQ(formulations("[case]\nmodel = 'finite'\n" + tilts), "mmdddmm");
  folder.write("case.toml", "[case]\ncut.tilt = 30\n");
  const auto of_case = [&](const std::vector<std::string>& assignments) {
    return read_case(folder / "case.toml", assignments).parameters.tissue.formulation;
  };
  EXPECT_EQ(of_case({}), TissueFormulation::mean_dilatation);
  EXPECT_EQ(of_case({"cut.tilt=5"}), TissueFormulation::displacement);
  EXPECT_EQ(of_case({"tissue.formulation=displacement"}), TissueFormulation::displacement);
  folder.write("again.toml", case_file_text(read_case(folder / "case.toml", {})));
  EXPECT_EQ(read_case(folder / "again.toml", {}).hash(), read_case(folder / "case.toml", {}).hash());
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
