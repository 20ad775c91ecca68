// Raw data beside the field: errors, probe, zoom; figures of how it works; what parameters do.
#include <cmath>
#include <random>

#include "base/text.h"
#include "tests/session/raw_study.h"
#include "tests/session/session_fixture.h"
#include "tests/support/older_field.h"

namespace cleft {
namespace {

class Closer : public SessionTest {
 protected:
  void open_raw() { say("open " + raw_study()); }
};

TEST_F(Closer, ColoursByTheErrorOfTheNearestNode) {
  open_raw();
  say("color error");
  std::vector<double> values;
  session_.scene()->values(Coloring::error, nullptr, 20, values);
  const std::vector<Vec3>& points = session_.scene()->surface().points;
  for (std::size_t i = 0; i < points.size(); ++i)  // nodes stand 2 mm apart along u
    EXPECT_NEAR(values[i], norm(made_error(points[i])), 0.001 * (1 + 1e-6)) << i;
  session_.scene()->values(Coloring::error, nullptr, 1, values);
  for (const double v : values) EXPECT_NEAR(v, 0, 1e-9) << "the closed frame is what all counts from";
}

TEST_F(Closer, AMissingSimulationIsSaidAndNotFatal) {
  open_raw();
  say("color error");
  say("case 2");
  std::vector<double> values;
  session_.scene()->values(Coloring::error, nullptr, 20, values);
  for (const double v : values) EXPECT_TRUE(std::isnan(v));
  EXPECT_NE(session_.note_of(1).find("without raw frames"), std::string::npos);
  say("color displacement");
  for (const char* line : {"color error", "zoom 0,0,0", "figure constraints"})
    EXPECT_NE(refused(line).find("case1/case.h5"), std::string::npos) << line << ": " << refused(line);
  answers_.clear();
  say("probe 0,3,0");
  EXPECT_NE(answers_.find("are gone"), std::string::npos) << answers_;
  say("figure lattice");
  EXPECT_GT(session_.overlay().lines.size(), 20u);
}

TEST_F(Closer, ARefusedStateLeavesTheSimulationsOfItsStudyNowhere) {
  const std::string other = folder_ / "other";
  std::filesystem::copy(raw_study(), other, std::filesystem::copy_options::recursive);
  say("open " + other);
  say("color error");
  say("compare 1 2");
  say("save " + folder_ / "other.json");
  say("single");
  open_raw();
  const auto raw = session_.raw_of(0);
  // The first case's simulation is read, then the second one's turns out to be damaged.
  write_text_file(other + "/cases/case1/case.h5", "torn");
  EXPECT_NE(refused("load " + folder_ / "other.json").find("case1/case.h5"), std::string::npos);
  EXPECT_EQ(state().study, raw_study());
  EXPECT_EQ(session_.raw_of(0).get(), raw.get());
}

TEST_F(Closer, AProbePlotsAPointAndTheNodeBesideIt) {
  open_raw();
  say("probe 0.4,0,-0.5 left " + folder_ / "motion.csv");
  const Motion motion = session_.probed_motion();
  ASSERT_TRUE(motion.node);
  EXPECT_EQ(norm(*motion.node - Vec3{}), 0) << "the left node of the pair at the origin";
  const auto field = session_.field();
  for (std::size_t i = 0; i < motion.field[1].x.size(); ++i) {
    const Vec3 d = field->displacement({0.4, 0, -0.5}, Side::left, motion.field[1].x[i]);
    EXPECT_EQ(motion.field[1].y[i], d.y);
  }
  ASSERT_EQ(motion.raw[0].x, raw_snapshot().times);
  for (std::size_t j = 1; j < 4; ++j) {
    const Vec3 d = field->displacement({}, Side::left, motion.raw[0].x[j]) + made_error({});
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(motion.raw[k].y[j], d[k], 1e-9);
  }
  const NumberTable table = read_csv(folder_ / "motion.csv");
  ASSERT_EQ(table.rows.size(), 4u);
  EXPECT_NEAR(table.rows[3][table.column("node_dw")], motion.raw[2].y[3], 1e-9);
  EXPECT_NE(answers_.find("off by up to 0.04 mm"), std::string::npos) << answers_;
  EXPECT_NE(refused("probe 0,0,1").find("outside the patch"), std::string::npos);
  EXPECT_NE(refused("probe 0,3,0 left").find("other side"), std::string::npos);
  say("save " + folder_ / "s.json");
  say("probe clear");
  EXPECT_FALSE(state().probe);
  say("load " + folder_ / "s.json");
  ASSERT_TRUE(state().probe);
  EXPECT_EQ(state().probe->side, Side::left);
}

TEST_F(Closer, ARulerMovesWithTheSkin) {
  open_raw();
  say("time 20");
  answers_.clear();
  say("measure -5,4,0 -5,-4,0 1,-4,0");
  // Where the field takes the places, and the law of cosines and Heron's formula of their distances.
  const auto field = session_.field();
  std::vector<Vec3> places{{-5, 4, 0}, {-5, -4, 0}, {1, -4, 0}};
  for (Vec3& place : places) place += field->displacement(place, side_of(place.y), 20);
  const double a = norm(places[1] - places[0]), b = norm(places[2] - places[1]),
               c = norm(places[2] - places[0]), half = (a + b + c) / 2;
  EXPECT_GT(a, 9) << "it is the opening's size that is measured";
  const Measures now = session_.ruler().at(20), rest = session_.ruler().at_rest();
  ASSERT_EQ(now.distances.size(), 2u);
  constexpr double of_flat_triangles = 0.01;  // mm: places lie between the surface's points
  EXPECT_NEAR(now.distances[0], a, of_flat_triangles);
  EXPECT_NEAR(now.distances[1], b, of_flat_triangles);
  EXPECT_NEAR(now.angle.value(), std::acos((a * a + b * b - c * c) / (2 * a * b)) * 180 / M_PI, 0.1);
  EXPECT_NEAR(now.area.value(), std::sqrt(half * (half - a) * (half - b) * (half - c)), 0.1);
  EXPECT_NEAR(rest.distances[0], 8, 1e-9);
  EXPECT_NEAR(rest.angle.value(), 90, 1e-9);
  EXPECT_NEAR(rest.area.value(), 24, 1e-9);
  EXPECT_NE(answers_.find(formatted("%.2f mm (at rest 8.00)", now.distances[0])), answers_.npos) << answers_;
  EXPECT_EQ(session_.overlay().dots.size(), 3u);
  EXPECT_NE(session_.overlay().caption.find("angle"), std::string::npos);
  say("time 0");
  EXPECT_NEAR(session_.ruler().at(0).distances[0], 8, 1e-9);
  say("measure add 1,4,0");
  EXPECT_NEAR(session_.ruler().at_rest().area.value(), 48, 1e-9) << "of four places";
  EXPECT_FALSE(session_.ruler().at_rest().angle);
  EXPECT_NE(refused("measure add 0,0,50").find("the skin is 50 mm away from 0,0,50"), std::string::npos);
  EXPECT_EQ(state().ruler.size(), 4u) << "what is refused adds nothing";
  say("save " + folder_ / "s.json");
  say("measure clear");
  EXPECT_TRUE(session_.overlay().empty());
  say("load " + folder_ / "s.json");
  EXPECT_EQ(state().ruler.size(), 4u);
}

TEST_F(Closer, ZoomReadsTheNodesOfThePlaceAndNoOthers) {
  open_raw();
  say("time 21");
  say("zoom 20,10,0 4.1");
  const Overlay overlay = session_.overlay();
  const Snapshot s = raw_snapshot();
  const auto field = session_.field();
  std::vector<Vec3> expected;
  for (const Vec3& p : s.points)
    if (norm(p - Vec3{20, 10, 0}) <= 4.1)
      expected.push_back(p + field->displacement(p, side_of(p.y), 20) + made_error(p));
  ASSERT_EQ(overlay.dots.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_NEAR(norm(overlay.dots[i].place - expected[i]), 0, 1e-9);
  EXPECT_NE(overlay.caption.find("frame 2 at 20.0 mm: the field is off by up to 0.064 mm"), std::string::npos)
      << overlay.caption;
  ASSERT_TRUE(overlay.scale) << "what the nodes' colours mean";
  EXPECT_NEAR(overlay.scale->largest, 0.064, 0.0005);
  EXPECT_TRUE(state().camera.pose);
  EXPECT_NE(refused("zoom 1,1,-1 0.5").find("no node"), std::string::npos);
  say("zoom off");
  EXPECT_TRUE(session_.overlay().empty());
}

TEST_F(Closer, SlabsHoldTheNodesAskedForAndLittleElse) {
  // 40,000 rows; nodes at both ends of the file must not read what lies between.
  Snapshot s = raw_snapshot();
  s.pairs.clear(), s.released.assign(s.times.size(), 0);
  while (s.points.size() < 40000) s.points.push_back({25 + 1e-4 * double(s.points.size()), 19, -11});
  SnapshotWriter writer(folder_ / "large.h5", s);
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  std::vector<std::vector<Vec3>> frames;
  for (std::size_t j = 0; j < s.frames(); ++j) {
    frames.emplace_back();
    for (std::size_t n = 0; n < s.points.size(); ++n)
      frames.back().push_back({normal(random), normal(random), normal(random)});
    writer.write_frames(j, frames.back());
  }
  writer.finish(s);
  Field field = synthetic_field(3);
  field.case_hash = "case0";
  const RawCase raw(folder_ / "large.h5", std::make_shared<const Field>(field));
  const std::vector<int> nodes{3, 7, 100, 39990, 39999};
  const std::vector<Vec3> found = raw.displacements(2, nodes);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const std::size_t n = nodes[i];
    EXPECT_EQ(found[i], frames[2][n] - frames[0][n]);
  }
  EXPECT_EQ(raw.rows_read(), 2u * (98 + 10));
}

TEST_F(Closer, TheNearestNodeIsThatOfAllOnItsSide) {
  const RawCase raw(raw_study() + "/cases/case0/case.h5",
                    std::make_shared<const Field>(read_field(raw_study() + "/cases/case0/case.dffd")));
  const Snapshot& s = raw.snapshot();
  std::mt19937 random(2);
  std::uniform_real_distribution<double> u(-33, 33), v(-22, 22), w(-13, 1);
  for (int i = 0; i < 200; ++i) {
    const Vec3 p{u(random), i % 4 == 0 ? 0 : v(random), w(random)};
    const Side side = p.y == 0 ? (i % 8 == 0 ? Side::left : Side::right) : side_of(p.y);
    double least = HUGE_VAL;
    for (std::size_t n = 0; n < s.points.size(); ++n)
      if (const Side of = raw.side(static_cast<int>(n)); of == Side::both || of == side)
        least = std::min(least, norm(s.points[n] - p));
    EXPECT_EQ(norm(s.points[raw.nearest_node(p, side)] - p), least);
  }
}

TEST_F(Closer, ConstraintsAreReleasedBehindTheTip) {
  open_raw();
  say("time 20");
  say("figure constraints");
  const Snapshot s = raw_snapshot();
  const Overlay overlay = session_.overlay();
  const std::size_t released = s.released[2];
  ASSERT_GT(released, 0u);
  EXPECT_EQ(overlay.dots.size(), s.pairs.size() + released) << "two where they have parted";
  EXPECT_EQ(overlay.lines.size(), released) << "there is no skin in this snapshot";
  for (const Overlay::Line& line : overlay.lines) EXPECT_LT(line.places.front().x, 5 + 1e-9);
  say("figure off");
  EXPECT_TRUE(session_.overlay().empty());
  EXPECT_NE(refused("figure latice").find("lattice"), std::string::npos);
  EXPECT_NE(refused("figure volume").find("mesh"), std::string::npos);
}

TEST_F(Closer, TheLatticeIsWhereTheFieldMovesIt) {
  open_raw();
  say("time 15");
  say("figure lattice");
  const auto field = session_.field();
  const Overlay overlay = session_.overlay();
  for (const double u : {-30., 0., 30.}) {  // knots are uniform: these are among them
    const Vec3 corner = Vec3{u, 20, 0} + field->displacement({u, 20, 0}, Side::right, 15);
    EXPECT_TRUE(std::any_of(overlay.dots.begin(), overlay.dots.end(),
                            [&](const Overlay::Dot& d) { return norm(d.place - corner) < 1e-9; }) ||
                u == 0);
  }
  // On the lips of the open cut a left and a right dot part.
  const double gape = norm(field->displacement({-7.5, 0, 0}, Side::right, 15) -
                           field->displacement({-7.5, 0, 0}, Side::left, 15));
  EXPECT_GT(gape, 1);
}

TEST_F(Closer, TheVolumeFollowsThePath) {
  cut_plate();
  say("time 10");
  say("figure volume");
  const Overlay overlay = session_.overlay();
  ASSERT_EQ(overlay.dots.size(), 2u);
  for (const Overlay::Dot& dot : overlay.dots) {
    EXPECT_NEAR(dot.place.x, -5, 1e-6);
    EXPECT_NEAR(dot.place.y, 0.7, 1e-6);
  }
  EXPECT_NEAR(overlay.dots[0].place.z, -6, 1e-6) << "as deep as the case";
  say("patch");
  EXPECT_EQ(state().figure, "");
}

TEST_F(Closer, ATornadoOfAPowerLawIsThatLaw) {
  std::vector<std::vector<double>> rows;
  std::vector<double> gapes;
  const auto law = [](double a, double b) { return 3 * a * std::pow(b, -0.4); };
  for (const double a : {1., 2., 3.})
    for (const double b : {0.5, 1., 4.}) rows.push_back({a, b}), gapes.push_back(law(a, b));
  const Tornado t = tornado_of({"a", "b"}, rows, gapes);
  ASSERT_TRUE(t.logarithms);
  EXPECT_NEAR(t.explained, 1, 1e-12);
  ASSERT_EQ(t.bars.size(), 2u);
  EXPECT_EQ(t.bars[0].parameter, "a");
  const double a = std::sqrt(3.), b = std::sqrt(2.);  // the middles, in logarithms
  EXPECT_NEAR(t.middle, law(a, b), 1e-9);
  EXPECT_NEAR(t.bars[0].at_least, law(1, b), 1e-9);
  EXPECT_NEAR(t.bars[0].at_greatest, law(3, b), 1e-9);
  EXPECT_NEAR(t.bars[1].at_least, law(a, 0.5), 1e-9);
  EXPECT_NEAR(t.bars[1].at_greatest, law(a, 4), 1e-9);
  for (auto& row : rows) row[1] = row[0];
  EXPECT_THROW(tornado_of({"a", "b"}, rows, gapes), InputError) << "they always vary together";
  rows.resize(2), gapes.resize(2);
  EXPECT_THROW(tornado_of({"a", "b"}, rows, gapes), InputError);
}

TEST_F(Closer, WhatTakesLongIsToldAndCancelled) {
  open();
  std::vector<double> parts;
  session_.tell_progress_to([&](const std::string&, double part) {
    parts.push_back(part);
    return parts.size() < 3;
  });
  EXPECT_NE(refused("find gape > 3").find("cancelled"), std::string::npos);
  EXPECT_EQ(state().where, "") << "the session is as it was";
  EXPECT_EQ(parts.size(), 3u);
  parts.clear();
  session_.tell_progress_to([&](const std::string&, double part) {
    parts.push_back(part);
    return true;
  });
  say("tornado");
  EXPECT_EQ(parts.size(), 4u);
  EXPECT_NE(answers_.find("skin.prestress_v"), std::string::npos);
}

TEST_F(Closer, StudiesSayWhatIsLeftOutOrGone) {
  const std::string copy = folder_ / "study";
  std::filesystem::copy(study(), copy, std::filesystem::copy_options::recursive);
  publish_older_case(copy, "0123456789abcdef");
  say("open " + copy);
  EXPECT_EQ(session_.study()->size(), 4);
  EXPECT_NE(answers_.find("of an older format: case 0123456789abcdef"), std::string::npos) << answers_;
  EXPECT_NE(answers_.find("the raw data of 5 cases are gone"), std::string::npos) << answers_;
  EXPECT_EQ(session_.notices().size(), 2u) << "a window that is opened later asks for them";
}

}  // namespace
}  // namespace cleft
