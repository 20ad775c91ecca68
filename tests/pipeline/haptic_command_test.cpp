// cleft haptic as a user runs it: the simulated hand cuts a sheet in real time, and what it did plays again.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "base/text.h"
#include "encoder/field/file/field_file.h"
#include "explorer/io/mesh_file.h"
#include "explorer/session/command_table.h"
#include "haptic/devices/list.h"
#include "haptic/devices/mouse.h"
#include "haptic/surface_stiffness.h"
#include "tests/incision/meshes.h"
#include "tests/pipeline/commands.h"
#include "tests/support/recorded.h"
#include "tests/support/temporary_folder.h"
#include "tests/wound/fields.h"

namespace cleft {

namespace {

class HapticCommand : public ::testing::Test {
 protected:
  HapticCommand()
      : mesh(in / "sheet.stl"),
        path(in.write("path.csv", "x,y,z,nx,ny,nz\n-10,0.3,0,0,0,1\n10,0.1,0,0,0,1\n")) {
    write_mesh(mesh, testing::grid(30, 20, -30, -20, 2));
  }
  /// They come after the warnings.
  static nlohmann::json figures_in(const Outcome& outcome) {
    return nlohmann::json::parse(
        outcome.output.substr(std::min(outcome.output.size(), outcome.output.find('{'))), nullptr, false);
  }
  nlohmann::json figures(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"--mesh", mesh, "--json"});
    return figures_in(expect_success(run_cleft("haptic", arguments)));
  }
  void expect_refused(std::vector<std::string> arguments, const std::string& part) {
    arguments.insert(arguments.begin(), {"--mesh", mesh});
    const Outcome outcome = run_cleft("haptic", arguments);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
    EXPECT_NE(outcome.output.find(part), std::string::npos)
        << "missing '" << part << "' in: " << outcome.output;
  }
  static long told(const nlohmann::json& figures, const std::string& what) {
    const auto& warnings = figures["warnings"];
    return std::count_if(warnings.begin(), warnings.end(),
                         [&](const std::string& warning) { return warning.find(what) != std::string::npos; });
  }
  std::string field(std::map<std::string, double> more = {}) {
    Field opening = testing::opening_field({-10, 20, 4}, 40, 30, 8, 4);
    more.insert({{"tissue.young_modulus", 0.05}, {"tissue.poisson_ratio", 0.5}});
    opening.parameters = recorded(more);
    write_field(in / "case.dffd", opening);
    return in / "case.dffd";
  }
  /// Poses of two straight cuts, 12 mm and 8 mm long; between them the blade is out.
  std::string two_cuts(double apart, double depth = 5) {
    std::string poses = "time,x,y,z,ax,ay,az,ex,ey,ez,cutting,present\n";
    double time = 0;
    const auto go = [&](double x0, double z0, double x1, double z1, double y, int ticks) {
      for (int k = 1; k <= ticks; ++k) {
        time += 1e-3;
        const double part = double(k) / ticks;
        for (const double value : {time, x0 + part * (x1 - x0), y, z0 + part * (z1 - z0)})
          poses += shortest(value) + ",";
        poses += "0,0,1,1,0,0,1,1\n";
      }
    };
    for (const double y : {-5.3, apart - 5.3}) {
      const double length = y == -5.3 ? 12 : 8;
      go(-6, 3, -6, -depth, y, 300);
      go(-6, -depth, -6 + length, -depth, y, 600);
      go(-6 + length, -depth, -6 + length, 4, y, 300);
    }
    return in.write("poses.csv", poses);
  }
  TemporaryFolder in, out;
  std::string mesh, path;
};

TEST_F(HapticCommand, TheHandCutsAndItsRecordingPlays) {
  const std::string recording = out / "run.csv";
  const auto cut = figures({"--path", path, "--depth", "4", "--speed", "40", "--record", recording});
  ASSERT_TRUE(cut.is_object());
  EXPECT_EQ(cut["punctures"], 1);
  EXPECT_GE(cut["largest_force_N"], 0.3);
  EXPECT_LE(cut["largest_force_N"], 1.2);
  EXPECT_LE(cut["change_beyond_permitted_N"], 0);
  EXPECT_GT(cut["energy_put_in_Nmm"], 0);
  EXPECT_GT(cut["triangles_cut"], 100);
  EXPECT_GT(cut["cut_mm"], 15);
  EXPECT_LE(cut["cut_mm"], 20.1);
  EXPECT_EQ(cut["stopped"], "");
  for (const char* what : {"compute_us", "lateness_us", "bare_timer_compute_us", "bare_timer_lateness_us"})
    for (const char* quantile : {"p50", "p99", "p99.9", "max"})
      EXPECT_GT(cut[what][quantile], 0) << what << quantile;
  EXPECT_EQ(cut["page_faults"], 0) << "of the haptic thread while another one cuts";
  const NumberTable poses = read_csv(recording);
  EXPECT_EQ(poses.rows.size(), cut["ticks"]);
  const auto again =
      figures({"--path", path, "--depth", "4", "--device", "recorded", "--trajectory", recording});
  EXPECT_EQ(again["punctures"], 1);
  EXPECT_GT(again["cut_mm"], 15);
}

TEST_F(HapticCommand, ByTheVirtualClockARecordingCutsTheSameAlways) {
  const std::string recording = out / "run.csv";
  const std::vector<std::string> hand = {"--path",  path, "--field", field(),
                                         "--speed", "40", "--clock", "virtual"};
  const auto with = [&](std::vector<std::string> arguments, const std::vector<std::string>& more) {
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  };
  const auto first = figures(with(hand, {"--out", out / "first.vtp", "--record", recording}));
  ASSERT_TRUE(first.is_object());
  EXPECT_EQ(first["cuts"], 1);
  EXPECT_GT(first["cut_mm"], 15);
  EXPECT_FALSE(first.contains("compute_us")) << "times are the machine's";
  EXPECT_EQ(figures(with(hand, {"--out", out / "again.vtp"})), first);
  const std::string mesh_then = read_text_file(out / "first.vtp");
  EXPECT_EQ(read_text_file(out / "again.vtp"), mesh_then);
  auto played = figures({"--path", path, "--field", field(), "--clock", "virtual", "--device", "recorded",
                         "--trajectory", recording, "--out", out / "played.vtp"});
  EXPECT_EQ(read_text_file(out / "played.vtp"), mesh_then)
      << "the recorded poses and forces are those of the hand";
  EXPECT_EQ(played, first);
}

TEST_F(HapticCommand, InterruptedItReportsAndKeepsItsRecording) {
  const std::string recording = out / "run.csv", progress = out / "progress";
  const std::string command = std::string(CLEFT_BIN) + "/cleft-haptic --mesh " + mesh + " --path " + path +
                              " --depth 4 --speed 1 --json --record " + recording + " --out " +
                              out / "cut.obj";
  const Outcome outcome = in_shell("CLEFT_PROGRESS=" + progress + " " + command + " & until [ -s " +
                                   progress + " ]; do sleep 0.1; done; sleep 0.3; kill -INT $!; wait $!");
  const auto report = figures_in(expect_success(outcome));
  ASSERT_TRUE(report.is_object()) << outcome.output;
  EXPECT_LT(report["seconds"], 15) << "of 20";
  EXPECT_EQ(read_csv(recording).rows.size(), report["ticks"]);
  EXPECT_TRUE(std::filesystem::exists(out / "cut.obj"));
}

TEST_F(HapticCommand, ABladeThatNeverEntersMakesNoCut) {
  const std::string above =
      in.write("above.csv",
               "time,x,y,z,ax,ay,az,ex,ey,ez,cutting,present\n0.01,-8,0.2,5,0,0,1,1,0,0,1,1\n"
               "0.3,8,0.2,5,0,0,1,1,0,0,1,1\n");
  const auto cut = figures(
      {"--path", path, "--depth", "4", "--device", "recorded", "--trajectory", above, "--clock", "virtual"});
  EXPECT_EQ(cut["punctures"], 0);
  EXPECT_EQ(cut["cuts"], 0);
  EXPECT_EQ(cut["cut_mm"], 0);
}

TEST_F(HapticCommand, WithoutAPathItCutsWhereTheBladeGoes) {
  const auto cut = figures(
      {"--clock", "virtual", "--device", "recorded", "--trajectory", two_cuts(24), "--field", field()});
  ASSERT_TRUE(cut.is_object());
  EXPECT_EQ(cut["punctures"], 2);
  EXPECT_EQ(cut["cuts"], 2);
  EXPECT_EQ(cut["stopped"], "");
  EXPECT_LE(cut["cut_mm"], 20);
  EXPECT_GE(cut["cut_mm"], 16.5) << "at each end a piece of 0.7 mm and what the scalpel goes in a frame";
  EXPECT_EQ(told(cut, "another cut"), 0) << "24 mm apart: more than the field's cut\n" << cut["warnings"];
}

TEST_F(HapticCommand, CutsWithoutAPathAreJudgedToo) {
  const auto warned = [this](double apart) {  // by a field that does not tell the tension
    const auto cut = figures(
        {"--clock", "virtual", "--device", "recorded", "--trajectory", two_cuts(apart), "--field", field()});
    EXPECT_EQ(cut["cuts"], 2);
    return told(cut, "its opening may be off by");
  };
  EXPECT_EQ(warned(1), 2);  // lips are held back between them, which also meet
  EXPECT_EQ(warned(3), 0);  // as two paths that are known, so far apart
}

TEST_F(HapticCommand, EachCutIsFeltAsTheTissueBelowItIs) {
  // The second cut is above a plate of bone, 4 mm below, whose edge is 10 mm from the first one.
  const std::string bone = in / "bone.stl";
  SurfaceMesh plate = testing::grid(30, 7, -30, 4, 2);
  for (Vec3& p : plate.points) p.z = -4;
  write_mesh(bone, plate);
  const std::string opening = field(testing::skin_on_springs());
  Field above = read_field(opening);
  const double soft = surface_stiffness(above);
  above.tissue = TissueBelow{{{0.02, 0.4, 4}}, 1000 * 0.02 / 8};
  const double firm = surface_stiffness(above);
  ASSERT_GT(firm, 1.3 * soft);
  const std::vector<std::string> blade = {"--clock",      "virtual",        "--device", "recorded",
                                          "--trajectory", two_cuts(12, 10), "--field",  opening};
  const auto with = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), blade.begin(), blade.end());
    const auto told = figures(arguments);
    EXPECT_EQ(told["cuts"], 2);
    EXPECT_LE(told["change_beyond_permitted_N"], 0);
    return std::array{told["softest_puncture_N_per_mm"].get<double>(),
                      told["firmest_puncture_N_per_mm"].get<double>()};
  };
  const auto [softest, firmest] = with({"--bone", bone});
  EXPECT_NEAR(softest, soft, 1e-3 * soft);
  EXPECT_NEAR(firmest, firm, 3e-3 * firm);
  EXPECT_NEAR(with({})[1], soft, 1e-9);
  EXPECT_NEAR(with({"--bone", bone, "--stiffness", "0.1"})[1], 0.1, 1e-9) << "it holds everywhere";
}

TEST_F(HapticCommand, AlongAPathItWarnsAsCutDoes) {
  // A circle's arc of 4 mm and a blade tilted by 50 degrees along it.
  std::string bend = "x,y,z,nx,ny,nz\n";
  for (int k = 0; k <= 40; ++k) {
    const double a = 4. * k / 40, tilt = 50 * 3.14159265 / 180;
    for (const double value : {4 * std::sin(a), 4 - 4 * std::cos(a), 0., std::sin(a) * std::sin(tilt),
                               -std::cos(a) * std::sin(tilt)})
      bend += shortest(value) + ",";
    bend += shortest(std::cos(tilt)) + "\n";
  }
  const std::string curved = in.write("bend.csv", bend);
  const Outcome made = expect_success(run_cleft(
      "cut", {"--mesh", mesh, "--path", curved, "--field", field(), "--out", out / "cut.vtp", "--json"}));
  const auto cut = figures_in(made)["warnings"];
  ASSERT_EQ(cut.size(), 1);
  EXPECT_NE(cut[0].get<std::string>().find("its opening may be off by"), std::string::npos) << cut;
  EXPECT_EQ(figures({"--path", curved, "--field", field(), "--clock", "virtual"})["warnings"], cut);
}

TEST_F(HapticCommand, AFieldOpensTheWound) {
  const auto left_by = [&](const std::vector<std::string>& depth, const std::string& mesh_file) {
    std::vector<std::string> arguments = {"--path",  path,      "--speed", "40",
                                          "--clock", "virtual", "--out",   mesh_file};
    arguments.insert(arguments.end(), depth.begin(), depth.end());
    return figures(arguments);
  };
  const auto cut = left_by({"--field", field()}, out / "opened.obj");
  ASSERT_TRUE(cut.is_object());
  left_by({"--depth", "4"}, out / "closed.obj");
  EXPECT_NE(read_text_file(out / "opened.obj"), read_text_file(out / "closed.obj"));
  // Uniform pressure p on a disc of radius a sinks a half space by 2 p a (1 - nu^2) / E in its middle: K = pi
  // a^2 p over that.
  EXPECT_NEAR(cut["stiffness_N_per_mm"], 3.14159265 * 2 * 0.05 / (2 * 0.75), 1e-6);
  EXPECT_GT(cut["cut_mm"], 15);
}

TEST_F(HapticCommand, RefusesWhatItCannotDo) {
  setenv("SPNAV_SOCKET", (in / "nobody.sock").c_str(), 1);
  expect_refused({"--path", path}, "give --depth");
  expect_refused({}, "give --path");
  expect_refused({"--path", path, "--depth", "4", "--device", "hamd"}, "did you mean 'hand'");
  expect_refused({"--device", "recorded"}, "give --trajectory");
  expect_refused({"--device", "recorded", "--trajectory", in / "absent.csv"}, "absent.csv");
  expect_refused({"--device", "spacemouse"}, "install the package spacenavd");
  expect_refused({"--device", "phantom"}, "install OpenHaptics");
  expect_refused({"--path", path, "--depth", "4", "--rate", "20"}, "100 to 10000 Hz");
  expect_refused({"--path", path, "--depth", "4", "--delay", "99"}, "a delay of 99 ms");
  expect_refused({"--path", path, "--depth", "4", "--record", path}, "path.csv");
  expect_refused({"--path", path, "--depth", "4", "--out", out / "cut.vtu"}, ".vtu");
  expect_refused({"--path", path, "--depth", "4", "--clock", "virtual", "--real-time"}, "--real-time");
  expect_refused({"--device", "spacemouse", "--clock", "virtual"}, "--clock virtual");
  expect_refused(
      {"--path", in.write("far.csv", "x,y,z,nx,ny,nz\n0,900,0,0,0,1\n9,900,0,0,0,1\n"), "--depth", "4"},
      "never touches the mesh");
  EXPECT_EQ(out.entries(), 0);
}

TEST_F(HapticCommand, DevicesAndPlugInsAreListed) {
  const Outcome outcome = expect_success(run_cleft("haptic", {"--list-devices"}));
  const std::string help = run_cleft("haptic", {"--help"}).output, sheet = help_sheet();
  EXPECT_NE(help.find(device_choices(false)), std::string::npos) << help;
  EXPECT_NE(sheet.find(device_usages()), std::string::npos) << sheet;
  for (const DeviceKind& kind : built_in_devices()) {
    EXPECT_NE(outcome.output.find(kind.name + " "), std::string::npos) << kind.name;
    EXPECT_NE(outcome.output.find(kind.help), std::string::npos) << kind.name;
  }
  setenv("CLEFT_DEVICES", (in / "").c_str(), 1);
  const std::string torn = in.write("torn.so", "no library");
  EXPECT_NE(expect_success(run_cleft("haptic", {"--list-devices"})).output.find(torn + " cannot be loaded"),
            std::string::npos);
  expect_refused({"--device", "torn"}, "torn.so cannot be loaded");
  expect_refused({"--device", mouse_device().name}, "it needs the window");
  unsetenv("CLEFT_DEVICES");
}

}  // namespace

}  // namespace cleft
