// Fields of bodies with several breaks: every command that reads them, and what is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "base/error.h"
#include "base/text.h"
#include "encoder/field/file/pieces_at_nodes.h"
#include "explorer/session/session.h"
#include "tests/import/cracked_bodies.h"
#include "tests/pipeline/commands.h"
#include "tests/support/damage.h"

namespace cleft {

namespace {

CrackedBody body_named(const std::string& name) {
  for (const CrackedBody& body : bodies_of_several_cracks())
    if (body.name == name) return body;
  throw std::logic_error("no body " + name);
}

class SeveralBreaks : public testing::Test {
 protected:
  const TemporaryFolder folder;
  const std::string snapshot = folder / "case.h5", file = folder / "case.dffd";
  std::string series;

  void make(const SourceSeries& source, const std::string& fields = "displacement") {
    series = source.write(folder);
    expect_success(run_cleft("import", {series, "--field", fields, "--out", snapshot}));
    expect_success(run_cleft("encode", {snapshot, "--out", file}));
  }
};

/// The rows of a CSV below its header.
std::vector<std::vector<double>> rows_of(const std::string& path) { return read_csv(path).rows; }

}  // namespace

/// In the middle of cells, of which the field knows nothing, away from the fronts.
TEST_F(SeveralBreaks, AreExactBetweenTheNodesToo) {
  for (const char* name : {"two parallel cracks, 8 elements apart", "2D, T"}) {
    std::filesystem::remove(snapshot), std::filesystem::remove(file);
    const CrackedBody body = body_named(name);
    make(body.series());
    const BlendedField field = read_blended(file);
    const FieldSource& source = *field.first().source;
    double worst = 0, largest = 0;
    for (std::size_t j = 4; j < body.times.size(); j += 6)
      for (std::size_t i = 0; i + 1 < body.a.size(); ++i)
        for (std::size_t k = 0; k + 1 < body.b.size(); ++k) {
          const Vec3 at{body.a[i] + 0.5, body.b[k] + 0.5, body.c.back()};
          const Vec3 exact = body.displacement(at, 0, body.times[j]);
          largest = std::max(largest, norm(exact));
          const auto fronts_near = [&](const Vec3& front) { return norm(front - at) < 3; };
          const double t = body.times[j];
          const bool is_t = body.c.size() == 1;
          const bool skip = is_t ? fronts_near({std::min(32., 2 * t), 0, 0}) ||
                                       fronts_near({20, 1.5 * (t - 16), 0}) || fronts_near({20, 0, 0})
                                 : fronts_near({2 * t, -4, 0}) || fronts_near({t, 4, 0});
          if (skip) continue;
          const Vec3 uvw = turned(at - source.origin, source.axes);
          const Vec3 d = field.displacement(uvw, Side::both, t);
          const auto& [u, v, w] = source.axes;
          worst = std::max(worst, norm(d.x * u + d.y * v + d.z * w - exact));
        }
    EXPECT_LE(worst, 0.015 * largest) << name;
  }
}

TEST_F(SeveralBreaks, AreReadByEveryCommandThatReadsFieldsOfImportedData) {
  const CrackedBody body = body_named("far apart, at a right angle, turned");
  SourceSeries source = body.series();
  const std::vector<CrackedBody::Node> nodes = body.nodes();
  add_start_and_tensor(source, 0.02);
  make(source, "displacement,S");
  expect_success(run_cleft("check", {snapshot, file}));
  EXPECT_NE(expect_success(run_cleft("info", {snapshot})).output.find("breaks: 2"), std::string::npos);
  EXPECT_NE(expect_success(run_cleft("info", {file})).output.find("pieces:"), std::string::npos);

  // Back as it was, at its own nodes and on its mesh.
  expect_success(run_cleft("decode", {file, "--nodes", snapshot, "--out", folder / "own"}));
  expect_success(run_cleft("decode", {file, "--on", folder / "series_0.vtu", "--out", folder / "on"}));
  double largest[2] = {0, 0};
  for (std::size_t f = 0; f < 2; ++f)
    for (const auto& frame : source.fields[f].frames)
      for (const double value : frame) largest[f] = std::max(largest[f], std::abs(value));
  for (const char* name : {"own.pvd", "on.pvd"}) {
    const ImportedSeries decoded(folder / name, parse_fields({"displacement", "S"}));
    for (std::size_t j = 0; j < source.times.size(); ++j) {
      const FieldValues values = decoded.frame(j);
      for (std::size_t f = 0; f < 2; ++f)
        for (std::size_t i = 0; i < values[f].size(); ++i)
          ASSERT_NEAR(values[f][i], source.fields[f].frames[j][i], 0.04 * largest[f])
              << name << j << " " << f;
    }
  }

  // Nodes and points agree where there is no residual.
  expect_success(
      run_cleft("eval", {file, "--nodes", snapshot, "--frame", "6", "--out", folder / "nodes.csv"}));
  const SnapshotReader reader(snapshot);
  std::string points = "u,v,w,side,t\n";
  for (const Vec3& p : reader.snapshot().points)
    points += shortest(p.x) + "," + shortest(p.y) + "," + shortest(p.z) + ",0,6\n";
  expect_success(run_cleft(
      "eval", {file, "--points", folder.write("points.csv", points), "--out", folder / "values.csv"}));
  const auto at_nodes = rows_of(folder / "nodes.csv"), at_points = rows_of(folder / "values.csv");
  ASSERT_EQ(at_nodes.size(), nodes.size());
  ASSERT_EQ(at_points.size(), nodes.size());
  for (std::size_t n = 0; n < nodes.size(); ++n)
    if (nodes[n].side == 0)
      for (int c = 0; c < 3; ++c) ASSERT_NEAR(at_points[n][c], at_nodes[n][c], 0.03 * largest[0]) << n;
  const Outcome outside =
      run_cleft("eval", {file, "--points", folder.write("far.csv", "u,v,w,side,t\n900,0,0,0,6\n")});
  EXPECT_EQ(outside.exit_code, 2);
  EXPECT_NE(outside.output.find("outside of the body"), std::string::npos) << outside.output;
}

/// On the mesh, with all quantities, of one break and of several.
TEST_F(SeveralBreaks, AndOneAreExportedOnTheirMesh) {
  for (const CrackedBody& body : {edge_crack(), body_named("2D, two parallel cracks")}) {
    std::filesystem::remove(snapshot), std::filesystem::remove(file);
    SourceSeries source = body.series();
    SourceSeries::Field heat{"T", 1, {}};
    for (const auto& frame : source.fields[0].frames) {
      auto& values = heat.frames.emplace_back();
      for (std::size_t i = 0; i < frame.size(); i += 3) values.push_back(300 + frame[i + 1]);
    }
    source.fields.push_back(heat);
    make(source, "displacement,T");
    const std::string frames = std::to_string(source.times.size());
    expect_success(run_cleft(
        "export", {file, "--paraview", folder / ("out_" + body.name.substr(0, 2)), "--frames", frames}));
    const ImportedSeries exported(folder / ("out_" + body.name.substr(0, 2) + ".pvd"),
                                  parse_fields({"displacement", "T"}));
    const SnapshotReader reader(snapshot);
    ASSERT_EQ(exported.mesh().points.size(), reader.snapshot().points.size());
    double largest = 0;
    for (const double value : source.fields[0].frames.back()) largest = std::max(largest, std::abs(value));
    for (std::size_t j = 0; j < source.times.size(); ++j) {
      const FieldValues values = exported.frame(j);
      const std::vector<Vec3> data = reader.displacement(j);
      for (std::size_t n = 0; n < data.size(); ++n) {
        for (int c = 0; c < 3; ++c)
          ASSERT_NEAR(values[0][3 * n + static_cast<std::size_t>(c)], data[n][c], 0.03 * largest);
        ASSERT_NEAR(values[1][n], source.fields[1].frames[j][n], 0.06 * largest);
      }
    }
  }
}

/// The explorer draws the body's own mesh, coloured by each quantity.
TEST_F(SeveralBreaks, AndOneAreExploredOnTheirMesh) {
  for (const CrackedBody& body : {edge_crack(), body_named("far apart, at a right angle, turned")}) {
    std::filesystem::remove(snapshot), std::filesystem::remove(file);
    SourceSeries source = body.series();
    SourceSeries::Field heat{"T", 1, {}}, stress{"S", 6, {}};
    for (const auto& frame : source.fields[0].frames) {
      auto &values = heat.frames.emplace_back(), &tensors = stress.frames.emplace_back();
      for (std::size_t i = 0; i < frame.size(); i += 3) {
        values.push_back(300 + frame[i + 1]);
        tensors.insert(tensors.end(), {frame[i], 0, 0, frame[i + 1], 0, frame[i + 2]});
      }
    }
    source.fields.insert(source.fields.end(), {heat, stress});
    make(source, "displacement,T,S");
    Session session{SessionServices{}};
    session.say("open " + file);
    EXPECT_EQ(session.quantities(), (std::vector<std::string>{"S", "T"}));
    const auto scene = session.scene();
    const SnapshotReader reader(snapshot);
    const Snapshot& mesh = reader.snapshot();
    // Its points are nodes: each is found by its place, of doubled ones any.
    const auto key = [](const Vec3& p) { return std::array{p.x, p.y, p.z}; };
    std::multimap<std::array<double, 3>, std::size_t> at_place;
    for (std::size_t n = 0; n < mesh.points.size(); ++n) at_place.emplace(key(mesh.points[n]), n);
    const std::vector<Vec3>& rest = scene->surface().points;
    ASSERT_GT(rest.size(), mesh.points.size() / 3);
    double largest = 0, volume = 0, expected = 0;
    for (const double value : source.fields[0].frames.back()) largest = std::max(largest, std::abs(value));
    for (const auto& [a, b, c] : scene->surface().triangles)
      volume += dot(rest[a], cross(rest[b], rest[c])) / 6;
    for (std::size_t c = 0; c < mesh.cell_types.size(); ++c) {  // bodies of boxes, in any direction
      const auto corner = [&](int i) {
        return mesh.points[static_cast<std::size_t>(
            mesh.connectivity[static_cast<std::size_t>(mesh.cell_offsets[c] + i)])];
      };
      expected += std::abs(dot(corner(1) - corner(0), cross(corner(3) - corner(0), corner(4) - corner(0))));
    }
    EXPECT_NEAR(volume, expected, 1e-6 * expected) << body.name;
    const std::size_t last = mesh.frames() - 1;
    const double t = mesh.times[last];
    std::vector<Vec3> moved;
    scene->positions(t, moved);
    std::vector<double> colors;
    const std::vector<Vec3> data = reader.displacement(last);
    const auto off_by = [&](const auto& distance) {
      double most = 0;
      for (std::size_t i = 0; i < rest.size(); ++i) {
        double least = HUGE_VAL;
        const auto [from, to] = at_place.equal_range(key(rest[i]));
        for (auto n = from; n != to; ++n) least = std::min(least, distance(i, n->second));
        most = std::max(most, least);
      }
      return most;
    };
    EXPECT_LT(off_by([&](std::size_t i, std::size_t n) { return norm(moved[i] - rest[i] - data[n]); }),
              0.03 * largest);
    session.say("color T");
    EXPECT_EQ(text_of(session.state().coloring).title, "T");
    scene->values(session.state().coloring, nullptr, t, colors);
    const std::vector<double>& heats = source.fields[1].frames[last];
    EXPECT_LT(off_by([&](std::size_t i, std::size_t n) { return std::abs(colors[i] - heats[n]); }),
              0.06 * largest);
    session.say("color S");  // its norm, with each shear twice
    scene->values(session.state().coloring, nullptr, t, colors);
    const auto norm_at = [&](std::size_t n) {
      const double* s = &source.fields[0].frames[last][3 * n];
      return std::sqrt(s[0] * s[0] + 2 * s[1] * s[1] + 2 * s[2] * s[2]);
    };
    EXPECT_LT(off_by([&](std::size_t i, std::size_t n) { return std::abs(colors[i] - norm_at(n)); }),
              0.06 * largest);
    EXPECT_THROW(session.say("color U"), InputError);
    session.say("color error");
    scene->values(session.state().coloring, nullptr, t, colors);
    EXPECT_LT(*std::max_element(colors.begin(), colors.end()), 0.03 * largest);
  }
}

TEST_F(SeveralBreaks, AreRefusedWhereOneIsNeeded) {
  make(body_named("2D, two parallel cracks").series());
  std::filesystem::rename(snapshot, folder / "elsewhere.h5");
  const Outcome outcome = run_cleft("export", {file, "--paraview", folder / "out.pvd"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.output.find("with several breaks"), std::string::npos) << outcome.output;
  expect_success(
      run_cleft("export", {file, "--nodes", folder / "elsewhere.h5", "--paraview", folder / "out.pvd"}));
  // One of them by its plane, as before.
  expect_success(
      run_cleft("import", {series, "--field", "displacement", "--break", "0,1,0,4", "--out", snapshot}));
  EXPECT_TRUE(SnapshotReader(snapshot).snapshot().pieces.empty());
}

/// A damaged snapshot or field of several pieces is refused, or gives what the sound one gave.
TEST_F(SeveralBreaks, AreRefusedWhereTheirFilesAreDamaged) {
  CrackedBody body = body_named("2D, two parallel cracks");
  body.times.resize(5);
  make(body.series());
  std::string found;
  const auto read_snapshot = [&](const std::string& path) {
    check_snapshot(path);
    found.clear();
    for (const std::size_t piece : {0, 1}) {
      const SnapshotReader reader(path, piece);
      for (const Vec3& d : reader.displacement(4)) found += shortest(d.x) + " ";
      for (const Vec3& p : reader.snapshot().points) found += shortest(p.y) + " ";
    }
  };
  const auto read_both = [&](const std::string& path) {
    found = shortest(static_cast<double>(nodes_in(path)));
    for (const FieldPiece& piece : read_pieces(path))
      for (const Vec3& c : piece.field.coefficients()) found += shortest(c.y) + " ";
    read_blended(path);
  };
  read_snapshot(snapshot);
  const std::string of_snapshot = found;
  EXPECT_EQ(unnoticed_damages(snapshot, 20, read_snapshot, [&] { return found == of_snapshot; }), 0);
  read_both(file);
  const std::string of_field = found;
  EXPECT_EQ(unnoticed_damages(file, 20, read_both, [&] { return found == of_field; }), 0);
}

}  // namespace cleft
