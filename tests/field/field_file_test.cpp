#include "encoder/field/field_file.h"

#include <gtest/gtest.h>

#include <optional>

#include "base/error.h"
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

TEST(FieldFile, OtherFilesAreRefused) {
  const TemporaryFolder folder;
  EXPECT_THROW(read_field(folder / "absent.dffd"), FileError);
  EXPECT_THROW(read_field(folder.write("text.dffd", "hello")), FileError);
  EXPECT_THROW(read_field(folder.path()), FileError);
}

}  // namespace cleft
