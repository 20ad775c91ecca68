// Bodies with cracks of any shape and place: errors of their fields against closed forms.
#include "tests/import/cracked_bodies.h"

#include <gtest/gtest.h>
#include <hdf5.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/text.h"
#include "encoder/field/file/field_file.h"
#include "encoder/field/file/pieces_at_nodes.h"
#include "tests/import/field_errors.h"
#include "tests/pipeline/commands.h"

namespace cleft {

namespace {

class CrackedBodies : public testing::TestWithParam<std::size_t> {};
class SeveralCrackedBodies : public testing::TestWithParam<std::size_t> {};

}  // namespace

TEST_P(CrackedBodies, TheFieldAndItsOpeningKeepTheTolerance) { expect_exact(cracked_bodies()[GetParam()]); }

TEST_P(SeveralCrackedBodies, EachOpensAsExactlyAsOne) {
  expect_exact(bodies_of_several_cracks()[GetParam()]);
}

namespace {

class FieldsOfASeries : public testing::Test {
 protected:
  const TemporaryFolder folder;
  const std::string snapshot = folder / "case.h5", file = folder / "case.dffd";

  Outcome import(const SourceSeries& series, const std::string& fields, std::vector<std::string> more = {}) {
    std::filesystem::remove(snapshot);
    more.insert(more.begin(), {series.write(folder), "--field", fields, "--out", snapshot});
    return expect_success(run_cleft("import", more));
  }
  Outcome encode(const std::string& tolerances = "0.01") {
    std::filesystem::remove(file);
    return expect_success(run_cleft("encode", {snapshot, "--tolerance", tolerances, "--out", file}));
  }
  /// Largest norm of the difference of a quantity, as kept at the nodes, from a field of the series;
  /// `double_shear` of tensors.
  double error(const SourceSeries& series, std::size_t of_series, std::size_t of_field) {
    const Field field = read_field(file);
    const auto residual = read_quantity_residual(file, of_field);
    const FieldPlaces places{SnapshotReader(snapshot)};
    const auto& data = series.fields[of_series];
    double worst = 0;
    for (std::size_t j = 0; j < series.times.size(); ++j)
      for (std::size_t n = 0; n < places.uvw.size(); ++n) {
        std::vector<double> values(static_cast<std::size_t>(data.components));
        field.quantity(of_field, places.uvw[n], places.sides[n], series.times[j], values);
        double square = 0;
        for (int c = 0; c < data.components; ++c) {
          const double kept = values[c] + (residual ? residual->at(n, c, j) : 0);
          square += std::pow(kept - data.frames[j][n * data.components + c], 2) * (c < 3 ? 1 : 2);
        }
        worst = std::max(worst, std::sqrt(square));
      }
    return worst;
  }
};

/// A pressure about a large mean that jumps across a slit.
SourceSeries::Field pressure_of(const CrackedBody& body, double mean, double amplitude) {
  SourceSeries::Field field{"p", 1, {}};
  for (const double t : body.times) {
    auto& values = field.frames.emplace_back();
    for (const auto& [abc, side] : body.nodes())
      values.push_back(mean + amplitude * body.displacement(abc, side, t).y);
  }
  return field;
}

CrackedBody slit() {
  for (const CrackedBody& body : cracked_bodies())
    if (body.name.find("slit") != std::string::npos) return body;
  throw std::logic_error("no body with a slit");
}

}  // namespace

TEST_F(FieldsOfASeries, ToleranceIsOfTheRangeOfAPressure) {
  const CrackedBody body = slit();
  SourceSeries series = body.series();
  series.fields = {pressure_of(body, 101325, 12)};
  double low = 1e300, high = -1e300;
  for (const auto& frame : series.fields[0].frames)
    for (const double p : frame) low = std::min(low, p), high = std::max(high, p);
  ASSERT_LT(high - low, 40);
  import(series, "p");
  encode();
  EXPECT_NEAR(read_field(file).quantities[0].scale, high - low, 1e-6 * (high - low));
  EXPECT_LE(error(series, 0, 0), 0.01 * (high - low));
  encode("p=0.05Pa");
  EXPECT_LE(error(series, 0, 0), 0.05);
  const Outcome wrong =
      run_cleft("encode", {snapshot, "--tolerance", "T=0.1", "--out", folder / "none.dffd"});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_NE(wrong.output.find("no such field; there are: displacement, p"), std::string::npos)
      << wrong.output;
}

TEST_F(FieldsOfASeries, ATensorsNormIsTheSameInAllAxes) {
  const CrackedBody body = edge_crack();
  double largest = 0;
  for (unsigned seed = 0; seed < 2; ++seed) {
    const Pose pose = seed == 0 ? Pose() : Pose::random(seed);
    SourceSeries series = body.series();
    for (Vec3& p : series.mesh.points) p = pose.point(p);
    for (auto& frame : series.fields[0].frames)
      for (std::size_t i = 0; i < frame.size(); i += 3) {
        const Vec3 d = pose.vector({frame[i], frame[i + 1], frame[i + 2]});
        frame[i] = d.x, frame[i + 1] = d.y, frame[i + 2] = d.z;
      }
    SourceSeries::Field stress{"stress", 6, {}};
    for (const double t : body.times) {
      auto& values = stress.frames.emplace_back();
      for (const auto& [abc, side] : body.nodes()) {
        const Vec3 d = body.displacement(abc, side, t);
        const std::vector<double> tensor = pose.tensor({d.x, d.y, 0.1, 3 * d.y, 2 * d.x, -d.y});
        values.insert(values.end(), tensor.begin(), tensor.end());
      }
    }
    series.fields.push_back(stress);
    import(series, "displacement,stress");
    encode("0.02,stress=0.05");
    const Quantity quantity = read_field(file).quantities[0];
    if (seed == 0) largest = quantity.largest;
    EXPECT_NEAR(quantity.largest, largest, 1e-9 * largest);
    EXPECT_LE(quantity.error, 0.05);
  }
}

TEST_F(FieldsOfASeries, NodesWithoutCellsAreLeftOut) {
  const CrackedBody body = edge_crack();
  SourceSeries series = body.series();
  const std::size_t nodes = series.mesh.points.size();
  for (int i = 0; i < 20; ++i) {
    series.add_point({1000. + i, 50, 3});
    for (auto& frame : series.fields[0].frames) frame.insert(frame.end(), {1e6, std::nan(""), -1e6});
  }
  const Outcome outcome = import(series, "displacement");
  EXPECT_NE(outcome.output.find("20 nodes belong to no cell"), std::string::npos) << outcome.output;
  EXPECT_EQ(SnapshotReader(snapshot).snapshot().points.size(), nodes);
  encode();
  EXPECT_LE(read_field(file).report.spline_error, 0.01);

  // On the mesh itself they have no numbers, and the others theirs, by their numbers.
  const std::string out = folder / "on.pvd";
  expect_success(run_cleft("decode", {file, "--on", folder / "series_0.vtu", "--out", out}));
  const ImportedSeries decoded(out, parse_fields({"displacement"}));
  EXPECT_EQ(decoded.loose_nodes(), 20u);
  const std::vector<double> values = decoded.frame(series.times.size() - 1)[0];
  ASSERT_EQ(values.size(), 3 * nodes);
  double largest = 0, worst = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    largest = std::max(largest, std::abs(series.fields[0].frames.back()[i]));
    worst = std::max(worst, std::abs(values[i] - series.fields[0].frames.back()[i]));
  }
  EXPECT_LE(worst, 0.01 * largest);
}

/// Means of cells differ at all doubled nodes, open or closed, by what the field varies by within a cell.
TEST_F(FieldsOfASeries, ValuesOfCellsTellWhatIsOpen) {
  const CrackedBody body = edge_crack();
  SourceSeries series = body.series();
  SourceSeries::Field& field = series.fields.at(0);
  field.of_cells = true;
  for (std::vector<double>& values : field.frames) {
    std::vector<double> means;
    for (std::size_t c = 0; c + 1 < series.mesh.cell_offsets.size(); ++c)
      for (std::size_t k = 0; k < 3; ++k) {
        double sum = 0;
        for (auto i = series.mesh.cell_offsets[c]; i < series.mesh.cell_offsets[c + 1]; ++i)
          sum += values[3 * static_cast<std::size_t>(series.mesh.connectivity[i]) + k];
        means.push_back(sum / 8);
      }
    values = means;
  }
  const Imported imported(folder, series.write(folder), {"displacement"});
  const Snapshot& s = imported.snapshot();
  const auto levels = static_cast<int>(body.c.size());
  ASSERT_EQ(s.pairs.size(), static_cast<std::size_t>(24 * levels));
  for (std::size_t j = 4; j < s.frames(); ++j)  // one column of pairs at most is taken for closed
    EXPECT_NEAR(s.released[j], levels * std::min(24., 2 * body.times[j]), levels) << j;
  EXPECT_NE(imported.notes().find("means of cells jump by as much"), std::string::npos) << imported.notes();
}

/// As FEniCSx writes from two processes: each its cells and their nodes, also those of the other's border.
TEST_F(FieldsOfASeries, PiecesAreJoined) {
  const SourceSeries whole = edge_crack().series();
  std::string list;
  for (const bool second : {false, true}) {
    SourceSeries piece;
    piece.times = whole.times, piece.fields = {{"displacement", 3, {}}};
    std::map<std::int64_t, std::int64_t> number;
    for (std::size_t c = 0; c < whole.mesh.cell_types.size(); ++c) {
      std::vector<std::int64_t> corners(whole.mesh.connectivity.begin() + whole.mesh.cell_offsets[c],
                                        whole.mesh.connectivity.begin() + whole.mesh.cell_offsets[c + 1]);
      if ((whole.mesh.points[corners[0]].x + whole.mesh.points[corners[0]].y / 3 > 12) != second) continue;
      for (std::int64_t& corner : corners) {
        const auto [at, is_new] = number.try_emplace(corner, static_cast<std::int64_t>(number.size()));
        if (is_new) piece.add_point(whole.mesh.points[corner]);
        corner = at->second;
      }
      piece.add_cell(whole.mesh.cell_types[c], corners);
    }
    for (const auto& frame : whole.fields[0].frames) {
      auto& values = piece.fields[0].frames.emplace_back(3 * number.size());
      for (const auto& [node, here] : number)
        std::copy_n(frame.begin() + 3 * node, 3, values.begin() + 3 * here);
    }
    piece.write(folder, second ? "second" : "first");
  }
  const auto joined = [](const std::string& number) {
    std::string text =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"PUnstructuredGrid\" version=\"0.1\" "
        "byte_order=\"LittleEndian\">\n<PUnstructuredGrid GhostLevel=\"0\">\n<PPointData>"
        "<PDataArray type=\"Float64\" Name=\"displacement\" NumberOfComponents=\"3\"/></PPointData>\n"
        "<PPoints><PDataArray type=\"Float64\" NumberOfComponents=\"3\"/></PPoints>\n";
    for (const char* piece : {"first_", "second_"})
      text.append("<Piece Source=\"").append(piece).append(number).append(".vtu\"/>\n");
    return text.append("</PUnstructuredGrid>\n</VTKFile>\n");
  };
  for (std::size_t j = 0; j < whole.times.size(); ++j) {
    const std::string number = std::to_string(j);
    folder.write("frame_" + number + ".pvtu", joined(number));
    list += "<DataSet timestep=\"" + shortest(whole.times[j]) + "\" file=\"frame_" + number + ".pvtu\"/>\n";
  }
  const std::string series = folder.write("pieces.pvd",
                                          "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" "
                                          "version=\"0.1\">\n<Collection>\n" +
                                              list + "</Collection>\n</VTKFile>\n");
  const Outcome outcome =
      expect_success(run_cleft("import", {series, "--field", "displacement", "--out", snapshot}));
  EXPECT_NE(outcome.output.find("comes in pieces"), std::string::npos) << outcome.output;
  EXPECT_EQ(SnapshotReader(snapshot).snapshot().points.size(), whole.mesh.points.size());
  encode();
  EXPECT_LE(read_field(file).report.spline_error, 0.01);
  EXPECT_LE(read_field(file).report.gape_error, 0.01);
}

TEST_F(FieldsOfASeries, ADisplacementOfFrame0IsKept) {
  CrackedBody body = edge_crack();
  body.displacement = [of = body.displacement](const Vec3& abc, int side, double t) {
    return of(abc, side, t) + Vec3{0.3, 0.001 * abc.x * abc.x, 0};
  };
  const SourceSeries series = body.series();
  import(series, "displacement");
  encode();
  const Field field = read_field(file);
  ASSERT_EQ(field.quantities.size(), 1u);
  EXPECT_EQ(field.quantities[0].name, "displacement_at_start");
  SourceSeries at_start = series;
  for (auto& frame : at_start.fields[0].frames) frame = series.fields[0].frames[0];
  EXPECT_LE(error(at_start, 0, 0), 0.01 * field.report.largest_displacement);
}

/// The series comes back in its own axes, names and times: at its own nodes within the tolerance, and on its
/// mesh, of which the field knows nothing, within the error of the spline.
TEST_F(FieldsOfASeries, IsDecodedAsItWas) {
  for (const char* name : {"curved both ways, turned", "penny crack inside the body",
                           "half elliptic crack at a face", "2D edge crack, one plane of nodes"}) {
    SourceSeries series;
    for (const CrackedBody& body : cracked_bodies())
      if (body.name == name) series = body.series();
    for (double& t : series.times) t = 3 + 0.5 * t;
    series.fields[0].name = "U";
    add_start_and_tensor(series, 0.01);
    const TemporaryFolder place;
    const std::string pvd = series.write(place), h5 = place / "case.h5", dffd = place / "case.dffd";
    expect_success(run_cleft("import", {pvd, "--field", "U:displacement,S:stress[N/mm^2]", "--out", h5}));
    expect_success(run_cleft("encode", {h5, "--tolerance", "0.01", "--out", dffd}));
    const Field field = read_field(dffd);
    EXPECT_EQ(unit_of(*field.source, "stress"), "N/mm^2");
    EXPECT_EQ(unit_of(*field.source, "displacement"), "");
    expect_success(run_cleft("decode", {dffd, "--on", place / "series_0.vtu", "--out", place / "on.pvd"}));
    expect_success(run_cleft("decode", {dffd, "--nodes", h5, "--out", place / "at_nodes"}));
    expect_success(run_cleft("decode", {dffd, "--nodes", h5, "--out", place / "at_nodes.vtkhdf"}));
    for (const std::string out : {"on.pvd", "at_nodes.pvd", "at_nodes.vtkhdf"}) {
      const bool on = out == "on.pvd";
      const ImportedSeries decoded(place / out, parse_fields({"U", "S"}));
      EXPECT_EQ(decoded.times(), series.times);
      EXPECT_LE(largest_difference(decoded.mesh().points, series.mesh.points), 1e-9 * 30);
      double of_u = 0, of_s = 0;
      for (std::size_t j = 0; j < series.times.size(); ++j) {
        const FieldValues values = decoded.frame(j);
        for (std::size_t i = 0; i < values[0].size(); i += 3) {
          double u = 0, s = 0;
          for (std::size_t c = 0; c < 3; ++c)
            u += std::pow(values[0][i + c] - series.fields[0].frames[j][i + c], 2);
          for (std::size_t c = 0; c < 6; ++c)
            s += std::pow(values[1][2 * i + c] - series.fields[1].frames[j][2 * i + c], 2) * (c < 3 ? 1 : 2);
          of_u = std::max(of_u, std::sqrt(u)), of_s = std::max(of_s, std::sqrt(s));
        }
      }
      // Displacement and what it was in frame 0 each have the tolerance.
      const Quantity& tensor =
          field.quantities[0].name == "stress" ? field.quantities[0] : field.quantities[1];
      EXPECT_LE(of_u, (on ? 4 : 2) * 0.01 * field.report.largest_displacement) << name << " " << out;
      EXPECT_LE(of_s, (on ? std::max(0.01, tensor.spline_error) : 0.01) * 1.001 * tensor.scale)
          << name << " " << out;
    }
  }
}

TEST_F(FieldsOfASeries, ASplineThatIsOffIsWarnedOf) {
  import(edge_crack().series(), "displacement");
  EXPECT_EQ(encode().output.find("warning"), std::string::npos);
  import(edge_crack().series(), "displacement", {"--break", "none"});
  const std::string said = encode().output;
  EXPECT_NE(said.find("cleft encode: warning: the spline"), std::string::npos) << said;
  EXPECT_NE(said.find("--break"), std::string::npos) << said;
}

/// Files of earlier versions have no rules.
TEST_F(FieldsOfASeries, AnEarlierImportIsNamedWhereTheSplineIsOff) {
  const std::string told = "import the series again";
  import(edge_crack().series(), "displacement", {"--break", "none"});
  EXPECT_EQ(encode().output.find(told), std::string::npos);
  const hid_t earlier = H5Fopen(snapshot.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  ASSERT_GE(H5Adelete_by_name(earlier, "/import", "rules", H5P_DEFAULT), 0);
  H5Fclose(earlier);
  EXPECT_NE(encode().output.find(told), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(, SeveralCrackedBodies,
                         testing::Range(std::size_t{0}, bodies_of_several_cracks().size()));
INSTANTIATE_TEST_SUITE_P(, CrackedBodies, testing::Range(std::size_t{0}, cracked_bodies().size()));

}  // namespace cleft
