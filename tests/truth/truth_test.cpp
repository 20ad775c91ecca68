// Replayed cuts against the solver's own simulations of them, within what is promised: a tenth of the
// opening.
#include <gtest/gtest.h>

#include "tests/truth/replay_error.h"
#include "tests/truth/truth_cases.h"

namespace cleft {

namespace {

constexpr double promised = 0.1;  // of the largest opening

/// A coarse patch, pulled alike in all directions: a curved cut is then pulled as the canonical one.
constexpr const char* coarse = R"(
patch.length = 46
patch.width = 30
patch.height = 6
mesh.element_size = 1.5
skin.prestress_u = 0.02
skin.prestress_v = 0.02
)";

class Truth : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    cases = new TruthCases(coarse);
    field = new Field(cases->canonical());
  }
  static void TearDownTestSuite() {
    delete field;
    delete cases;
  }
  static ReplayError error(const std::string& lines) {
    const SnapshotReader truth = cases->truth(lines);
    const ReplayError e = replay_error(truth, *field);
    EXPECT_GT(e.gape, 1) << "the cut must open for this to mean anything";
    return e;
  }
  static TruthCases* cases;
  static Field* field;
};
TruthCases* Truth::cases = nullptr;
Field* Truth::field = nullptr;

}  // namespace

TEST_F(Truth, TheCanonicalCutIsItself) {
  const ReplayError e = error("");
  // On either lip; replaying contracts the field to histories, which may add a tenth.
  EXPECT_LT(e.gape_error, 2 * 1.1 * field->report.spline_error * field->report.largest_displacement);
}

TEST_F(Truth, ACurvedCutOpensAsMuch) {
  const ReplayError e = error("cut.radius = 40");
  EXPECT_LT(e.gape_error, promised * e.gape);
}

TEST_F(Truth, ATiltedBladesLipsRiseAndSink) {
  for (const char* tilt : {"-30", "15", "30"}) {
    const ReplayError e = error(std::string("cut.tilt = ") + tilt);
    EXPECT_LT(e.gape_error, promised * e.gape) << tilt << ": 0.18 and more in the blade's own frame";
  }
}

TEST_F(Truth, AShorterCutIsAnEarlierTime) {
  const ReplayError e = error("cut.length = 15");
  EXPECT_LT(e.gape_error, promised * e.gape);
}

}  // namespace cleft
