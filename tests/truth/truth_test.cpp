// Replayed cuts against the solver's own simulations of them, within what is promised: a tenth of the
// opening.
#include <gtest/gtest.h>

#include "tests/truth/replay_error.h"
#include "tests/truth/truth_cases.h"

namespace cleft {

namespace {

constexpr double promised = 0.1;  // of the largest opening

constexpr const char* coarse = R"(
patch.length = 46
patch.width = 30
patch.height = 6
mesh.element_size = 1.5
)";
/// Pulled alike in all directions: a curved cut is then pulled as the canonical one.
constexpr const char* alike = R"(
skin.prestress_u = 0.02
skin.prestress_v = 0.02
)";

class Truth : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    cases = new TruthCases(std::string(coarse) + alike);
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

TEST(TruthInTension, TurnsAgainstACurvedCut) {
  const TruthCases cases(coarse);  // 1 : 3
  const PrestressFields fields = cases.prestresses();
  const SnapshotReader truth = cases.truth("cut.radius = 30");
  const ReplayError e = replay_error(truth, fields);
  EXPECT_GT(e.gape, 1);
  EXPECT_LT(e.gape_error, promised * e.gape) << "0.24 where the tension does not turn";
}

TEST(TruthOfTwoCuts, RelieveEachOther) {
  // So wide that both cuts are as far from its sides as the canonical one.
  const TruthCases cases(
      std::string(coarse).replace(std::string(coarse).find("width = 30"), 10, "width = 60") +
      "mesh.grading = 1.2\ncut.length = 20");
  const Field field = cases.canonical();
  for (const char* spacing : {"10", "12", "16"}) {
    const SnapshotReader truth = cases.truth("cut.count = 2\ncut.spacing = " + std::string(spacing));
    const ReplayError e = parallel_error(truth, field);
    EXPECT_GT(e.gape, 1);
    EXPECT_LT(e.gape_error, promised * e.gape) << spacing << " mm apart: 0.18 to 0.29 where they do not";
  }
}

}  // namespace cleft
