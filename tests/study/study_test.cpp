// Opening a study folder.
#include "explorer/study/study.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "base/error.h"
#include "base/output_file.h"
#include "base/text.h"
#include "encoder/field/file/field_file.h"
#include "encoder/field/file/study_file.h"
#include "tests/support/recorded.h"
#include "tests/view/synthetic_field.h"

namespace cleft {
namespace {

namespace fs = std::filesystem;

class StudyTest : public testing::Test {
 protected:
  StudyTest() {
    const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(testing::TempDir()) / (std::string("cleft_study_") + test->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "cases");
  }
  ~StudyTest() override { fs::remove_all(folder_); }

  std::string add_case(const std::string& name, const std::map<std::string, double>& parameters,
                       bool published = true) {
    const fs::path folder = folder_ / "cases" / name;
    fs::create_directories(folder);
    Field field = synthetic_field(3);
    field.parameters = recorded(parameters);
    field.case_hash = name;
    write_field((folder / "case.dffd").string(), field);
    if (published) write_text_file((folder / "manifest.json").string(), "{}");
    return (folder / "case.dffd").string();
  }

  static std::string message_of(const std::string& path) {
    try {
      PublishedStudy study(path);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }

  fs::path folder_;
};

TEST_F(StudyTest, CasesAreNamedByWhatVariesAndSortedByValue) {
  add_case("a", {{"cut.depth", 6}, {"skin.prestress_v", 0.03}, {"tissue.young_modulus", 0.1}});
  add_case("b", {{"cut.depth", 6}, {"skin.prestress_v", 0.03}, {"tissue.young_modulus", 0.02}});
  add_case("c", {{"cut.depth", 6}, {"skin.prestress_v", 0.005}, {"tissue.young_modulus", 0.1}});
  PublishedStudy study(folder_.string());
  ASSERT_EQ(study.size(), 3);
  EXPECT_EQ(study.name(0), "skin.prestress_v=0.005 tissue.young_modulus=0.1");
  EXPECT_EQ(study.name(1), "skin.prestress_v=0.03 tissue.young_modulus=0.02");
  EXPECT_EQ(study.name(2), "skin.prestress_v=0.03 tissue.young_modulus=0.1");
  const char* hashes[] = {"c", "b", "a"};
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(study.field(i)->case_hash, hashes[i]);
    EXPECT_EQ(study.field(i)->parameters, study.parameters(i));
  }
}

TEST_F(StudyTest, FieldsAreReadWhenAskedForAndKept) {
  add_case("a", {{"cut.depth", 6}});
  const std::string second = add_case("b", {{"cut.depth", 7}});
  PublishedStudy study(folder_.string());
  const std::shared_ptr<const Field> kept = study.field(1);
  fs::remove(second);
  EXPECT_EQ(study.field(1), kept);
  EXPECT_EQ(study.field(0)->parameters->cut.depth, 6);
}

TEST_F(StudyTest, OnlyTheCasesLookedAtLastAreKept) {
  for (std::size_t i = 0; i <= PublishedStudy::kept; ++i)
    add_case("case" + std::to_string(i), {{"cut.depth", 3 + 0.1 * static_cast<double>(i)}});
  PublishedStudy study(folder_.string());
  const std::weak_ptr<const Field> first = study.field(0), second = study.field(1);
  for (int i = 2; i < study.size() - 1; ++i) study.field(i);
  study.field(0);  // looked at again
  EXPECT_FALSE(first.expired());
  EXPECT_FALSE(second.expired());
  study.field(study.size() - 1);
  EXPECT_FALSE(first.expired());
  EXPECT_TRUE(second.expired()) << "nobody has looked at it for longest";
}

TEST_F(StudyTest, WhatIsNotPublishedIsNotThere) {
  add_case("a", {{"cut.depth", 6}});
  add_case("b", {{"cut.depth", 7}}, false);
  EXPECT_EQ(PublishedStudy(folder_.string()).size(), 1);
}

TEST_F(StudyTest, ASingleFileIsAStudyOfOneCase) {
  const std::string file = add_case("a", {{"cut.depth", 6}});
  PublishedStudy study(file);
  ASSERT_EQ(study.size(), 1);
  EXPECT_EQ(study.name(0), "case.dffd");
}

TEST_F(StudyTest, APackedStudyIsTheSameAsItsFolder) {
  const std::string first = add_case("a", {{"cut.depth", 7}}), second = add_case("b", {{"cut.depth", 6}});
  const std::string file = (folder_ / "study.dffd").string();
  write_study(file, study_records({{"a", first}, {"b", second}}));
  PublishedStudy folder(folder_.string()), packed(file);
  ASSERT_EQ(packed.size(), 2);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(packed.name(i), folder.name(i));
    EXPECT_EQ(packed.parameters(i), folder.parameters(i));
    EXPECT_EQ(packed.field(i)->case_hash, folder.field(i)->case_hash);
    EXPECT_EQ(packed.field(i)->coefficients(), folder.field(i)->coefficients());
  }
}

TEST_F(StudyTest, NothingToShowNamesTheRemedy) {
  EXPECT_NE(message_of(folder_.string()).find("cleft run"), std::string::npos);
  EXPECT_NE(message_of((folder_ / "absent").string()).find("no such file"), std::string::npos);
}

TEST_F(StudyTest, ADamagedFieldIsNamed) {
  const std::string file = add_case("a", {{"cut.depth", 6}});
  write_text_file(file, "this is no HDF5 file");
  EXPECT_NE(message_of(folder_.string()).find(file), std::string::npos);
}

TEST_F(StudyTest, DamagedCasesAreLeftOutAndNamed) {
  const std::string gone = add_case("a", {{"cut.depth", 1}}), flipped = add_case("b", {{"cut.depth", 2}});
  add_case("c", {{"cut.depth", 3}});
  fs::remove(gone);
  std::string bytes = read_text_file(flipped);
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  write_text_file(flipped, bytes);
  PublishedStudy study(folder_.string());
  EXPECT_EQ(study.size(), 1);
  EXPECT_EQ(study.damaged().size(), 2u);
  ASSERT_EQ(study.left_out().size(), 1u);
  EXPECT_NE(study.left_out()[0].find("gone or damaged: cases a, b; cleft run STUDY.toml --out"),
            std::string::npos)
      << study.left_out()[0];
  EXPECT_NO_THROW(study.read(0));
}

}  // namespace

}  // namespace cleft
