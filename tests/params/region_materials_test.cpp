// The file of a body's materials.
#include "params/region_materials.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "tests/support/temporary_folder.h"

namespace cleft {

namespace {

std::string materials_refusal(const std::string& text) {
  const TemporaryFolder folder;
  try {
    read_region_file(folder.write("m.toml", text));
  } catch (const InputError& e) {
    return e.what();
  }
  return "nothing was refused";
}

}  // namespace

TEST(RegionMaterials, SectionsKeepTheOrderOfTheFile) {
  const TemporaryFolder folder;
  const RegionFile file = read_region_file(folder.write("m.toml",
                                                        "[muscle]\nregion = [4, 2]\nyoung_modulus = 0.04\n"
                                                        "[fat]\nto_depth = 3\npoisson_ratio = 0\n"
                                                        "[faces]\nskin = 7\nfree = [8, 9]\n"));
  ASSERT_EQ(file.sections.size(), 2U);
  EXPECT_EQ(file.sections[0].material, (RegionMaterial{"muscle", 0.04, {}}));
  EXPECT_EQ(file.sections[0].regions, (std::vector{4, 2}));
  EXPECT_EQ(file.sections[1].material, (RegionMaterial{"fat", {}, 0.}));
  EXPECT_EQ(file.sections[1].to_depth, 3);
  EXPECT_EQ(file.faces->skin, (std::vector{7}));
  EXPECT_EQ(file.faces->free, (std::vector{8, 9}));
}

TEST(RegionMaterials, MistakesAreToldWithTheirLines) {
  for (const auto& [text, part] : {std::pair{"[fat]\nyoung_modulus = -1\n", "line 2: young_modulus = -1"},
                                   {"[fat]\npoisson_ratio = 0.5\n", "from 0 to 0.4999"},
                                   {"[fat]\n\nregion = 1.5\n", "line 3: region: must be a whole number"},
                                   {"[fat]\nyoungs_modulus = 1\n", "did you mean 'young_modulus'"},
                                   {"[faces]\nbones = 1\n[fat]\n", "did you mean 'bone'"},
                                   {"[faces]\nskin = 1\n", "has no section"},
                                   {"fat = 1\n", "'fat' must be a section [fat]"},
                                   {"[fat\n", "line 1"}})
    EXPECT_PRED_FORMAT2(testing::IsSubstring, part, materials_refusal(text));
}

}  // namespace cleft
