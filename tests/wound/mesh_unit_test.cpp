// The unit of a mesh, guessed from its size.
#include "explorer/wound/mesh_unit.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "tests/support/flat_plate.h"

namespace cleft {
namespace {

TEST(MeshUnit, AHeadInAnyUnitIsRecognised) {
  constexpr double head = 246, cut = 34;  // mm
  for (const LengthUnit& unit : length_units()) {
    if (unit.name == "in") continue;  // no guess: it is near to cm
    EXPECT_EQ(guessed_unit(head / unit.mm, cut), unit.mm) << unit.name;
    EXPECT_EQ(doubt_of_size(head / unit.mm, unit.mm, cut), "") << unit.name;
    if (unit.mm > 1) {
      EXPECT_NE(doubt_of_size(head / unit.mm, 1, cut).find("in " + unit.name + " it would be 246 mm"),
                std::string::npos)
          << unit.name;
    }
  }
  EXPECT_EQ(extent_of(flat_plate()), 60);
}

TEST(MeshUnit, AbsurdSizesAreRefused) {
  EXPECT_THROW(doubt_of_size(246, 1e9, 34), InputError);
  EXPECT_NE(doubt_of_size(246, 100, 34).find("give 1 mm a unit"), std::string::npos) << "24.6 m";
  EXPECT_EQ(mm_of_unit("dm"), 100);
  EXPECT_EQ(mm_of_unit("45"), 45);
  EXPECT_EQ(name_of_unit(25.4), "in");
  EXPECT_EQ(name_of_unit(45), "45 mm");
  for (const char* wrong : {"parsec", "0", "-3", "1e9", "nan"})
    EXPECT_THROW(mm_of_unit(wrong), InputError) << wrong;
}

}  // namespace
}  // namespace cleft
