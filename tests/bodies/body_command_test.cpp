// cleft body, cleft solve --mesh and cleft cut --simulate given wrong input: a clear message, exit code 2,
// and no file left, nor a temporary one.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>

#include "base/output_file.h"
#include "base/text.h"
#include "solver/body/body.h"
#include "solver/snapshot/snapshot.h"
#include "tests/bodies/subjects.h"
#include "tests/pipeline/commands.h"
#include "tests/support/damage.h"
#include "tests/support/temporary_folder.h"

namespace cleft {

namespace {

class BodyCommand : public ::testing::Test {
 protected:
  TemporaryFolder in, out, temporary;

  void SetUp() override {
    former_ = std::getenv("TMPDIR") ? std::getenv("TMPDIR") : "";
    setenv("TMPDIR", temporary.path().c_str(), 1);
    in.write("skin.obj", text_of(testing::sheet(testing::flat, 30, 30, 2)));
    path("path.csv", 0);
    in.write("case.toml", "[case]\nmesh.element_size = 2\n");
  }
  void TearDown() override {
    EXPECT_EQ(temporary.entries(), 0) << "temporary files were left behind";
    former_.empty() ? unsetenv("TMPDIR") : setenv("TMPDIR", former_.c_str(), 1);
  }

  static std::string text_of(const SurfaceMesh& mesh) {
    std::string text;
    for (const Vec3& p : mesh.points)
      text += "v " + shortest(p.x) + " " + shortest(p.y) + " " + shortest(p.z) + "\n";
    for (const auto& [a, b, c] : mesh.triangles)
      text += "f " + std::to_string(a + 1) + " " + std::to_string(b + 1) + " " + std::to_string(c + 1) + "\n";
    return text;
  }
  std::string path(const std::string& name, double z, double to_y = 0) {
    return in.write(name, "x,y,z,nx,ny,nz,depth\n-8,0," + shortest(z) + ",0,0,1,3\n8," + shortest(to_y) +
                              "," + shortest(z) + ",0,0,1,3\n");
  }
  std::string bone(double z) {
    return in.write("bone.obj", text_of(testing::sheet(
                                    [z](double x, double y) {
                                      return Vec3{x, y, z};
                                    },
                                    30, 30, 5)));
  }
  static std::vector<std::string> with(std::vector<std::string> first, const std::vector<std::string>& more) {
    first.insert(first.end(), more.begin(), more.end());
    return first;
  }
  /// Its cells in a file of text, each region of wedges a half of them.
  static std::string vtu_of(const Body& b) {
    std::string points, nodes, offsets, types, tags, regions;
    for (const Vec3& p : b.points) points += shortest(p.x) + " " + shortest(p.y) + " " + shortest(p.z) + "\n";
    std::size_t end = 0;
    const auto add = [&](const auto& cell, int type, int region) {
      for (const int n : cell) nodes += std::to_string(n) + " ";
      offsets += std::to_string(end += cell.size()) + " ", types += std::to_string(type) + " ";
      tags += "0.5 ", regions += std::to_string(region) + " ";
    };
    for (const auto& t : b.skin) add(t, 5, 1);
    for (std::size_t w = 0; w < b.wedges.size(); ++w) add(b.wedges[w], 13, w < b.wedges.size() / 2 ? 7 : 8);
    const auto array = [](const std::string& type, const std::string& name, const std::string& values) {
      return "<DataArray type='" + type + "' Name='" + name + "' format='ascii'>" + values + "</DataArray>\n";
    };
    return "<VTKFile type='UnstructuredGrid'><UnstructuredGrid><Piece NumberOfPoints='" +
           std::to_string(b.points.size()) + "' NumberOfCells='" +
           std::to_string(b.skin.size() + b.wedges.size()) +
           "'>\n<Points><DataArray type='Float64' NumberOfComponents='3' format='ascii'>" + points +
           "</DataArray></Points>\n<Cells>" + array("Int32", "connectivity", nodes) +
           array("Int32", "offsets", offsets) + array("UInt8", "types", types) + "</Cells>\n<CellData>" +
           array("Float64", "tags", tags) + array("Int32", "region", regions) +
           "</CellData></Piece></UnstructuredGrid></VTKFile>\n";
  }
  std::string body() {
    expect_success(run_cleft("body", with(options_, {"--out", in / "body.h5"})));
    return in / "body.h5";
  }

  /// By both commands that mesh a body.
  void expect_refused(const std::vector<std::string>& options, const std::vector<std::string>& parts) {
    refused("body", with(options, {"--out", out / "body.h5"}), parts);
    refused("cut", with(options, {"--simulate", "--out", out / "cut.obj"}), parts);
  }
  void refused(const std::string& command, const std::vector<std::string>& arguments,
               const std::vector<std::string>& parts) {
    const Outcome outcome = run_cleft(command, arguments);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
    for (const std::string& part : parts)
      EXPECT_NE(outcome.output.find(part), std::string::npos)
          << "missing '" << part << "' in: " << outcome.output;
    EXPECT_EQ(outcome.output.find(temporary.path()), std::string::npos) << outcome.output;
    EXPECT_EQ(out.entries(), 0) << "something was left behind";
  }
  void expect_solve_refused(const std::string& body, const std::vector<std::string>& more,
                            const std::vector<std::string>& parts) {
    refused("solve",
            with({in / "case.toml", "--mesh", body, "--out", out / "case.h5", "--no-estimate"}, more), parts);
  }

  const std::vector<std::string> plain_{"--mesh", in / "skin.obj", "--path", in / "path.csv"};
  std::vector<std::string> options_ = with(plain_, {"--case", in / "case.toml", "--reach", "10"});

 private:
  std::string former_;
};

}  // namespace

TEST_F(BodyCommand, APathOffTheSurface) {
  path("path.csv", 25);
  expect_refused(options_, {"cut", "the path never touches the mesh", "must lie within"});
}

TEST_F(BodyCommand, TensionThatCompressesTheSkin) {
  expect_refused(with(options_, {"--set", "skin.prestress_v=-0.03"}),
                 {"--set", "skin.prestress_u, _v, _uv = 0.01, -0.03, 0 MPa", "compressed"});
}

TEST_F(BodyCommand, BoneAboveTheSkin) {
  expect_refused(with(options_, {"--bone", bone(3)}),
                 {"bone lies above the skin at (", "units and places of --bone"});
}

TEST_F(BodyCommand, TissueThinnerThanTheCut) {
  expect_refused(with(plain_, {"--set", "mesh.element_size=2", "--set", "patch.height=2"}),
                 {"the cut is 3 mm deep", "patch.height = 2 mm", "shallower, or the tissue thicker"});
}

TEST_F(BodyCommand, ReachOfLessThanTwoElements) {
  options_.back() = "0.1";
  expect_refused(options_, {"--reach 0.1 mm", "mesh.element_size = 2 mm"});
}

TEST_F(BodyCommand, ElementsTooSmallForAnySolver) {
  expect_refused(with(plain_, {"--set", "mesh.element_size=0.0005"}),
                 {"mesh.element_size = 5e-04 mm", "at least 0.0032 mm"});
}

TEST_F(BodyCommand, CutsTooShortForTheElements) {
  in.write("path.csv", "x,y,z,nx,ny,nz,depth\n-0.3,0,0,0,0,1,3\n0.3,0,0,0,0,1,3\n");
  expect_refused(options_, {"too short to open a node", "mesh.element_size = 2 mm smaller"});
}

TEST_F(BodyCommand, DirectionsWithoutAPartInTheSkin) {
  expect_refused(with(options_, {"--direction", "0,0,0"}), {"--direction 0,0,0", "no length"});
  expect_refused(with(options_, {"--direction", "0,0,1"}),
                 {"(0, 0, 1)", "perpendicular to the skin", "--direction"});
}

TEST_F(BodyCommand, UnknownFilesAndParameters) {
  expect_refused(with(options_, {"--bone", in / "no.obj"}), {"no.obj"});
  expect_refused(with(options_, {"--path", in / "no.csv"}), {"no.csv"});
  expect_refused(with(options_, {"--set", "patch.hight=3"}), {"patch.hight", "patch.height"});
  expect_solve_refused(in / "no.h5", {}, {"no.h5"});
}

TEST_F(BodyCommand, OutputsThatAreInputs) {
  const std::string held = bone(-6), before = read_text_file(held);
  for (const char* command : {"body", "cut"}) {
    std::vector<std::string> options = with(options_, {"--bone", held, "--out", held});
    if (std::string(command) == "cut") options.push_back("--simulate");
    refused(command, options, {"--out", "is the input"});
    EXPECT_EQ(read_text_file(held), before);
  }
}

/// --tension and --prestress say the same of a simulation as its parameters and --direction.
TEST_F(BodyCommand, SimulationsInTheTensionThatIsGiven) {
  const auto gape = [&](const std::vector<std::string>& more) {
    const std::vector<std::string> options = with(options_, {"--simulate", "--out", out / "a.obj", "--json"});
    const nlohmann::json figures = figures_of(expect_success(run_cleft("cut", with(options, more))));
    std::filesystem::remove(out / "a.obj");
    return figures.at("simulated").at("gape_mm").get<double>();
  };
  const double usual = gape({});
  const double along = gape({"--tension", "1,0,0", "--prestress", "0.004,0.02"});
  EXPECT_DOUBLE_EQ(along, gape({"--direction", "1,0,0", "--set", "skin.prestress_u=0.02", "--set",
                                "skin.prestress_v=0.004"}));
  EXPECT_LT(along, 0.3 * usual) << "0.03 across the path";
  EXPECT_DOUBLE_EQ(gape({"--tension", "0,1,0", "--prestress", "0.03,0.01"}), usual);
  // The path's own depth, 3 mm, and that of the case where it has none.
  in.write("path.csv", "x,y,z,nx,ny,nz\n-8,0,0,0,0,1\n8,0,0,0,0,1\n");
  EXPECT_DOUBLE_EQ(gape({"--set", "cut.depth=3"}), usual);
  EXPECT_LT(gape({"--set", "cut.depth=1.5"}), 0.95 * usual);
  // Lines of another direction than the first, of which most are far away, in the mesh's units.
  const std::string lines = in.write("lines.csv",
                                     "x,y,z,dx,dy,dz\n90,90,0,0,1,0\n90,90,0,0,1,0\n90,90,0,0,1,0\n90,90,0,0,"
                                     "1,0\n0,0,0,2,0,0\n-8,0.5,0,-1,0,0\n8,0,0,1,0,0\n");
  const double of_lines = gape({"--tension-lines", lines, "--prestress", "0.004,0.02"});
  EXPECT_NEAR(of_lines, along, 0.02 * along);
  EXPECT_DOUBLE_EQ(of_lines, gape({"--direction-lines", lines, "--set", "skin.prestress_u=0.02", "--set",
                                   "skin.prestress_v=0.004"}));
  // A mesh far from the origin is cut in coordinates of its own; so are its lines.
  SurfaceMesh far = testing::sheet(testing::flat, 30, 30, 2);
  for (Vec3& p : far.points) p += Vec3{1 << 20, 0, 0};
  in.write("skin.obj", text_of(far));
  in.write("path.csv", "x,y,z,nx,ny,nz,depth\n1048568,0,0,0,0,1,3\n1048584,0,0,0,0,1,3\n");
  in.write("lines.csv",
           "x,y,z,dx,dy,dz\n1048666,90,0,0,1,0\n1048666,90,0,0,1,0\n1048666,90,0,0,1,0\n1048666,90,0,0,1,"
           "0\n1048576,0,0,2,0,0\n"
           "1048568,0.5,0,-1,0,0\n1048584,0,0,1,0,0\n");
  EXPECT_NEAR(gape({"--tension-lines", lines, "--prestress", "0.004,0.02"}), of_lines, 1e-6);
  refused("cut", with(options_, {"--simulate", "--out", out / "a.obj", "--prestress", "0.03,0.01"}),
          {"--prestress", "--tension or --tension-lines"});
  const std::vector<std::string> options = with(
      options_, {"--simulate", "--out", out / "a.obj", "--tension", "0,1,0", "--prestress", "0.03,0.01"});
  refused("cut", with(options, {"--direction", "1,0,0"}), {"--direction: is of the same tension"});
  refused("cut", with(options, {"--set", "skin.prestress_v=0.02"}),
          {"is of the same tension as --prestress"});
}

/// Coordinates along a path that comes back fold: no finer mesh helps. Its nodes are right, also between the
/// cases of a study.
TEST_F(BodyCommand, FieldsOfPathsThatComeBackSayWhyTheyAreOffAndAreRightAtNodes) {
  std::string text = "x,y,z,nx,ny,nz,depth\n";
  constexpr int pieces = 24;
  constexpr double radius = 7;
  for (int i = 0; i <= pieces; ++i) {
    const double angle = std::numbers::pi * i / pieces;
    text += shortest(-radius * std::cos(angle)) + "," + shortest(radius * std::sin(angle)) + ",0,0,0,1,3\n";
  }
  in.write("path.csv", text);
  const std::string series = out / "case.h5";
  expect_success(run_cleft("solve", {in / "case.toml", "--mesh", body(), "--out", series, "--no-estimate"}));
  const Outcome encoded = run_cleft("encode", {series, "--out", out / "case.dffd"});
  expect_success(encoded);
  EXPECT_NE(encoded.output.find("the path of the cut turns by 1"), std::string::npos) << encoded.output;
  EXPECT_NE(encoded.output.find("most tightly on a radius of "), std::string::npos) << encoded.output;
  EXPECT_NE(encoded.output.find("cleft cut --simulate"), std::string::npos) << encoded.output;

  in.write("study.toml",
           "name = \"winding\"\n[body]\nfile = \"body.h5\"\n[vary]\n"
           "\"tissue.young_modulus\" = [0.014, 0.017, 0.024, 0.028]\n");
  expect_success(run_cleft("run", {in / "study.toml", "--out", out / "study"}));
  expect_success(run_cleft(
      "interpolate", {out / "study", "--set", "tissue.young_modulus=0.02", "--out", out / "between.dffd"}));
  const SnapshotReader reader(series);
  const std::size_t last = reader.snapshot().frames() - 1;
  const std::vector<Vec3> simulated = reader.displacement(last);
  double largest = 0;
  for (const Vec3& d : simulated) largest = std::max(largest, norm(d));
  for (const auto& [field, most] : {std::pair{"case.dffd", 0.01}, {"between.dffd", 0.02}}) {
    expect_success(run_cleft("eval", {out / field, "--nodes", series, "--frame", std::to_string(last),
                                      "--out", out / "nodes.csv"}));
    const NumberTable table = read_csv(out / "nodes.csv");
    ASSERT_EQ(table.rows.size(), simulated.size());
    for (std::size_t n = 0; n < simulated.size(); ++n) {
      const auto& row = table.rows[n];
      ASSERT_LE(norm(Vec3{row[0], row[1], row[2]} - simulated[n]), most * largest) << field << ", node " << n;
    }
  }
}

TEST_F(BodyCommand, SimulationsOfWhatIsNotSimulated) {
  refused("cut", {"--mesh", in / "skin.vtu", "--path", in / "path.csv", "--simulate", "--out", out / "a.vtu"},
          {"a mesh of volume is not simulated yet"});
  refused("cut",
          {"--mesh", in / "skin.obj", "--path", in / "path.csv", "--rest", "--reach", "10", "--out",
           out / "a.obj"},
          {"--reach: is for --simulate"});
  for (const auto& [assignment, message] : {std::pair{"skin.edges=free", "skin.edges = free: a body"},
                                            {"skin.prestress_v=-0.01", "compressed"}}) {
    refused("cut", with(options_, {"--set", assignment, "--simulate", "--out", out / "a.obj"}), {message});
    expect_solve_refused(body(), {"--set", assignment}, {message});
  }
}

TEST_F(BodyCommand, DamagedBodies) {
  const std::string good = body();
  const auto spoilt = [&](const std::function<void(Body&)>& spoil) {
    Body b = read_body(good);
    spoil(b);
    write_body(in / "spoilt.h5", b);
    return in / "spoilt.h5";
  };
  expect_solve_refused(spoilt([](Body& b) { b.pairs[3].left = 99999999; }), {},
                       {"spoilt.h5", "/cut/pairs, row 3"});
  expect_solve_refused(spoilt([](Body& b) { b.tension[5] = {}; }), {}, {"/skin/tension, row 5"});
  expect_solve_refused(spoilt([](Body& b) { b.tension[5].x = std::nan(""); }), {}, {"/skin/tension, row 5"});
  expect_solve_refused(spoilt([](Body& b) { b.canonical[7].y = std::nan(""); }), {}, {"node 7"});
  expect_solve_refused(spoilt([](Body& b) { std::swap(b.wedges[2][0], b.wedges[2][1]); }), {},
                       {"wedge 2", "inside out"});
  std::string bytes = read_text_file(good);
  write_text_file(in / "short.h5", bytes.substr(0, bytes.size() / 2));
  expect_solve_refused(in / "short.h5", {}, {"short.h5", "damaged"});
  expect_solve_refused(in / "skin.obj", {}, {"skin.obj", "make one of it: cleft body --mesh"});
  // A number that is as good as another one: only a checksum tells.
  const double x = read_body(good).points[77].x;
  const auto at = bytes.find(std::string(reinterpret_cast<const char*>(&x), sizeof x));
  ASSERT_NE(at, std::string::npos);
  bytes[at] ^= 1;
  write_text_file(in / "flipped.h5", bytes);
  expect_solve_refused(in / "flipped.h5", {}, {"flipped.h5", "/VTKHDF/Points is damaged"});
}

/// A volume mesh with regions, from a file: what it becomes, and what is refused.
TEST_F(BodyCommand, AMeshOfOnesOwn) {
  const Body made = read_body(body());
  in.write("own.vtu", vtu_of(made));
  in.write("materials.toml",
           "[fat]\nregion = 7\nyoung_modulus = 0.01\n[deep]\nregion = 8\n[faces]\nskin = 1\n");
  const std::vector<std::string> own = {"--mesh",        in / "own.vtu", "--path",
                                        in / "path.csv", "--case",       in / "case.toml"};
  const auto expect_own_refused = [&](const std::vector<std::string>& more,
                                      const std::vector<std::string>& parts) {
    refused("body", with(with(own, more), {"--out", out / "body.h5"}), parts);
  };
  expect_success(run_cleft("body", with(own, {"--out", in / "plain.h5"})));
  EXPECT_EQ(read_body(in / "plain.h5").pairs.size(), made.pairs.size());
  expect_success(
      run_cleft("body", with(own, {"--materials", in / "materials.toml", "--out", in / "own.h5"})));
  const Body with_regions = read_body(in / "own.h5");
  ASSERT_EQ(with_regions.materials.size(), 2U);
  EXPECT_EQ(with_regions.materials[0], (RegionMaterial{"fat", 0.01, {}}));
  EXPECT_EQ(std::count(with_regions.region.begin(), with_regions.region.end(), 0),
            static_cast<long>(made.wedges.size() / 2));

  expect_own_refused({"--regions", "materials"},
                     {"has no array 'materials'", "its arrays are: tags, region"});
  expect_own_refused({"--release", "when"}, {"has no array 'when' of one number for each point"});
  expect_own_refused({"--regions", "tags"}, {"array 'tags', cell 0: a region is a whole number"});
  expect_own_refused({"--bone", bone(-6)}, {"--bone", "[faces]"});
  expect_own_refused({"--depth", "3"}, {"--depth", "its walls"});
  expect_own_refused({"--reach", "20"}, {"--reach", "leave it out"});
  in.write("materials.toml", "[fat]\nregion = 7\n[skin]\nregion = 1\n");
  expect_own_refused({"--materials", in / "materials.toml"},
                     {"own.vtu: region 8 of 'region'", "has no material; add region = 8"});
  in.write("own.vtu", vtu_of(made).substr(0, 5000));
  expect_own_refused({}, {"own.vtu: cannot be read as a mesh of cells"});
  refused("body", with(options_, {"--release", "when", "--out", out / "body.h5"}), {"--release", "own mesh"});
}

/// Layers of different tissue, and what is wrong with some.
TEST_F(BodyCommand, LayersBelowASurface) {
  const auto materials = [&](const std::string& text) {
    in.write("layers.toml", text);
    return std::vector<std::string>{"--materials", in / "layers.toml", "--out", out / "body.h5"};
  };
  for (const auto& [text, part] :
       {std::pair{"[fat]\nto_depth = 3\n", "the last one"},
        {"[fat]\n[muscle]\n", "needs to_depth"},
        {"[fat]\nto_depth = 3\n[fascia]\nto_depth = 2\n[muscle]\n", "from the skin down"},
        {"[fat]\nto_depth = 30\n[muscle]\n", "patch.height = 8 mm"},
        {"[fat]\nregion = 2\n", "below a surface say to_depth"}})
    refused("body", with(options_, materials(text)), {part});
}

/// Ctrl-C, while the solver runs: nothing is left.
TEST_F(BodyCommand, IsStoppedBySignals) {
  for (const char* signal : {"INT", "TERM"}) {
    const Outcome outcome =
        in_shell("timeout -s " + std::string(signal) + " 1 " + CLEFT_BIN + "/cleft-cut --mesh '" +
                 (in / "skin.obj") + "' --path '" + (in / "path.csv") +
                 "' --simulate --set mesh.element_size=0.35 --out '" + (out / "cut.obj") + "' 2>&1");
    EXPECT_NE(outcome.output.find("stopped"), std::string::npos) << outcome.output;
    EXPECT_EQ(out.entries(), 0);
    EXPECT_EQ(temporary.entries(), 0);
  }
}

}  // namespace cleft
