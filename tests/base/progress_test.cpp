// What a line of progress tells besides its state.
#include <gtest/gtest.h>

#include "base/command/command.h"

namespace cleft {

TEST(Progress, TellsThePartThatIsDoneAndTheTimeThatIsLeft) {
  EXPECT_EQ(part_and_time_left(1, 1, 10, 0), "0 %") << "the first of ten has only begun";
  EXPECT_EQ(part_and_time_left(1, 6, 10, 4.9), "50 %") << "too early for a pace";
  EXPECT_EQ(part_and_time_left(1, 6, 10, 10), "50 % (about 10 s left)") << "five in 10 s, five are left";
  EXPECT_EQ(part_and_time_left(1, 3, 62, 40), "3 % (about 20 min left)") << "20 s each, 60 are left";
  EXPECT_EQ(part_and_time_left(1, 1 + 0.25, 1, 20), "25 % (about 60 s left)") << "a quarter of the whole";
  EXPECT_EQ(part_and_time_left(4, 4, 8, 100), "37 %") << "nothing was done since the step began";
}

}  // namespace cleft
