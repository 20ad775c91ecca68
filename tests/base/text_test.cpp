#include "base/text.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "base/memory.h"
#include "tests/support/temporary_folder.h"

namespace cleft {

TEST(Text, ShortestNumberReadsBackTheSame) {
  for (const double value : {0.1, 1.0 / 3, 1e-300, 6.02214076e23, -0.0, 123456789.0})
    EXPECT_EQ(parse_number(shortest(value), "here"), value);
}

TEST(Text, NearestNameIsSuggestedOnlyWhereItIsNear) {
  const std::vector<std::string> names = {"tissue.young_modulus", "skin.young_modulus", "patch.length"};
  EXPECT_EQ(nearest_name("tisue.young_modulus", names), "tissue.young_modulus");
  EXPECT_EQ(nearest_name("length", names), "patch.length");
  EXPECT_EQ(nearest_name("q", names), "");
}

TEST(Text, NumbersThatAreNoneAreRefused) {
  for (const char* text : {"", "x", "1x", "1e", "nan", "inf"})
    EXPECT_THROW(parse_number(text, "here"), InputError) << text;
}

TEST(Csv, ReadsColumnsAndSkipsComments) {
  const TemporaryFolder folder;
  const NumberTable table = read_csv(folder.write("a.csv", "\xEF\xBB\xBFx, y\n# note\n1,2\n\n3 , -4e1\r\n"));
  EXPECT_EQ(table.columns, (std::vector<std::string>{"x", "y"}));
  EXPECT_EQ(table.rows, (std::vector<std::vector<double>>{{1, 2}, {3, -40}}));
  EXPECT_EQ(table.column("y"), 1);
  EXPECT_EQ(table.column("z"), -1);
}

TEST(Csv, NamesThePlaceOfAMistake) {
  const TemporaryFolder folder;
  try {
    read_csv(folder.write("a.csv", "x,y\n1,2\n3,four\n"));
    FAIL() << "'four' was taken for a number";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("line 3, column 'y': 'four'"), std::string::npos) << e.what();
  }
  EXPECT_THROW(read_csv(folder.write("b.csv", "x,y\n1\n")), InputError);
  EXPECT_THROW(read_csv(folder.write("c.csv", "")), InputError);
  EXPECT_THROW(read_csv(folder / "absent.csv"), InputError);
  EXPECT_THROW(read_csv(folder.path()), InputError);
}

TEST(TextFile, AnEmptyFileIsAnEmptyText) {
  const TemporaryFolder folder;
  EXPECT_EQ(read_text_file(folder.write("empty", "")), "");
}

TEST(Memory, IsGivenInGigabytesOrWithItsUnit) {
  for (const auto& [text, bytes] : {std::pair("4", 4e9), std::pair("4 GB", 4e9), std::pair("500MB", 5e8)})
    EXPECT_EQ(parse_memory(text, "--memory"), bytes) << text;
  for (const char* text : {"", "GB", "4kB", "0", "-1GB", "0.5MB", "nan", "much"})
    EXPECT_THROW(parse_memory(text, "--memory"), InputError) << text;
}

}  // namespace cleft
