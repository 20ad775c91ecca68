// From a case file to a cut mesh, through the commands and the files.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "base/text.h"
#include "encoder/field/file/field_file.h"
#include "explorer/io/mesh_file.h"
#include "solver/snapshot/snapshot.h"
#include "tests/pipeline/commands.h"
#include "tests/pipeline/cut_file.h"
#include "tests/support/temporary_folder.h"
#include "tradeoff/replays/uncut_skin.h"

namespace cleft {

namespace {

constexpr const char* coarse_case = R"(
[case]
patch.length = 24
patch.width = 16
patch.height = 5
cut.length = 12
cut.depth = 2
mesh.element_size = 1
mesh.grading = 1
mesh.front = "nodes"
)";

/// A solved and encoded case, made once for all tests of this file.
class EndToEnd : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder = new TemporaryFolder;
    folder->write("case.toml", coarse_case);
    expect_success(
        run_cleft("solve", {*folder / "case.toml", "--out", *folder / "case.h5", "--no-estimate"}));
    expect_success(run_cleft(
        "encode", {*folder / "case.h5", "--out", *folder / "case.dffd", "--control-points", "18,14,8,9"}));
  }
  static void TearDownTestSuite() { delete folder; }
  static TemporaryFolder* folder;
};
TemporaryFolder* EndToEnd::folder = nullptr;

/// A path straight along the canonical cut.
std::string canonical_path(const Snapshot& s) {
  std::string text = "x,y,z,nx,ny,nz\n";
  for (int i = 0; i <= 12; ++i) text += shortest(s.cut_start + s.cut_length * i / 12) + ",0,0,0,0,1\n";
  return text;
}

}  // namespace

TEST_F(EndToEnd, AFieldFeelsAsStiffAsItsSimulation) {
  // A force that differs by less than 7 % feels the same (haptic/force_parameters.h).
  folder->write("still.csv", "time,x,y,z,ax,ay,az,ex,ey,ez,cutting,present\n0.01,0,0,9,0,0,1,1,0,0,0,1\n");
  write_mesh(*folder / "sheet.stl", {{{0, 0, 0}, {90, 0, 0}, {0, 90, 0}}, {{0, 1, 2}}});
  double stiffness[2];
  for (const bool field : {false, true}) {
    const Outcome felt = expect_success(run_cleft(
        "haptic",
        {"--mesh", *folder / "sheet.stl", "--device", "recorded", "--trajectory", *folder / "still.csv",
         "--json", field ? "--field" : "--snapshot", *folder / (field ? "case.dffd" : "case.h5")}));
    stiffness[field] = nlohmann::json::parse(felt.output)["stiffness_N_per_mm"];
  }
  EXPECT_NEAR(stiffness[1] / stiffness[0], 1, 0.07) << stiffness[0] << " N/mm in the simulation";
  Field other = read_field(*folder / "case.dffd");
  other.case_hash = "00000000000000aa";
  write_field(*folder / "other.dffd", other);
  const Outcome refused = run_cleft("haptic", {"--mesh", *folder / "sheet.stl", "--device", "recorded",
                                               "--trajectory", *folder / "still.csv", "--field",
                                               *folder / "other.dffd", "--snapshot", *folder / "case.h5"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.output.find("--field is of case 00000000000000aa"), std::string::npos) << refused.output;
}

TEST_F(EndToEnd, ACutFlatSkinFollowsTheFiniteElementsAtEveryFrame) {
  const SnapshotReader reader(*folder / "case.h5");
  const Snapshot& s = reader.snapshot();
  const FitReport report = read_field(*folder / "case.dffd").report;
  ASSERT_LT(report.spline_error, 0.05) << "a field this bad proves nothing";
  const auto [skin, node_of] = uncut_skin(s);
  write_mesh(*folder / "skin.vtp", skin, {});
  folder->write("path.csv", canonical_path(s));
  std::map<int, int> right_of;
  for (const auto& [left, right] : s.pairs) right_of[left] = right;
  std::map<std::pair<double, double>, int> nodes_at;
  for (const int node : node_of) nodes_at[{s.points[node].x, s.points[node].y}] = node;

  // Replaying contracts the field to histories, which may add a tenth.
  const double bound = 1.1 * report.spline_error * report.largest_displacement * (1 + 1e-9);
  const auto closed = reader.displacement(0);
  for (std::size_t j = 1; j < s.frames(); ++j) {
    expect_success(run_cleft("cut", {"--mesh", *folder / "skin.vtp", "--path", *folder / "path.csv",
                                     "--field", *folder / "case.dffd", "--progress", shortest(s.times[j]),
                                     "--max-edge", "0", "--out", *folder / "cut.vtp"}));
    const CutFile cut = read_cut(*folder / "cut.vtp");
    const auto frame = reader.displacement(j);
    int open = 0;
    std::size_t skin_vertices = 0;
    for (std::size_t i = 0; i < cut.rest.size(); ++i) {
      if (cut.depth[i] > 0) continue;  // walls
      ++skin_vertices;
      const auto place = nodes_at.find({cut.rest[i].x, cut.rest[i].y});
      ASSERT_NE(place, nodes_at.end())
          << "a vertex that is no node at " << cut.rest[i].x << ", " << cut.rest[i].y;
      int node = place->second;
      if (const auto pair = right_of.find(node); pair != right_of.end() && s.points[node].x < s.position[j]) {
        if (cut.side[i] > 0) node = pair->second;
        ++open;
      }
      const double error = norm(cut.displacement[i] - (frame[node] - closed[node]));
      EXPECT_LE(error, bound) << "frame " << j << " at " << cut.rest[i].x << ", " << cut.rest[i].y;
    }
    // Each open column shows both of its nodes, and nothing else was added to the skin.
    EXPECT_EQ(open, 2 * static_cast<int>(j)) << "frame " << j;
    EXPECT_EQ(skin_vertices, node_of.size() + j) << "frame " << j;
  }
}

TEST_F(EndToEnd, EvalAgreesWithTheSnapshotAtItsNodes) {
  const SnapshotReader reader(*folder / "case.h5");
  const Snapshot& s = reader.snapshot();
  const FitReport report = read_field(*folder / "case.dffd").report;
  std::string points = "u,v,w,side,t\n";
  std::vector<Vec3> expected;
  const std::size_t j = s.frames() - 1;
  const auto closed = reader.displacement(0), open = reader.displacement(j);
  for (std::size_t p = 0; p < s.pairs.size(); ++p)
    for (const int side : {0, 1}) {
      const int node = s.pairs[p][side];
      points += shortest(s.points[node].x) + ",0," + shortest(s.points[node].z) + "," +
                (side ? "1," : "-1,") + shortest(s.times[j]) + "\n";
      expected.push_back(open[node] - closed[node]);
    }
  expect_success(run_cleft("eval", {*folder / "case.dffd", "--points", folder->write("points.csv", points),
                                    "--out", *folder / "d.csv"}));
  const NumberTable table = read_csv(*folder / "d.csv");
  ASSERT_EQ(table.rows.size(), expected.size());
  double largest = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_LE(norm(Vec3{table.rows[i][0], table.rows[i][1], table.rows[i][2]} - expected[i]),
              report.spline_error * report.largest_displacement * (1 + 1e-9));
    largest = std::max(largest, norm(expected[i]));
  }
  EXPECT_GT(largest, 0.5 * report.largest_displacement) << "the lips must move for this to mean anything";
}

TEST_F(EndToEnd, EveryNodeIsWithinTheToleranceInEveryFrame) {
  constexpr double tolerance = 1e-4;
  const std::string field = *folder / "fine.dffd";
  expect_success(
      run_cleft("encode", {*folder / "case.h5", "--out", field, "--tolerance", shortest(tolerance)}));
  EXPECT_TRUE(read_residual(field)) << "a tolerance that the spline keeps alone proves less";
  const SnapshotReader reader(*folder / "case.h5");
  const Snapshot& s = reader.snapshot();
  const auto closed = reader.displacement(0);
  double largest = 0, worst = 0;
  for (std::size_t j = 0; j < s.frames(); ++j) {
    expect_success(run_cleft("eval", {field, "--nodes", *folder / "case.h5", "--frame", std::to_string(j),
                                      "--out", *folder / "nodes.csv"}));
    const NumberTable table = read_csv(*folder / "nodes.csv");
    const auto open = reader.displacement(j);
    ASSERT_EQ(table.rows.size(), open.size());
    for (std::size_t n = 0; n < open.size(); ++n) {
      const Vec3 d = open[n] - closed[n];
      largest = std::max(largest, norm(d));
      worst = std::max(worst, norm(Vec3{table.rows[n][0], table.rows[n][1], table.rows[n][2]} - d));
    }
  }
  EXPECT_LE(worst, tolerance * largest * (1 + 1e-9));
  EXPECT_NEAR(worst / largest, read_field(field).report.node_error, 1e-9);
}

TEST_F(EndToEnd, SeveralSnapshotsAreEncodedAsEachAlone) {
  const std::string first = *folder / "case.h5", second = *folder / "pulled.h5", both = *folder / "both";
  expect_success(run_cleft(
      "solve", {*folder / "case.toml", "--set", "skin.prestress_v=0.05", "--no-estimate", "--out", second}));
  std::filesystem::create_directory(both);
  const Outcome encoded = run_cleft("encode", {first, second, "--out", both, "--json"});
  expect_success(encoded);
  const std::string alone = *folder / "alone.dffd";
  for (const std::string& snapshot : {first, second}) {
    const std::string field = both + "/" + std::filesystem::path(snapshot).stem().string().append(".dffd");
    EXPECT_NE(encoded.output.find(field), std::string::npos);
    expect_success(run_cleft("encode", {snapshot, "--out", alone}));
    EXPECT_EQ(read_field(field).coefficients(), read_field(alone).coefficients());
  }
  const Outcome twice = run_cleft("encode", {first, first, "--out", both});
  EXPECT_EQ(twice.exit_code, 2);
  EXPECT_NE(twice.output.find("another snapshot is called case.dffd too"), std::string::npos) << twice.output;
  const Outcome nowhere = run_cleft("encode", {first, second, "--out", *folder / "absent"});
  EXPECT_EQ(nowhere.exit_code, 2);
  EXPECT_NE(nowhere.output.find("must be a folder that exists, for 2 snapshots"), std::string::npos);
}

TEST_F(EndToEnd, OneAndTwoRanksGiveTheSameSnapshot) {
  expect_success(cleft_on_ranks("solve", 2, {*folder / "case.toml", "--out", *folder / "two.h5"}));
  const SnapshotReader one(*folder / "case.h5"), two(*folder / "two.h5");
  EXPECT_EQ(one.snapshot().points, two.snapshot().points);
  EXPECT_EQ(one.snapshot().connectivity, two.snapshot().connectivity);
  EXPECT_EQ(one.snapshot().pairs, two.snapshot().pairs);
  for (std::size_t j = 0; j < one.snapshot().frames(); ++j) {
    const auto a = one.displacement(j), b = two.displacement(j);
    double difference = 0, size = 0;
    for (std::size_t n = 0; n < a.size(); ++n)
      difference += squared_norm(a[n] - b[n]), size += squared_norm(a[n]);
    EXPECT_LE(std::sqrt(difference), 1e-9 * std::sqrt(size)) << "frame " << j;
    EXPECT_EQ(size > 0, j > 0) << "frame " << j;
  }
}

TEST_F(EndToEnd, InfoAndCheckSpeakOfTheFiles) {
  const std::string text = expect_success(run_cleft("info", {*folder / "case.dffd", "--json"})).output;
  EXPECT_NE(text.find("\"tissue.young_modulus\": 0.02"), std::string::npos) << text;
  const auto field = nlohmann::json::parse(text),
             snapshot = nlohmann::json::parse(
                 expect_success(run_cleft("info", {*folder / "case.h5", "--json"})).output);
  EXPECT_DOUBLE_EQ(field["ratio_to_32_bit"].get<double>(), 12. * snapshot["nodes"].get<double>() *
                                                               snapshot["frames"].get<double>() /
                                                               field["bytes"].get<double>());
  expect_success(run_cleft("info", {*folder / "case.h5"}));
  expect_success(run_cleft("check", {*folder / "case.h5", *folder / "case.dffd"}));
}

TEST_F(EndToEnd, ExploreDrawsAPicture) {
  expect_success(run_cleft(
      "explore", {*folder / "case.dffd", "--screenshot", *folder / "patch.png", "--size", "320,200"}));
  EXPECT_EQ(read_text_file(*folder / "patch.png").substr(1, 3), "PNG");
}

}  // namespace cleft
