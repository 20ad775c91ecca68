#include "encoder/field/field_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "base/error.h"
#include "base/h5.h"
#include "tests/field/random_field.h"
#include "tests/support/damage.h"
#include "tests/support/temporary_folder.h"

namespace cleft {

namespace {

bool same(const Field& a, const Field& b) {
  for (int axis = 0; axis < 4; ++axis)
    if (a.basis(axis).knots() != b.basis(axis).knots() || a.basis(axis).degree() != b.basis(axis).degree())
      return false;
  return a.coefficients() == b.coefficients() && a.parameters == b.parameters && a.case_hash == b.case_hash &&
         a.cut().start == b.cut().start && a.cut().length == b.cut().length &&
         a.cut().depth == b.cut().depth && a.report.node_error == b.report.node_error;
}

}  // namespace

TEST(FieldFile, ReadsBackWhatWasWritten) {
  const TemporaryFolder folder;
  write_field(folder / "a.dffd", random_field());
  EXPECT_TRUE(same(read_field(folder / "a.dffd"), random_field()));
  EXPECT_EQ(folder.entries(), 1);
}

TEST(FieldFile, DamageIsNoticed) {
  const TemporaryFolder folder;
  write_field(folder / "a.dffd", random_field());
  const Field sound = random_field();
  std::optional<Field> found;
  EXPECT_EQ(unnoticed_damages(
                folder / "a.dffd", 700, [&](const std::string& file) { found = read_field(file); },
                [&] { return same(*found, sound); }),
            0);
}

TEST(FieldFile, WhatTheFormatDoesNotAllowIsNamed) {
  const auto refuse = [](const Field& field, const std::string& attribute, const std::string& part) {
    const TemporaryFolder folder;
    write_field(folder / "a.dffd", field);
    // Another value of one root attribute, or of none: written again under the same name in a copy.
    h5::File copy = h5::File::create(folder / "b.dffd");
    const h5::File source = h5::File::open(folder / "a.dffd");
    for (const std::string name : {"format", "units", "case", "parametrization"})
      copy.write_text("/", name, name == attribute ? "other" : source.read_text("/", name));
    copy.write_number("/", "version", attribute == "version" ? 2 : 1);
    copy.create_group("/basis");
    h5::Shape shape;
    for (const std::string name : {"/basis/u", "/basis/v", "/basis/w", "/basis/t"}) {
      const auto knots = source.read<double>(name);
      copy.write<double>(name, knots, {knots.size()});
      copy.write_number(name, "degree", 3);
    }
    const auto points = source.read<float>("/control_points");
    copy.write<float>("/control_points", points, source.shape("/control_points"));
    copy.close();
    try {
      read_field(folder / "b.dffd");
      ADD_FAILURE() << "accepted: " << part;
    } catch (const FileError& e) {
      EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
    }
  };
  const Field field = random_field();
  refuse(field, "format", "is not a field file");
  refuse(field, "version", "version 2");
  refuse(field, "parametrization", "parametrization 'other'");
  std::vector<Vec3> coefficients = field.coefficients();
  coefficients[5].y = std::nan("");
  refuse(Field(field.basis(0), field.basis(1), field.basis(2), field.basis(3), coefficients, field.cut()), "",
         "not a finite number");
  const BSplineBasis unbroken = BSplineBasis::uniform(3, field.basis(1).size(), -20, 20);
  refuse(Field(field.basis(0), unbroken, field.basis(2), field.basis(3), field.coefficients(), field.cut()),
         "", "full multiplicity");
}

TEST(FieldFile, OtherFilesAreRefused) {
  const TemporaryFolder folder;
  EXPECT_THROW(read_field(folder / "absent.dffd"), FileError);
  EXPECT_THROW(read_field(folder.write("text.dffd", "hello")), FileError);
  EXPECT_THROW(read_field(folder.path()), FileError);
}

}  // namespace cleft
