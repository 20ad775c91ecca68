// Every case once, and none beside one of another stiffness.
#include "params/run/solve_groups.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "params/run/estimates.h"
#include "params/stiffness.h"

namespace cleft {

namespace {

std::vector<Case> cases_of(int moduli, int prestresses) {
  std::vector<Case> cases;
  for (int p = 0; p < prestresses; ++p)
    for (int m = 0; m < moduli; ++m) {
      cases.emplace_back();
      cases.back().parameters.tissue.young_modulus = 0.01 * (m + 1);
      cases.back().parameters.skin.prestress.vv = 0.001 * (p + 1);
    }
  return cases;
}

}  // namespace

TEST(SolveGroups, HoldEveryCaseOnceWithOthersOfItsStiffness) {
  for (const int moduli : {1, 2, 5})
    for (const int prestresses : {1, 3, 70})
      for (const int workers : {1, 2, 7}) {
        const std::vector<Case> cases = cases_of(moduli, prestresses);
        const auto groups = solve_groups(cases, workers);
        std::vector<std::size_t> all;
        for (const auto& group : groups) {
          ASSERT_FALSE(group.empty());
          EXPECT_LE(group.size(), most_solved_together);
          for (const std::size_t c : group) {
            EXPECT_EQ(stiffness_key(cases[c].parameters), stiffness_key(cases[group[0]].parameters));
            all.push_back(c);
          }
        }
        std::sort(all.begin(), all.end());
        ASSERT_EQ(all.size(), cases.size());
        for (std::size_t c = 0; c < all.size(); ++c) EXPECT_EQ(all[c], c);
        EXPECT_GE(groups.size(), std::min<std::size_t>(cases.size(), workers)) << "somebody would be idle";
      }
  EXPECT_TRUE(solve_groups({}, 3).empty());
}

/// A process takes longer to start than a small case to be solved.
TEST(SolveGroups, ThousandSmallCasesOfOneStiffnessStartFewProcesses) {
  std::vector<Case> cases = cases_of(1, 1000);
  EXPECT_GE(solve_groups(cases, 2).size(), 1000 / most_solved_together) << "what is lost with one is bounded";
  for (Case& one : cases) one.parameters.mesh.element_size = 3;
  ASSERT_TRUE(is_small(cases.front()));
  EXPECT_EQ(solve_groups(cases, 2).size(), 8U);
}

/// Of 90 small cases of 30 stiffness matrices: each once, in few groups, but enough for every worker; those
/// of one matrix are still together.
TEST(SolveGroups, SmallCasesOfSeveralStiffnessesAreTogether) {
  std::vector<Case> cases = cases_of(30, 3);
  for (Case& one : cases) {
    one.parameters.patch.length = 30, one.parameters.patch.width = 24, one.parameters.patch.height = 8;
    one.parameters.cut.length = 12, one.parameters.cut.depth = 4;
    one.parameters.mesh.element_size = 2;
  }
  cases.back().parameters.model = Model::finite;
  for (const int workers : {1, 2, 7}) {
    const auto groups = solve_groups(cases, workers);
    EXPECT_LE(groups.size(), workers == 7 ? 31U : 18U);
    EXPECT_GE(groups.size(), workers > 1 ? 4U * workers : 2U);
    EXPECT_TRUE(workers > 1 || groups.size() == 2U) << "all small ones, and the other one";
    std::vector<int> seen(cases.size(), 0);
    for (const auto& group : groups) {
      EXPECT_LE(group.size(), most_small_together);
      for (const std::size_t c : group) {
        ++seen[c];
        EXPECT_TRUE(cases[c].parameters.model == Model::small || group.size() == 1);
      }
    }
    EXPECT_EQ(seen, std::vector<int>(cases.size(), 1));
  }
}

/// Two measured cases in which everything is in proportion to the work say the same of a third.
TEST(Estimates, AreThoseOfMeasuredCases) {
  Estimates estimates;
  EXPECT_FALSE(estimates.seconds({1000, 10}).has_value());
  const double unmeasured = estimates.solver_memory({1000, 10});
  EXPECT_GT(unmeasured, 1e8);
  IndexedCase one;
  one.nodes = 1000, one.columns = 10, one.seconds = 4, one.bytes = 1e6, one.memory = 3 * unmeasured;
  estimates.add(one);
  EXPECT_DOUBLE_EQ(estimates.seconds({1000, 10}).value(), 4);
  EXPECT_DOUBLE_EQ(estimates.bytes({2000, 10}).value(), 2e6);
  EXPECT_GT(estimates.seconds({2000, 10}).value(), 8);
  EXPECT_DOUBLE_EQ(estimates.solver_memory({1000, 10}), 3 * unmeasured);
  estimates.add(one);
  EXPECT_DOUBLE_EQ(estimates.seconds({1000, 10}).value(), 4);
}

}  // namespace cleft
