// Fronts against brute force, and the command on a real study.
#include "tradeoff/chart.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <random>

#include "base/text.h"
#include "tests/pipeline/commands.h"
#include "tests/support/small_study.h"
#include "tests/support/temporary_folder.h"

namespace cleft {

namespace {

TEST(Chart, FrontHoldsThosePointsThatNoOtherBeats) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> value(1, 12);  // with many ties
  for (int trial = 0; trial < 200; ++trial) {
    Chart chart{"name", "", "", ""};
    for (int i = 0; i < 15; ++i)
      chart.points.push_back(
          {"s", "", static_cast<double>(value(random)), static_cast<double>(value(random))});
    const auto& p = chart.points;
    std::vector<bool> on_front(p.size());
    for (const std::size_t i : pareto_front(chart)) on_front[i] = true;
    for (std::size_t i = 0; i < p.size(); ++i) {
      bool beaten = false, twin_on_front = false;
      for (std::size_t j = 0; j < p.size(); ++j) {
        beaten |= p[j].x <= p[i].x && p[j].y <= p[i].y && (p[j].x < p[i].x || p[j].y < p[i].y);
        twin_on_front |= on_front[j] && p[j].x == p[i].x && p[j].y == p[i].y;
      }
      EXPECT_EQ(twin_on_front, !beaten) << trial << ": " << p[i].x << ", " << p[i].y;
    }
  }
}

TEST(Chart, CommasInTextsStayInTheirColumn) {
  Chart chart{"name", "", "time, s", "error"};
  chart.points.push_back({"slit, closed form", "1 mm", 2, 0.5, true});
  EXPECT_EQ(csv_of({chart}),
            "chart,series,setting,x,x_label,y,y_label,standard,front\n"
            "name,\"slit, closed form\",1 mm,2,\"time, s\",0.5,error,1,1\n");
}

/// chart,series -> errors, in the order of the file.
std::map<std::string, std::vector<double>> errors_by_series(const std::string& csv) {
  std::map<std::string, std::vector<double>> errors;
  const std::string text = read_text_file(csv);
  for (std::size_t at = text.find('\n') + 1; at < text.size(); at = text.find('\n', at) + 1) {
    const std::string line = text.substr(at, text.find('\n', at) - at);
    std::vector<std::string> cells{""};
    bool quoted = false;
    for (const char c : line)
      if (c == '"')
        quoted = !quoted;
      else if (c == ',' && !quoted)
        cells.emplace_back();
      else
        cells.back() += c;
    errors[cells.at(0) + "/" + cells.at(1)].push_back(std::stod(cells.at(5)));
  }
  return errors;
}

bool decreases(const std::vector<double>& values) {
  for (std::size_t i = 1; i < values.size(); ++i)
    if (values[i] >= values[i - 1]) return false;
  return values.size() > 1;
}

TEST(ChartCommand, DrawsAStudysOwnCase) {
  const TemporaryFolder folder;
  const std::string toml = folder.write("study.toml", small_study), study = folder / "study",
                    out = folder / "chart.svg";
  expect_success(run_cleft("run", {toml, "--out", study}));
  expect_success(run_cleft("chart", {study, "--out", out, "--most-nodes", "3000"}));
  const std::string svg = read_text_file(out), png = read_text_file(folder / "chart.png");
  EXPECT_NE(svg.find("Simulation: error over unknowns"), svg.npos);
  EXPECT_NE(svg.find("tip"), svg.npos);
  EXPECT_EQ(png.substr(1, 3), "PNG");
  auto errors = errors_by_series(folder / "chart.csv");
  for (const double error : errors["solver.unknowns/slit, closed form"]) EXPECT_LT(error, 0.03);
  const std::vector<double>& slit = errors["solver.unknowns/slit that ends at nodes, closed form"];
  EXPECT_TRUE(decreases(slit));
  EXPECT_LT(slit.back(), slit[slit.size() - 2] * 0.7);  // of first order in the element's size
  // A finer mesh brings finite strains to their reference; what small ones lack it cannot take away.
  const std::vector<double>&small = errors["solver.models/small strains"],
        &finite = errors["solver.models/finite strains"];
  ASSERT_GE(small.size(), 2u);
  ASSERT_GE(finite.size(), 1u);
  EXPECT_LT(finite.front(), small.front());
  EXPECT_GT(small.front(), 0.02);
  EXPECT_TRUE(decreases(errors["haptic.rate/model alone"]));
  EXPECT_TRUE(decreases(errors["replay.radius/the case's field"]));  // with the radius
  EXPECT_TRUE(decreases(errors["replay.frame/tolerance"]));
  for (const char* series : {"encoder.size/front", "encoder.size/tip", "encoder.size/fixed"}) {
    const std::vector<double>& all = errors[series];
    ASSERT_GE(all.size(), 7u);
    const double asked[] = {0.08, 0.04, 0.02, 0.01, 0.005, 0.001, 1e-4};
    for (std::size_t i = 0; i < 7; ++i) EXPECT_LE(all[i], asked[i]) << series;
  }
  // Nothing but the three files is left next to the study.
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    files += entry.path().filename().string().starts_with("chart") ||
             entry.path().filename().string().starts_with(".");
  EXPECT_EQ(files, 3u);
}

TEST(ChartCommand, ToldWhatIsWrong) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::vector<std::string>& arguments, const std::string& why) {
    const Outcome outcome = run_cleft("chart", arguments);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
    EXPECT_NE(outcome.output.find(why), outcome.output.npos) << outcome.output;
  };
  const std::string toml =
                        folder.write("study.toml", std::string("keep_snapshots = \"none\"\n") + small_study),
                    study = folder / "study";
  refused({study, "--out", folder / "chart.svg"}, study);
  expect_success(run_cleft("run", {toml, "--out", study}));
  refused({study, "--out", folder / "chart.svg"}, "keep_snapshots");
  refused({study, "--out", folder / "chart.pdf"}, "must end in .svg");
  refused({study, "--out", folder / "nowhere/chart.svg"}, "nowhere");
  EXPECT_FALSE(std::filesystem::exists(folder / "chart.svg"));
}

}  // namespace

}  // namespace cleft
