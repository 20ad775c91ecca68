// Which fields may be superposed as the skin's tension turns.
#include "explorer/wound/prestress_fields.h"

#include <gtest/gtest.h>

#include <map>

#include "base/error.h"
#include "encoder/field/file/field_file.h"
#include "tests/support/temporary_folder.h"
#include "tests/wound/fields.h"

namespace cleft {

namespace {

/// Three cases of independent prestresses, with further parameters; their texts in the fields' own files
/// alone.
class ThreeCases {
 public:
  explicit ThreeCases(const std::map<std::string, Value>& further) {
    const Prestress values[] = {{0.01, 0, 0}, {0, 0.01, 0}, {0.01, 0.01, 0.005}};
    std::vector<StudyCase> cases;
    for (const Prestress& prestress : values) {
      Field field = testing::opening_field({-10, 20, 3}, 40, 30, 8, 4);
      Parameters p;
      p.skin.prestress = prestress;
      field.parameters = RecordedParameters(p);
      for (const auto& [name, value] : further) field.parameters.set(name, value);
      const std::string name = "case" + std::to_string(cases.size());
      write_field(folder_ / (name + ".dffd"), field);
      cases.push_back({name, folder_ / (name + ".dffd"), {}});
    }
    write_study(file(), study_records(cases));
  }

  std::string file() const { return folder_ / "study.dffd"; }
  /// What the study is refused for; empty where its fields superpose.
  std::string refusal() const {
    std::string of_file, of_case;
    try {
      PrestressFields fields(file());
    } catch (const InputError& e) {
      of_file = e.what();
    }
    try {
      PrestressFields fields(PublishedStudy(file()), 1);  // as the explorer and cleft haptic read it
    } catch (const InputError& e) {
      of_case = e.what();
    }
    EXPECT_EQ(of_file, of_case);
    return of_file;
  }

 private:
  TemporaryFolder folder_;
};

}  // namespace

TEST(PrestressFields, ThoseOfSmallStrainsSuperpose) {
  const ThreeCases cases({});
  EXPECT_EQ(cases.refusal(), "");
  const PathPrestress path{{0, 20}, {{0.02, 0.005, 0.001}, {0.02, 0.005, 0.001}}};
  const PrestressFields fields(cases.file());
  EXPECT_NO_THROW(fields.along(path));
}

TEST(PrestressFields, ThoseOfFiniteStrainsAreRefused) {
  for (const char* law : {"st-venant-kirchhoff", "neo-hookean", "fung"}) {
    const ThreeCases cases({{"model", std::string("finite")}, {"skin.law", std::string(law)}});
    EXPECT_EQ(cases.refusal(), cases.file() +
                                   ": fields do not superpose with model = finite; interpolate the "
                                   "tension's own field from a study (cleft interpolate)");
  }
}

TEST(PrestressFields, ThoseOfContactOrAStiffeningTensionAreRefused) {
  for (const auto& [name, value] : std::map<std::string, Value>{{"cut.contact", "true"},
                                                                {"skin.initial_stress_stiffness", "true"},
                                                                {"skin.turning_stiffness", 0.5}}) {
    const ThreeCases cases({{name, value}});
    EXPECT_NE(cases.refusal().find(name), std::string::npos);
  }
}

}  // namespace cleft
