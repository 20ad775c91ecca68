#include "encoder/field/file/study_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <optional>

#include "base/error.h"
#include "base/h5/h5.h"
#include "base/text.h"
#include "encoder/field/file/columns.h"
#include "encoder/field/file/field_file.h"
#include "tests/field/random_field.h"
#include "tests/support/damage.h"
#include "tests/support/older_field.h"
#include "tests/support/temporary_folder.h"

namespace cleft {

namespace {

/// Equal in all that a field file holds.
bool same_record(const Field& a, const Field& b) {
  const FieldRecord x = record_of(a), y = record_of(b);
  return nlohmann::json(x.header).dump() == nlohmann::json(y.header).dump() &&
         x.coefficients == y.coefficients;
}

struct Packed {
  explicit Packed(const std::vector<Field>& list) : fields(list) {
    for (std::size_t i = 0; i < fields.size(); ++i) {
      const std::string name = "case" + std::to_string(i);
      write_field(folder / (name + ".dffd"), fields[i]);
      cases.push_back({name, folder / (name + ".dffd"), {}});
    }
    write_study(file(), study_records(cases));
  }
  std::string file() const { return folder / "study.dffd"; }

  TemporaryFolder folder;
  std::vector<Field> fields;
  std::vector<StudyCase> cases;
};

std::vector<Field> different_fields() {
  Field plain = random_field(), other = following_field(50);
  other.parameters.erase("cut.depth");
  other.report.condition = std::nan("");
  plain.quantities.push_back({"stress", 1, std::vector<double>(plain.coefficients().size(), 0.5)});
  return {following_field(0), plain, following_field(1), other};
}

}  // namespace

TEST(StudyFile, HoldsEveryFieldAsItsOwnFileDoes) {
  const Packed packed(different_fields());
  const StudyFile study(packed.file());
  ASSERT_EQ(study.size(), 4);
  for (const int i : {2, 0, 3, 1}) {
    const Field& field = packed.fields[i];
    EXPECT_EQ(study.name(i), "case" + std::to_string(i));
    EXPECT_EQ(study.case_hash(i), field.case_hash);
    EXPECT_EQ(study.parameters(i), field.parameters);
    EXPECT_EQ(study.report(i).node_error, field.report.node_error);
    EXPECT_EQ(study.coefficient_bytes(i), record_of(field).coefficients.size());
    EXPECT_TRUE(same_record(study.field(i), field)) << i;
  }
  EXPECT_TRUE(std::isnan(study.report(3).condition));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(packed.folder.path()), {}), 5);
}

TEST(StudyFile, NamesThatAreNoFoldersOrTwiceThereAreRefused) {
  for (const std::string name : {"..", "../evil", "a/b", ".hidden", "", "case1"}) {
    Packed packed(different_fields());
    packed.cases[0].name = name;
    write_study(packed.file(), study_records(packed.cases));
    EXPECT_THROW(StudyFile(packed.file()), FileError) << name;
  }
}

TEST(StudyFile, KeepsParametersThatAreText) {
  Packed packed(different_fields());
  packed.cases[0].choices.set("cut.contact", "true");
  packed.cases[0].choices.set("tissue.formulation", "displacement");
  packed.cases[3].choices.set("cut.contact", "false");
  write_study(packed.file(), study_records(packed.cases));
  const StudyFile study(packed.file());
  EXPECT_EQ(study.parameters(0).texts(), packed.cases[0].choices.texts());
  EXPECT_TRUE(study.parameters(1).texts().empty());
  EXPECT_EQ(study.parameters(3).texts(), packed.cases[3].choices.texts());
  Field first = packed.fields[0];
  for (const auto& [name, value] : packed.cases[0].choices.texts()) first.parameters.set(name, value);
  EXPECT_TRUE(same_record(study.field(0), first));
  EXPECT_EQ(study.parameters(3).numbers(), packed.fields[3].parameters.numbers());
}

TEST(StudyFile, IsLittleMoreThanItsCoefficients) {
  std::vector<Field> fields;
  for (int n = 0; n < 40; ++n) fields.push_back(following_field(n));
  const Packed packed(fields);
  const StudyFile study(packed.file());
  std::size_t coefficients = 0;
  for (int i = 0; i < study.size(); ++i) coefficients += study.coefficient_bytes(i);
  const std::size_t beside = std::filesystem::file_size(packed.file()) - coefficients;
  EXPECT_LT(beside,
            5000 + 300 * fields.size());  // what is shared, once; report, names and parameters of each
}

TEST(StudyFile, DamageIsNoticed) {
  const Packed packed(different_fields());
  std::vector<Field> found;
  EXPECT_EQ(unnoticed_damages(
                packed.file(), 250,
                [&](const std::string& file) {
                  found.clear();
                  const StudyFile study(file);
                  for (int i = 0; i < study.size(); ++i) found.push_back(study.field(i));
                },
                [&] {
                  bool all = found.size() == packed.fields.size();
                  for (std::size_t i = 0; all && i < found.size(); ++i)
                    all = same_record(found[i], packed.fields[i]);
                  return all;
                }),
            0);
}

TEST(StudyFile, ACaseIsReadWithoutTheOthers) {
  std::vector<Field> fields;
  for (int n = 0; n < 8; ++n) fields.push_back(following_field(n));
  const Packed packed(fields);
  // One bit in the middle of the coefficients, which stand behind one another.
  const std::string bytes = record_of(fields[4]).coefficients.empty() ? "" : read_text_file(packed.file());
  const auto coded = record_of(fields[4]).coefficients;
  const std::size_t at = bytes.find(std::string(coded.begin() + 4000, coded.begin() + 4100));
  ASSERT_NE(at, std::string::npos);
  std::string damaged = bytes;
  damaged[at] = static_cast<char>(damaged[at] ^ 4);
  const std::string file = packed.folder.write("damaged.dffd", damaged);
  const StudyFile study(file);
  EXPECT_TRUE(same_record(study.field(0), fields[0]));
  EXPECT_TRUE(same_record(study.field(7), fields[7]));
  EXPECT_THROW(study.field(4), FileError);
}

TEST(StudyFile, WhatIsNoneIsNamed) {
  const TemporaryFolder folder;
  write_field(folder / "a.dffd", following_field());
  EXPECT_THROW(StudyFile(folder / "a.dffd"), FileError);
  EXPECT_THROW(StudyFile(folder / "absent.dffd"), FileError);
  EXPECT_THROW(write_study(folder / "b.dffd", study_records({{"x", folder / "absent.dffd"}})), FileError);
  EXPECT_FALSE(std::filesystem::exists(folder / "b.dffd"));
  write_study(folder / "c.dffd", {});
  EXPECT_EQ(StudyFile(folder / "c.dffd").size(), 0);
  h5::File file = h5::File::create(folder / "d.dffd");
  file.write_text("/", "format", "cleft-study");
  file.write_number("/", "version", 7);
  file.close();
  EXPECT_THROW(StudyFile(folder / "d.dffd"), FileError);
}

TEST(StudyFile, CasesOfAnOlderFormatAreLeftOutByName) {
  const TemporaryFolder study;
  publish_older_case(study.path(), "old");
  EXPECT_TRUE(is_older_field(study / "cases/old/case.dffd"));
  try {
    published_study_cases(study.path());
    FAIL() << "there is no case to be read";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("case old; cleft run"), std::string::npos) << e.what();
  }
  std::filesystem::create_directories(study / "cases/new");
  study.write("cases/new/manifest.json", "{\"version\": 1}");
  write_field(study / "cases/new/case.dffd", following_field());
  EXPECT_FALSE(is_older_field(study / "cases/new/case.dffd"));
  std::vector<std::string> older;
  const auto cases = published_study_cases(study.path(), &older);
  ASSERT_EQ(cases.size(), 1u);
  EXPECT_EQ(cases[0].name, "new");
  EXPECT_EQ(older, std::vector<std::string>{"old"});
}

TEST(Columns, GiveBackTheHeaders) {
  std::vector<Json> headers;
  for (int n = 0; n < 30; ++n) {
    Json header = {
        {"parameters", Json::object()}, {"case", "c" + std::to_string(n)}, {"cut", {{"depth", n / 10}}}};
    header["parameters"]["same"] = 4;
    if (n % 3) header["parameters"]["x/y"] = n % 2 ? Json(nullptr) : Json(0.5);
    header["bases"]["along"] = {{"degree", 3}};
    headers.push_back(header);
  }
  const Json columns = columns_of(headers);
  EXPECT_TRUE(columns["parameters/same"].contains("all"));
  EXPECT_TRUE(columns["cut"].contains("of"));
  EXPECT_TRUE(columns["case"].contains("each"));
  const Columns again(Json::parse(columns.dump()), headers.size());
  for (std::size_t n = 0; n < headers.size(); ++n) {
    EXPECT_EQ(nlohmann::json(again.header(n)), nlohmann::json(headers[n])) << n;
    EXPECT_EQ(nlohmann::json(again.group("parameters", n)["parameters"]),
              nlohmann::json(headers[n]["parameters"]));
  }
  EXPECT_THROW(again.entry("none", 0), InputError);
  // Columns of another number of cases, indices beyond their values, and what is no column.
  EXPECT_THROW(Columns(columns, 31), InputError);
  Json wrong = columns;
  wrong["cut"]["of"][7] = 3;
  EXPECT_THROW(Columns(wrong, 30), InputError);
  wrong = columns;
  wrong["case"] = "c";
  EXPECT_THROW(Columns(wrong, 30), InputError);
  EXPECT_THROW(Columns(Json::array(), 30), InputError);
}

}  // namespace cleft
