// What a session says beside the picture is of what is drawn.
#include "base/text.h"
#include "explorer/study/case_figures.h"
#include "explorer/study/find.h"
#include "tests/session/raw_study.h"
#include "tests/session/session_fixture.h"

namespace cleft {
namespace {

/// Fields whose residual makes the nodes far better than the spline; parameters as Sobol sampling draws them.
class Shown : public SessionTest {
 protected:
  Shown() {
    for (const double modulus : {0.0123456789012, 0.0345678901234}) {
      const std::string name = "case" + shortest(modulus), place = folder_ / ("study/cases/" + name);
      std::filesystem::create_directories(place);
      Field field = synthetic_field(3);
      field.parameters = recorded({{"skin.prestress_v", 2 * modulus},
                                   {"skin.young_modulus", 10 * modulus},
                                   {"tissue.young_modulus", modulus},
                                   {"cut.depth", 6}});
      field.case_hash = name;
      field.report.node_error = 0.009, field.report.spline_error = 0.041;
      field.report.gape_error = 0.03, field.report.largest_displacement = 2;
      write_field(place + "/case.dffd", field);
      write_text_file(place + "/manifest.json", "{}");
    }
  }
  std::string sampled() const { return folder_ / "study"; }
};

TEST_F(Shown, TheErrorIsThatOfTheSplineThatIsDrawn) {
  say("open " + sampled());
  EXPECT_EQ(session_.figures(0).error, 0.041);
  EXPECT_NEAR(session_.column_value(0, "error"), 4.1, 1e-9);
  EXPECT_NEAR(*error_of_displacement(*session_.field()), 0.082, 1e-12);
  EXPECT_NEAR(*error_of_gape(*session_.field()), 0.06, 1e-12);
  say("info");
  EXPECT_NE(answers_.find("error of what is drawn: 4.1 % of the largest displacement, 2 mm"),
            std::string::npos)
      << answers_;
  EXPECT_NE(answers_.find("mm, off by at most 0.06 mm"), std::string::npos) << answers_;
  EXPECT_TRUE(Condition("error > 4").find(*session_.field()));
  EXPECT_FALSE(Condition("error > 4.2").find(*session_.field()));
}

TEST_F(Shown, TitlesRoundToWhatMatters) {
  say("open " + sampled());
  EXPECT_EQ(session_.title_of(0),
            "case 1: skin.prestress_v=0.02469 skin.young_modulus=0.1235 tissue.young_modulus=0.01235");
}

TEST_F(Shown, WhatLiesOutsideTheStudyIsAGuessAndIsSaidToBe) {
  say("open " + sampled());
  EXPECT_FALSE(session_.is_guess(0));
  EXPECT_EQ(session_.note_of(0), "");
  say("between off");
  say("set tissue.young_modulus 0.02");
  EXPECT_FALSE(session_.is_guess(state().shown)) << "a case of the study is shown";
  say("set tissue.young_modulus 0.05");
  EXPECT_TRUE(session_.is_guess(state().shown));
  EXPECT_FALSE(session_.is_guess(1 - state().shown)) << "beside it";
  say("between on");
  EXPECT_TRUE(session_.is_guess(state().shown));
  EXPECT_NE(session_.note_of(state().shown).find("tissue.young_modulus is outside the study"),
            std::string::npos);
}

TEST_F(Shown, AnOpeningWithALargeExpectedErrorIsAGuess) {
  cut_plate();
  EXPECT_FALSE(session_.is_guess(0));
  std::string arc = "recut";
  for (int i = -8; i <= 8; ++i) {
    const double a = 0.2 * i;
    arc +=
        " " + std::to_string(7 * std::sin(a)) + "," + std::to_string(7 * (1 - std::cos(a)) - 7) + ",0,0,0,1";
  }
  say(arc);
  EXPECT_GT(session_.validity().front().expected_error.largest, Session::greatest_known_error);
  EXPECT_TRUE(session_.is_guess(0));
}

TEST_F(Shown, WhatIsFoundIsGoneTo) {
  open();
  EXPECT_NE(refused("found 1").find("say: find CONDITION"), std::string::npos);
  say("find gape > 5 and t < 20");
  EXPECT_NE(refused("found 1").find("holds nowhere in case 1"), std::string::npos);
  say("found 4");
  EXPECT_EQ(state().shown, 3);
  EXPECT_EQ(state().time, session_.finding(3)->best_t);
  EXPECT_LT(state().time, 20);
  say("filter on");
  EXPECT_TRUE(state_from_json(state_to_json(state())).filtered);
  EXPECT_NE(refused("filter maybe").find("neither on nor off"), std::string::npos);
}

TEST_F(Shown, CameraWordsCountFromTheCutAtWhichTheyWereSaid) {
  cut_plate();
  say("camera 30 20");
  ASSERT_TRUE(state().camera.frame);
  const Vec3 middle = state().camera.frame->middle;
  EXPECT_LT(norm(middle - Vec3{0, 0.7, 0}), 0.1);
  say("recut -15,5,0,0,0,1 0,5,0,0,0,1 15,5,0,0,0,1");
  EXPECT_EQ(norm(state().camera.frame->middle - middle), 0);
  const SessionState again = state_from_json(state_to_json(state()));
  ASSERT_TRUE(again.camera.frame);
  EXPECT_EQ(norm(again.camera.frame->middle - middle), 0);
  say("camera 30 20");
  EXPECT_GT(norm(state().camera.frame->middle - middle), 4) << "said anew";
}

TEST_F(Shown, CutsTurnWithTheTensionOfTheShownCaseByThemselves) {
  write_study_of_prestresses(folder_ / "three");
  say("open " + (folder_ / "three"));
  say("set skin.prestress_v 0.03");
  say("mesh plate.stl");
  const std::string along = "cut -15,0.7,0,0,0,1 0,0.7,0,0,0,1 15,0.7,0,0,0,1";
  const std::string across = "cut 0.7,-14,0,0,0,1 0.7,0,0,0,0,1 0.7,14,0,0,0,1";
  say(along);
  const double first = session_.scene()->wound_figures(session_.duration())[0].widest;
  EXPECT_NEAR(first, widest_gape(*session_.field(), 30), 0.05 * first) << "as the case was simulated";
  EXPECT_FALSE(state().tension) << "nothing has been said";
  ASSERT_TRUE(session_.cut_fields(state().shown)->turning());
  say("undo");
  // The same tension, said: along x .01, along y .03 MPa. A cut across is then opened by the .01.
  say("tension 0,1,0 0.03,0.01");
  say(along);
  say(across);
  const std::vector<Vec3> said = points();
  say("tension none");
  const std::vector<Vec3> by_itself = points();
  for (std::size_t i = 0; i < said.size(); ++i) ASSERT_LT(norm(said[i] - by_itself[i]), 1e-9) << i;
  const auto figures = session_.scene()->wound_figures(session_.duration());
  EXPECT_LT(figures[1].widest, 0.8 * figures[0].widest) << "pulled less";
}

TEST_F(Shown, BetweenCasesAnOpeningIsExpectedToBeOffByTheInterpolationToo) {
  cut_plate();
  const double at_a_case = session_.validity().front().expected_error.largest;
  say("set skin.prestress_v 0.04");
  ASSERT_TRUE(session_.between());
  const auto figures = session_.scene()->wound_figures(session_.duration());
  const double own = *error_of_gape(*session_.field()) / figures[0].widest;
  ASSERT_GT(own, 0.03) << "four cases do not tell much";
  EXPECT_GT(session_.validity().front().expected_error.largest, 0.95 * own);
  EXPECT_GT(session_.validity().front().expected_error.largest, at_a_case);
}

TEST_F(Shown, LinesOfTensionArePaintedAndReadAndTurnEveryCut) {
  write_study_of_prestresses(folder_ / "three");
  say("open " + (folder_ / "three"));
  say("mesh plate.stl");
  say("cut -15,0.7,0,0,0,1 0,0.7,0,0,0,1 15,0.7,0,0,0,1");
  say("tension 1,1,0 0.03,0.01");
  const std::vector<Vec3> everywhere = points();
  // Lines of one direction, wherever they are, are that direction.
  write_text_file(folder_ / "lines.csv", "x,y,z,dx,dy,dz\n-20,-5,0,1,1,0\n12,7,0,-2,-2,0\n0,0,0,1,1,0.5\n");
  say("tension " + folder_ / "lines.csv" + " 0.03,0.01");
  const std::vector<Vec3> of_lines = points();
  for (std::size_t i = 0; i < of_lines.size(); ++i) ASSERT_LT(norm(of_lines[i] - everywhere[i]), 1e-9) << i;
  const SessionState again = state_from_json(state_to_json(state()));
  ASSERT_TRUE(again.tension && again.tension->lines);
  EXPECT_EQ(again.tension->lines->size(), 3u);
  say("tension-stroke -15,1,0 15,1,0");
  EXPECT_EQ(state().tension->lines->size(), 4u);
  EXPECT_GT(widest(points(), of_lines), 0.01) << "along the cut, near to it";
  EXPECT_FALSE(session_.overlay().lines.empty()) << "they are drawn";
  say("undo");
  EXPECT_EQ(points(), of_lines);
  EXPECT_NE(refused("tension-stroke 1,1,0").find("two places"), std::string::npos);
  write_text_file(folder_ / "none.csv", "x,y,z\n1,2,3\n");
  EXPECT_NE(refused("tension " + folder_ / "none.csv" + " 0.03,0.01").find("no column dx"),
            std::string::npos);
  EXPECT_EQ(points(), of_lines);
}

TEST_F(Shown, TheUnitOfAMeshIsDoubtedByItsSize) {
  open();
  say("mesh plate.stl");
  EXPECT_EQ(answers_.find("warning"), std::string::npos) << answers_;
  say("unit m");
  EXPECT_EQ(state().scale, 1000);
  EXPECT_NE(answers_.find("the mesh is 6e+04 mm long"), std::string::npos) << answers_;
  say("mesh plate.stl cm");
  EXPECT_EQ(state().scale, 10);
  EXPECT_NE(refused("mesh plate.stl 1e6").find("give 1 mm a unit"), std::string::npos);
  EXPECT_EQ(state().scale, 10) << "as it was";
  EXPECT_NE(refused("unit parsec").find("neither mm, cm"), std::string::npos);
}

TEST_F(Shown, WoundsAreMeasured) {
  cut_plate();
  EXPECT_NE(refused("wound 2").find("from 1 to 1"), std::string::npos);
  say("wounds " + folder_ / "wounds.csv");
  EXPECT_NE(answers_.find("cut 1: 30.0 mm long, 6 mm deep; opens by up to "), std::string::npos) << answers_;
  EXPECT_NE(answers_.find("mostly uncertain because "), std::string::npos) << answers_;
  const std::string csv = read_text_file(folder_ / "wounds.csv");
  EXPECT_EQ(csv.find("cut,length,depth,opening,opening_error,opening_at,area,volume\n1,30,6,"), 0u) << csv;
  // The field's own openings at the places of the walls, integrated.
  const Field& field = *session_.field();
  double area = 0, volume = 0;
  constexpr int n = 300, layers = 120;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < layers; ++k) {
      const double u = -15 + 30 * (i + 0.5) / n, w = -6 * (k + 0.5) / layers;
      const Vec3 gap =
          field.displacement({u, 0, w}, Side::right, 30) - field.displacement({u, 0, w}, Side::left, 30);
      volume += gap.y * (30. / n) * (6. / layers);
      if (k == 0) area += norm(gap) * 30. / n;
    }
  const WoundFigures f = session_.scene()->wound_figures(state().time).front();
  EXPECT_NEAR(f.area, area, 0.03 * area);
  EXPECT_NEAR(f.volume, volume, 0.04 * volume) << "a mesh of 1 mm and few rows of wall";
  EXPECT_EQ(session_.scene()->wound_figures(0).front().volume, 0) << "closed";
  say("wound 1");
  ASSERT_TRUE(state().camera.pose);
  EXPECT_LT(norm(state().camera.pose->focal_point - Vec3{0, 0.7, 0}), 0.1);
}

TEST_F(Shown, ErrorsOfTheFileSystemAreMistakesInAScript) {
  const std::string name(300, 'a');
  write_text_file(folder_ / "script.txt", "open " + study() + "\nopen " + name + "\n");
  try {
    session_.run_script(folder_ / "script.txt");
    FAIL();
  } catch (const InputError& e) {
    EXPECT_EQ(std::string(e.what()).find("filesystem error"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("script.txt:2: "), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("File name too long"), std::string::npos) << e.what();
  }
}

TEST_F(Shown, AProbesFileHasTheFieldAtTheNodeToo) {
  say("open " + raw_study());
  say("probe 0.7,3.1,-0.4 " + folder_ / "motion.csv");
  const NumberTable table = read_csv(folder_ / "motion.csv");
  const Motion motion = session_.probed_motion();
  const double t = table.rows[3][table.column("t")];
  EXPECT_EQ(table.rows[3][table.column("at_node_dv")],
            session_.field()->displacement(*motion.node, Side::both, t).y);
  EXPECT_EQ(table.rows[3][table.column("dv")],
            session_.field()->displacement({0.7, 3.1, -0.4}, Side::both, t).y);
}

TEST_F(Shown, ImportedDataHaveTheTimesAndTheUnitsOfTheirSource) {
  Field field = synthetic_field(3);
  field.quantities.push_back({"heat", 1, std::vector<double>(field.coefficients().size(), 300)});
  field.source = FieldSource{"plate.pvd"};
  field.source->times = {100, 115, 130};
  field.source->fields = {"U:displacement", "T:heat[K]"};
  write_field(folder_ / "imported.dffd", field);
  say("open " + (folder_ / "imported.dffd"));
  say("time 12");
  say("color heat");
  EXPECT_EQ(text_of(session_.coloring_with_unit()).title, "heat, K");
  EXPECT_EQ(session_.progress_text(12, 30), "time 112 of 130");
  say("info");
  EXPECT_NE(answers_.find("time 112 of 130"), std::string::npos) << answers_;
  EXPECT_EQ(answers_.find("mm cut"), std::string::npos) << answers_;
  EXPECT_EQ(answers_.find("length cut"), std::string::npos) << answers_;
  say("open " + study());
  EXPECT_EQ(session_.progress_text(12, 30), "12.0 of 30.0 mm cut");
}

}  // namespace
}  // namespace cleft
