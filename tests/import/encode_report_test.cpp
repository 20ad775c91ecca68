// What cleft encode tells of imported series: errors of every field, and warnings where a spline is far off.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "base/file_versions.h"
#include "base/h5/h5.h"
#include "encoder/command/warnings.h"
#include "encoder/field/file/field_file.h"
#include "encoder/field/quantity_fields.h"
#include "encoder/samples.h"
#include "tests/import/cracked_bodies.h"
#include "tests/import/field_errors.h"
#include "tests/import/plate.h"
#include "tests/pipeline/commands.h"

namespace cleft {

namespace {

class EncodeReport : public testing::Test {
 protected:
  /// Figures of cleft encode, and warnings among its output.
  Outcome encode(const SourceSeries& series, const std::string& fields,
                 const std::vector<std::string>& options = {}) {
    expect_success(
        run_cleft("import", {series.write(folder), "--field", fields, "--out", folder / "case.h5"}));
    std::vector<std::string> arguments = {folder / "case.h5", "--out", folder / "case.dffd", "--json"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return expect_success(run_cleft("encode", arguments));
  }

  const TemporaryFolder folder;
};

/// The plate, with a layer that is hotter by 100 K than all others and heats up, and moved before the first
/// frame as no spline is.
SourceSeries hot_and_moved(const Plate& plate) {
  SourceSeries series = plate.series();
  series.fields.push_back({"hot", 1, {}});
  for (std::size_t j = 0; j < Plate::frames; ++j) {
    std::vector<double> hot;
    for (std::size_t n = 0; n < plate.local.size(); ++n) {
      const Vec3& p = plate.local[n];
      hot.push_back((std::abs(p.x - 4) < 0.1 ? 400 : 300) + static_cast<double>(j));
      series.fields[0].frames[j][3 * n + 2] += n % 7 == 0 ? 0.5 : 0;
    }
    series.fields.back().frames.push_back(hot);
  }
  return series;
}

/// A plane of 20 x 16 with a crack from its edge that grows along x, one column or two a frame, by a form
/// whose lips close as r^(3/2), and a pressure that follows it.
class CrackedPlane {
 public:
  explicit CrackedPlane(const Pose& pose) {
    for (int side : {-1, 1})
      for (int i = 0; i <= 20; ++i)
        for (int j = 0; j <= 12; ++j)
          if (side < 0 || (j == 6 && i < 12)) {
            number_[{i, j, side}] = series.add_point(pose.point({1. * i, (j - 6) * 4. / 3, 0}));
            nodes_.push_back({1. * i, (j - 6) * 4. / 3, j == 6 && i < 12 ? 1. * side : 0.});
          }
    for (int i = 0; i < 20; ++i)
      for (int j = 0; j < 12; ++j) {
        const auto n = [&](int a, int b) -> std::int64_t {
          return number_.at({a, b, j >= 6 && b == 6 && a < 12 ? 1 : -1});
        };
        series.add_cell(quad, {n(i, j), n(i + 1, j), n(i + 1, j + 1), n(i, j + 1)});
      }
    series.fields = {{"displacement", 3, {}}, {"p", 1, {}}};
    for (int k = 0; k < 10; ++k) {
      series.times.push_back(2 + 0.5 * k);
      std::vector<double> moved, pressure;
      for (const auto& [x, y, side] : nodes_) {
        const Vec3 d = displacement(x, y, side, k), there = pose.vector(d);
        moved.insert(moved.end(), {there.x, there.y, there.z});
        pressure.push_back(101325 + 10 * std::clamp(d.y / 2, -1., 1.));
      }
      series.fields[0].frames.push_back(moved), series.fields[1].frames.push_back(pressure);
    }
  }

  SourceSeries series;

  static double tip(std::size_t frame) { return std::round(12. * static_cast<double>(frame) / 9); }
  static Vec3 displacement(double x, double y, double side, int frame) {
    const double a = tip(static_cast<std::size_t>(frame)), r = std::hypot(x - a, y), pi = std::acos(-1);
    const double angle = y == 0 ? (x < a ? side * pi : 0) : std::atan2(y, x - a),
                 c = frame / 450. * std::pow(r, 1.5);
    return {0.5 * c * std::cos(1.5 * angle), -c * std::sin(1.5 * angle), 0};
  }

 private:
  std::map<std::array<int, 3>, std::int64_t> number_;
  std::vector<std::array<double, 3>> nodes_;
};

}  // namespace

/// In its first frames a crack has all its knots in a column of cells or less: between the nodes a quantity
/// is nearly what cells interpolate, where it overshot by 8 % of its range in frame 0, in which it is
/// constant.
TEST_F(EncodeReport, AQuantityDoesNotOvershootBetweenNodes) {
  const SourceSeries series = CrackedPlane(Pose::random(6)).series;
  const Outcome outcome = encode(series, "displacement,p:pressure[Pa]");
  EXPECT_EQ(outcome.output.find("warning"), std::string::npos) << outcome.output;
  const Field field = read_field(folder / "case.dffd");
  const double scale = field.quantities[0].scale;
  double worst = 0;
  for (std::size_t j = 0; j < series.times.size(); ++j)
    for (std::size_t c = 0; c + 1 < series.mesh.cell_offsets.size(); ++c) {
      const std::int64_t* corners = &series.mesh.connectivity[4 * c];
      const auto place = [&](std::int64_t n) { return field.source->canonical(series.mesh.points[n]); };
      const auto value = [&](std::int64_t n) { return series.fields[1].frames[j][n]; };
      const Vec3 inside = 0.5 * (place(corners[0]) + place(corners[2]));
      const auto check = [&](Vec3 at, double expected) {
        if (std::abs(at.y) < 1e-9) at.y = 0;
        double found = 0;
        field.quantity(0, at, inside.y < 0 ? Side::left : Side::right, series.times[j] - 2, {&found, 1});
        worst = std::max(worst, std::abs(found - expected) / scale);
      };
      check(inside, (value(corners[0]) + value(corners[1]) + value(corners[2]) + value(corners[3])) / 4);
      for (int k = 0; k < 4; ++k) {
        const std::int64_t a = corners[k], b = corners[(k + 1) % 4];
        check(0.5 * (place(a) + place(b)), 0.5 * (value(a) + value(b)));
      }
    }
  EXPECT_LT(worst, 0.01);
}

/// Along the body a pressure waves as no displacement does: on the knots of that its spline was off by .3.
TEST_F(EncodeReport, AQuantityThatWavesHasTheKnotsThatItNeeds) {
  const CrackedBody body = edge_crack();
  SourceSeries series = body.series();
  series.fields.push_back({"p", 1, {}});
  for (const double t : body.times) {
    std::vector<double> values;
    for (const CrackedBody::Node& node : body.nodes())
      values.push_back(101325 + 10 * std::sin(0.2 * node.abc.x - 0.5 * t) * std::cos(0.1 * node.abc.y));
    series.fields.back().frames.push_back(values);
  }
  const Outcome outcome = encode(series, "displacement,p");
  EXPECT_EQ(outcome.output.find("warning"), std::string::npos) << outcome.output;
  const Field field = read_field(folder / "case.dffd");
  EXPECT_LE(field.quantities.at(0).spline_error, 0.02);
  EXPECT_LE(field.report.spline_error, 0.01);
}

/// Seven elements a wave, in 3,195 nodes: no knots that follow a front are dense enough everywhere.
TEST_F(EncodeReport, AWaveHasEvenKnotsOfItsOwn) {
  CrackedBody body = edge_crack();
  body.a = planes(0, 24, 24), body.b = planes(-12, 12, 24), body.c = planes(-4, 0, 4);
  body.times = planes(0, 8, 8);
  body.doubled = [](const Vec3& x) { return x.x < 14; };
  body.displacement = [](const Vec3& x, int side, double t) {
    return 0.01 * t * beside_front(x.x - 1.5 * t - 0.7, x.y, side);
  };
  const auto pressure = [](const Vec3& x, double t) {
    return std::sin(0.9 * x.x - 1.1 * t) * std::cos(0.7 * x.y);
  };
  SourceSeries series = body.series();
  ASSERT_EQ(series.mesh.points.size(), 3195u);
  series.fields.push_back({"p", 1, {}});
  for (const double t : body.times) {
    std::vector<double>& values = series.fields.back().frames.emplace_back();
    for (const Vec3& x : series.mesh.points) values.push_back(pressure(x, t));
  }
  encode(series, "displacement,p");
  EXPECT_EQ(h5::File::open(folder / "case.dffd").read_number("/", "version"), field_version_of_own_knots);
  const Field field = read_field(folder / "case.dffd");
  const Quantity& p = field.quantities.at(0);
  EXPECT_TRUE(p.own);
  EXPECT_LE(p.spline_error, 0.01);
  std::vector<Place> places;
  double worst = 0;
  for (const double t : body.times)
    for (double x = 0.25; x < 24; x += 0.5)
      for (double y = -11.75; y < 12; y += 0.5) {
        const Place place{field.source->canonical({x, y, -1.25}), Side::both, t};
        double value = 0;
        field.quantity(0, place.uvw, place.side, t, {&value, 1});
        worst = std::max(worst, std::abs(value - pressure({x, y, -1.25}, t)));
        places.push_back(place);
      }
  EXPECT_LE(worst, 0.02) << "between the nodes";
  std::vector<double> all(places.size());
  QuantityFields(field, 0).at(places, all);
  for (std::size_t i = 0; i < places.size(); i += 17) {
    double value = 0;
    field.quantity(0, places[i].uvw, places[i].side, places[i].t, {&value, 1});
    EXPECT_NEAR(all[i], value, 1e-9);
  }
}

/// Errors of both lips add up: an opening may be off by more than twice the tolerance where the spline is
/// not.
TEST_F(EncodeReport, AnOpeningThatIsOffIsToldWhereTheSplineIsNot) {
  encode(edge_crack().series(), "displacement");
  Field field = read_field(folder / "case.dffd");
  const SnapshotReader reader(folder / "case.h5");
  const Series series(reader);
  const auto told = [&](double spline, double opening) {
    field.report.spline_error = spline, field.report.gape_error = opening;
    std::string all;
    for (const std::string& one : warnings_of(field, {{}}, series, {})) all += one;
    return all;
  };
  EXPECT_EQ(told(0.019, 0.0199), "");
  const std::string warning = told(0.018, 0.036);
  EXPECT_EQ(
      warning.find("the opening of the break, as the spline has it between the nodes, is off by 3.6 % of "
                   "the largest displacement, 3.6 times the tolerance; the spline is worst at node "),
      0u)
      << warning;
  EXPECT_EQ(told(0.03, 0.05).find("the spline, which is what is drawn between the nodes, is off by 3 %"), 0u);
}

/// A displacement of frame 0 is larger than what follows, and has not the knots of a tip that has only begun
/// to move: at those of the first frame its spline was off by .35.
TEST_F(EncodeReport, ALargeDisplacementOfFrame0KeepsTheToleranceInTheSpline) {
  CrackedBody body = edge_crack();
  body.displacement = [of = body.displacement](const Vec3& abc, int side, double t) {
    return of(abc, side, t) + Vec3{0, 0.005 * abc.x * abc.x, std::sin(abc.x / 8) * std::cos(abc.y / 10)};
  };
  const SourceSeries series = body.series();
  const Outcome outcome = encode(series, "displacement");
  EXPECT_EQ(outcome.output.find("warning"), std::string::npos) << outcome.output;
  const Field field = read_field(folder / "case.dffd");
  const Quantity& start = field.quantities.at(0);
  EXPECT_LE(start.spline_error, 0.02);
  EXPECT_LE(start.between_nodes, 0.02);
  ASSERT_TRUE(start.time.has_value());
  const FieldPlaces places{SnapshotReader(folder / "case.h5")};
  double worst = 0;
  for (const double t : {0., 1., 7.5, 12.})
    for (std::size_t n = 0; n < places.uvw.size(); ++n) {
      std::vector<double> values(3);
      field.quantity(0, places.uvw[n], places.sides[n], t, values);
      const std::vector<double>& data = series.fields[0].frames[0];
      worst = std::max(worst, std::hypot(values[0] - data[3 * n], values[1] - data[3 * n + 1],
                                         values[2] - data[3 * n + 2]));
    }
  EXPECT_NEAR(worst, start.spline_error * start.scale, 1e-9);
}

/// In the first frames the break is open between a few nodes, which knots are much nearer than.
TEST_F(EncodeReport, LipsDoNotOvershootBetweenNodes) {
  const SourceSeries series = CrackedPlane(Pose()).series;
  encode(series, "displacement");
  const Field field = read_field(folder / "case.dffd");
  double worst = 0;
  for (std::size_t j = 1; j < 4; ++j)
    for (const int side : {-1, 1})
      for (double x = 0.5; x < CrackedPlane::tip(j); ++x) {
        const Vec3 d = field.displacement(field.source->canonical({x, 0, 0}),
                                          side < 0 ? Side::left : Side::right, series.times[j] - 2),
                   exact = CrackedPlane::displacement(x, 0, side, static_cast<int>(j));
        worst = std::max(worst, norm(turned(d, axes_between(field.source->axes, same_axes)) - exact));
      }
  EXPECT_LT(worst / field.report.largest_displacement, 0.008);
}

/// Of a penny crack, nodes are few around its axis: the cells there hold the spline at every angle, which was
/// off by 1.17 in their middles.
TEST_F(EncodeReport, TheAxisOfARoundFrontHoldsTheSpline) {
  constexpr double step = 10. / 7;
  const auto disc = [](const Vec3& p) {  // of a square
    const double s = std::max(std::abs(p.x), std::abs(p.z)), a = s > 0 ? p.x / s : 0, b = s > 0 ? p.z / s : 0;
    return Vec3{s * a * std::sqrt(1 - b * b / 2), p.y, s * b * std::sqrt(1 - a * a / 2)};
  };
  CrackedBody penny;
  penny.name = "penny";
  penny.a = penny.c = planes(-10, 10, 14), penny.b = planes(-8, 8, 12), penny.times = planes(0, 9, 9);
  penny.doubled = [](const Vec3& x) { return std::max(std::abs(x.x), std::abs(x.z)) < 4.5 * step; };
  penny.place = disc;
  penny.displacement = [&](const Vec3& x, int side, double t) {
    constexpr int rings[] = {0, 1, 2, 2, 3, 3, 4, 4, 5, 5};
    const double a = rings[static_cast<int>(t)] * step, r = std::hypot(disc(x).x, disc(x).z);
    const double open = a > 0 ? std::pow(std::max(0., 1 - r * r / a / a), 1.5) * a / 7 : 0;
    return Vec3{
        0, (x.y != 0 ? (x.y > 0 ? 1 : -1) : side) * 0.1 * (1 + t / 10) * open * std::exp(-std::abs(x.y) / 4),
        0};
  };
  const SourceSeries series = penny.series();
  encode(series, "displacement");
  const Field field = read_field(folder / "case.dffd");
  double worst = 0;
  for (std::size_t j = 2; j < series.times.size(); ++j)
    for (std::size_t c = 0; c + 1 < series.mesh.cell_offsets.size(); ++c) {
      Vec3 at, mean;
      bool axis = false;
      for (std::size_t k = 8 * c; k < 8 * c + 8; ++k) {
        const std::int64_t n = series.mesh.connectivity[k];
        const std::vector<double>& d = series.fields[0].frames[j];
        at += 0.125 * series.mesh.points[n];
        axis = axis || std::hypot(series.mesh.points[n].x, series.mesh.points[n].z) < 1e-9;
        mean += 0.125 * Vec3{d[3 * n], d[3 * n + 1], d[3 * n + 2]};
      }
      if (!axis) continue;
      const Vec3 d = field.displacement(field.source->canonical(at), Side::both, series.times[j]);
      worst = std::max(worst, norm(turned(d, axes_between(field.source->axes, same_axes)) - mean));
    }
  EXPECT_LT(worst / field.report.largest_displacement, 0.3);
}

/// The faces of a crack inside a body hang together with no other part of its skin.
TEST_F(EncodeReport, ASolidsSkinIsNamedAsTheCause) {
  const std::vector<CrackedBody> bodies = cracked_bodies();
  const auto penny = std::find_if(bodies.begin(), bodies.end(),
                                  [](const CrackedBody& b) { return b.name.starts_with("penny"); });
  const SourceSeries series = penny->series();
  const std::string cause = "only the surface of a body";
  EXPECT_EQ(encode(series, "displacement").output.find(cause), std::string::npos);
  const std::string said = encode(skin_of(series), "displacement").output;
  for (const std::string told : {"warning: the spline", cause.c_str(), "give the solid's cells"})
    EXPECT_NE(said.find(told), std::string::npos) << told << "\n" << said;
  EXPECT_EQ(said.find("refine the mesh"), std::string::npos) << said;
}

/// One body has a crack; beside it is another that moves away.
TEST_F(EncodeReport, PartsThatMoveApartAreNamedAsTheCause) {
  CrackedBody body = edge_crack();
  body.solid = [](const Vec3& x) { return x.y < 8 || x.y > 9; };
  body.displacement = [](const Vec3& x, int side, double t) {
    return x.y > 8.5 ? Vec3{0, 0.2 * t, 0} : 0.01 * t * beside_front(x.x - 2 * t, x.y, side);
  };
  const std::string said = encode(body.series(), "displacement").output;
  for (const char* told : {"warning: the spline", "parts that share no nodes", "import each part by itself"})
    EXPECT_NE(said.find(told), std::string::npos) << told << "\n" << said;
}

TEST_F(EncodeReport, EveryFieldsSplineErrorIsToldAndWarnedOf) {
  const Plate plate(Plate::Cells::hexahedra, Pose());
  const Outcome outcome = encode(hot_and_moved(plate), "displacement,hot:heat[K],temperature");
  const nlohmann::json figures = figures_of(outcome);
  const Field field = read_field(folder / "case.dffd");
  const SnapshotReader reader(folder / "case.h5");
  const Snapshot& s = reader.snapshot();
  const std::vector<Sample> samples = samples_of(s);
  const std::vector<Vec3> closed = reader.displacement(0);
  ASSERT_EQ(field.quantities.size(), 3u);
  for (std::size_t q = 0; q < 3; ++q) {
    const Quantity& quantity = field.quantities[q];
    double worst = 0, at_worst = 0;
    for (std::size_t j = 0; j < s.frames(); ++j)
      for (std::size_t n = 0; n < samples.size(); ++n) {
        std::vector<double> found(static_cast<std::size_t>(quantity.components)),
            data = {closed[n].x, closed[n].y, closed[n].z};
        if (quantity.components == 1) data = {reader.point_array({quantity.name, 1, true}, j)[n]};
        field.quantity(q, samples[n].uvw, samples[n].side, s.times[j], found);
        double off = 0;
        for (std::size_t c = 0; c < found.size(); ++c) off = std::hypot(off, found[c] - data[c]);
        worst = std::max(worst, off);
        if (static_cast<double>(n) == quantity.worst_node && s.times[j] == quantity.worst_time)
          at_worst = off;
      }
    worst /= quantity.scale;
    EXPECT_NEAR(quantity.spline_error, worst, 1e-9) << quantity.name;
    EXPECT_NEAR(at_worst, worst * quantity.scale, 1e-9 * quantity.scale) << quantity.name;
    EXPECT_NEAR(figures["quantities"][q]["spline_error"].get<double>(), worst, 1e-9);
    const bool far_off = worst > 0.02;
    EXPECT_EQ(far_off, quantity.name != "temperature") << worst;
    const std::string warning = "warning: " + quantity.name;
    EXPECT_EQ(outcome.output.find(warning) != std::string::npos, far_off) << outcome.output;
    const auto is_of = [&](const nlohmann::json& text) {
      return text.get<std::string>().starts_with(quantity.name);
    };
    EXPECT_EQ(std::any_of(figures["warnings"].begin(), figures["warnings"].end(), is_of), far_off);
  }
  for (const char* told :
       {"(the displacement of frame 0): the spline", "at node ", "and t = ", "--tolerance displacement=0.1%"})
    EXPECT_NE(outcome.output.find(told), std::string::npos) << told << "\n" << outcome.output;
}

}  // namespace cleft
