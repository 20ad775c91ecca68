// What a session shows between the cases of its study.
#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "encoder/interpolate/study_interpolator.h"
#include "explorer/study/case_figures.h"
#include "tests/session/session_fixture.h"
#include "tests/support/recorded.h"

namespace cleft {
namespace {

/// Six cases whose displacements are proportional to the prestress over a power of the tissue's modulus, as
/// prestresses superpose and stiffnesses scale: what lies between them is known.
class Between : public SessionTest {
 protected:
  static double gape_of(double prestress, double modulus) {
    return 100 * prestress * std::pow(modulus / 0.02, -0.5);
  }
  static const std::string& scaled_study() {
    static const TemporaryFolder folder;
    static const std::string study = [] {
      int number = 0;
      for (const double prestress : {0.02, 0.04})
        for (const double modulus : {0.01, 0.02, 0.04}) {
          const std::string name = "case" + std::to_string(number++);
          const std::string place = folder / ("study/cases/" + name);
          std::filesystem::create_directories(place);
          Field field = synthetic_field(gape_of(prestress, modulus));
          field.parameters = recorded({{"skin.prestress_v", prestress},
                                       {"skin.prestress_u", 0},
                                       {"skin.prestress_uv", 0},
                                       {"tissue.young_modulus", modulus},
                                       {"cut.depth", 6},
                                       {"cut.length", 30},
                                       {"patch.length", 60},
                                       {"patch.width", 40},
                                       {"patch.height", 12},
                                       {"skin.thickness", 1.5},
                                       {"skin.young_modulus", 0.5},
                                       {"skin.poisson_ratio", 0.4},
                                       {"tissue.poisson_ratio", 0.45},
                                       {"foundation.stiffness", 0.005},
                                       {"foundation.side_stiffness", 0.005},
                                       {"mesh.element_size", 2}});
          field.case_hash = name;
          field.report.largest_displacement = gape_of(prestress, modulus) / 2;
          write_field(place + "/case.dffd", field);
          write_text_file(place + "/manifest.json", "{}");
        }
      return folder / "study";
    }();
    return study;
  }
  void open_scaled() { say("open " + scaled_study()); }
  double shown_gape() { return widest_gape(*session_.field(), session_.duration()); }
  double gape_of_case(int i) { return session_.figures(i).gape; }
};

TEST_F(Between, TheFieldIsInterpolatedAndMarkedAsSuch) {
  open_scaled();
  EXPECT_FALSE(session_.between());
  const double whole = gape_of_case(0) / gape_of(0.02, 0.01);  // of the synthetic field's shape
  for (const auto& [prestress, modulus] :
       {std::pair{0.03, 0.02}, {0.025, 0.01}, {0.035, 0.03}, {0.022, 0.037}}) {
    say("set skin.prestress_v " + shortest(prestress));
    say("set tissue.young_modulus " + shortest(modulus));
    ASSERT_TRUE(session_.between()) << session_.why_nearest();
    const double expected = whole * gape_of(prestress, modulus);
    // Prestresses superpose; over the modulus it is at least as good as a line in its logarithm, which over a
    // factor of two is off by (ln 2 / 2)^2 / 8.
    const bool superposed = modulus == 0.01 || modulus == 0.02;
    EXPECT_NEAR(shown_gape(), expected, (superposed ? 1e-4 : 0.015) * expected)
        << prestress << " " << modulus;
    EXPECT_NE(session_.note_of(state().shown).find("interpolated, estimated error"), std::string::npos);
    EXPECT_EQ(session_.between()->parameters.number("tissue.young_modulus"), modulus);
  }
  say("case 2");
  EXPECT_FALSE(session_.between());
  EXPECT_NEAR(shown_gape(), gape_of_case(1), 1e-12);
}

TEST_F(Between, ThePictureIsThatOfTheInterpolatedField) {
  open_scaled();
  say("set skin.prestress_v 0.03");
  const std::vector<Vec3> between = points();
  say("set skin.prestress_v 0.02");
  const std::vector<Vec3> less = points();
  say("set skin.prestress_v 0.04");
  const std::vector<Vec3> more = points();
  double worst = 0;
  for (std::size_t i = 0; i < between.size(); ++i)
    worst = std::max(worst, norm(between[i] - 0.5 * (less[i] + more[i])));
  EXPECT_LT(worst, 0.01) << "prestresses superpose";
}

TEST_F(Between, TheNearestCaseIsShownWithAWordWhy) {
  open_scaled();
  say("set skin.prestress_v 0.06");
  EXPECT_FALSE(session_.between());
  EXPECT_NE(session_.why_nearest().find("skin.prestress_v is outside the study, 0.02 to 0.04"),
            std::string::npos)
      << session_.why_nearest();
  say("set skin.prestress_v 0.033");
  EXPECT_TRUE(session_.between());
  EXPECT_EQ(session_.why_nearest(), "");
  say("between off");
  EXPECT_FALSE(session_.between());
  EXPECT_EQ(session_.why_nearest(), "interpolation is off");
  EXPECT_NEAR(shown_gape(), gape_of_case(state().shown), 1e-12);
  say("between on");
  say("compare 1 2");
  EXPECT_FALSE(session_.between()) << "cases are compared as they are";
  say("single");
  EXPECT_TRUE(session_.between());
}

TEST_F(Between, AWoundInAMeshFollowsTheSliders) {
  open_scaled();
  say("mesh plate.stl");
  say("cut -15,0.7,0,0,0,1 15,0.7,0,0,0,1");
  const std::vector<Vec3> narrow = points();
  say("set skin.prestress_v 0.03");
  ASSERT_TRUE(session_.between()) << session_.why_nearest();
  const std::vector<Vec3> wider = points();
  say("set skin.prestress_v 0.04");
  const std::vector<Vec3> widest = points();
  double first = 0, second = 0;
  for (std::size_t i = 0; i < narrow.size(); ++i) {
    first = std::max(first, norm(wider[i] - narrow[i]));
    second = std::max(second, norm(widest[i] - narrow[i]));
  }
  EXPECT_GT(first, 0.1);
  EXPECT_NEAR(first, second / 2, 0.02 * second);
}

TEST_F(Between, ARefusedLineAndASavedStateKeepIt) {
  open_scaled();
  say("set skin.prestress_v 0.03");
  const auto between = session_.between();
  EXPECT_NE(refused("mesh gone.stl"), "");
  EXPECT_EQ(session_.between(), between);
  const std::vector<Vec3> shown = points();
  say("save " + folder_ / "state.json");
  say("case 6");
  say("load " + folder_ / "state.json");
  ASSERT_TRUE(session_.between());
  EXPECT_EQ(points(), shown);
}

TEST_F(Between, CasesAreReadBesideWhereThatIsWished) {
  session_.prepare_beside(true);
  open_scaled();
  int told = 0;
  session_.listen([&](const Changes& changes) { told += changes.shown; });
  say("set skin.prestress_v 0.03");
  EXPECT_EQ(told, 1);
  EXPECT_FALSE(session_.between());
  EXPECT_TRUE(session_.preparing());
  EXPECT_EQ(session_.why_nearest(), "the cases are being read");
  while (session_.take_prepared()) {
  }
  EXPECT_EQ(told, 2) << "listeners hear of it";
  EXPECT_TRUE(session_.between()) << session_.why_nearest();
  say("close");
  open_scaled();
  say("set skin.prestress_v 0.03");
  say("screenshot a.png");
  EXPECT_TRUE(session_.between()) << "a picture waits";
}

TEST_F(Between, ClosingEndsTheReadingOfCases) {
  session_.prepare_beside(true);
  open_scaled();
  say("set skin.prestress_v 0.03");
  ASSERT_TRUE(session_.preparing());
  say("close");
  ASSERT_FALSE(session_.preparing());
  EXPECT_EQ(session_.prepared_part(), 1);
  EXPECT_FALSE(session_.take_prepared());
  EXPECT_EQ(session_.why_nearest(), "");
  open_scaled();
  EXPECT_FALSE(session_.preparing());
  EXPECT_NE(refused("open /nonexistent"), "");
  say("set skin.prestress_v 0.03");
  EXPECT_NE(refused("open /nonexistent"), "");
  EXPECT_TRUE(session_.preparing()) << "a refused line does not end it";
}

TEST_F(Between, ReadingTellsItsPartAndEndsWhereItIsNotWanted) {
  open_scaled();
  std::vector<double> parts;
  const StudyInterpolator whole(session_.study()->path(), [&](double part) { parts.push_back(part); });
  ASSERT_GT(parts.size(), static_cast<std::size_t>(session_.study()->size()));
  EXPECT_TRUE(std::is_sorted(parts.begin(), parts.end()));
  EXPECT_EQ(parts.front(), 0);
  EXPECT_LT(parts.back(), 1);
  int calls = 0;
  EXPECT_THROW(StudyInterpolator(session_.study()->path(),
                                 [&](double) {
                                   if (++calls == 2) throw std::runtime_error("enough");
                                 }),
               std::runtime_error);
  EXPECT_EQ(calls, 2) << "it goes no further";
}

}  // namespace
}  // namespace cleft
