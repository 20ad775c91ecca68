// The table's rows against the members of Parameters.
#include "params/parameters/table.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace cleft {

TEST(ParameterTable, EveryRowWritesTheMemberItReads) {
  const Parameters defaults;
  for (const Parameter& row : parameter_table()) {
    SCOPED_TRACE(row.name);
    const Value old = get_parameter(defaults, row);
    std::vector<Value> values(row.choices.begin(), row.choices.end());
    if (!row.is_text())
      values = {row.whole ? 2. : row.greatest > 1 ? 1.25 : std::min(0.25, row.greatest / 2)};
    for (const Value& value : values) {
      Parameters p;
      set_parameter(p, row.name, value, "here");
      EXPECT_EQ(get_parameter(p, row), value);
      for (const Parameter& other : parameter_table())
        if (&other != &row) {
          EXPECT_EQ(get_parameter(p, other), get_parameter(defaults, other)) << other.name;
        }
      EXPECT_EQ(&row_at(p, row.address(p)), &row);
    }
    EXPECT_EQ(get_parameter(defaults, row), old);
  }
}

TEST(ParameterTable, MembersHaveTheNamesOfFiles) {
  Parameters p;
  EXPECT_EQ(row_of(p, p.skin.prestress.uv).name, "skin.prestress_uv");
  EXPECT_EQ(row_of(p, p.cut.branch).name, "cut.branch");
  EXPECT_EQ(text_of(p, p.cut.contact), "false");
  p.cut.contact = true, p.cut.frames = FrameEvery::pair;
  p.tissue.formulation = TissueFormulation::mean_dilatation;
  EXPECT_EQ(text_of(p, p.cut.contact), "true");
  EXPECT_EQ(text_of(p, p.cut.frames), "pair");
  EXPECT_EQ(text_of(p, p.tissue.formulation), "mean-dilatation");
}

}  // namespace cleft
