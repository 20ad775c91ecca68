#include "explorer/analysis/figure.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "explorer/study/case_figures.h"
#include "tests/interpolate/made_study.h"

namespace cleft {

TEST(Figure, IsThatOfTheField) {
  const Field field = made_field({});
  EXPECT_NEAR(Figure("gape").of(field), case_figures(field).gape, 2e-3 * case_figures(field).gape);
  EXPECT_DOUBLE_EQ(Figure("gape(3)").of(field), gape(field, 3, 24));
  EXPECT_DOUBLE_EQ(Figure("gape( 3 , 18 )").of(field), gape(field, 3, 18));
  const Vec3 moved = field.displacement({2, -5, -1}, Side::left, 20);
  EXPECT_DOUBLE_EQ(Figure("displacement(2, -5, -1, 20)").of(field), norm(moved));
  EXPECT_DOUBLE_EQ(Figure("v(2, -5, -1, 20)").of(field), moved.y);
  EXPECT_DOUBLE_EQ(Figure("w(2, 0, 0)").of(field), field.displacement({2, 0, 0}, Side::right, 24).z);
  EXPECT_GE(Figure("displacement").of(field), norm(field.displacement({0, 0, 0}, Side::right, 24)));
}

TEST(Figure, RefusesWhatItDoesNotKnow) {
  for (const char* text :
       {"", "gap", "gape(", "gape(1,2,3)", "gape(x)", "u", "u(1,2)", "displacement(1,2)", "gape()"})
    EXPECT_THROW(Figure{text}, InputError) << text;
}

}  // namespace cleft
