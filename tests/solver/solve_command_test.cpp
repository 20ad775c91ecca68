// `cleft solve` on several ranks, by every method and partitioner: the same snapshot.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/text.h"
#include "tests/pipeline/commands.h"
#include "tests/solver/solved_snapshot.h"

namespace cleft {

namespace {

constexpr const char* sheared_case = R"([case]
patch.length = 10
patch.width = 7
patch.height = 3
cut.length = 6
cut.depth = 2
cut.branch = 1
cut.frames = "pair"
mesh.cut_depth = 2.6
skin.prestress_u = 0.02
skin.prestress_uv = 0.012
)";

struct Way {
  int ranks;
  const char *method, *partitioner;
};

class SolveCommand : public testing::Test {
 protected:
  std::string solve(const Way& way, const std::vector<std::string>& more = {}) {
    const std::string out = folder / std::to_string(way.ranks) + way.method + way.partitioner + ".h5";
    std::vector<std::string> arguments = {folder.write("case.toml", sheared_case),
                                          "--out",
                                          out,
                                          "--method",
                                          way.method,
                                          "--partitioner",
                                          way.partitioner,
                                          "--no-estimate"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    expect_success(way.ranks == 1 ? run_cleft("solve", arguments)
                                  : cleft_on_ranks("solve", way.ranks, arguments));
    check_snapshot(out);
    return out;
  }

  /// `tolerance`: / the largest entry.
  void expect_same(const std::string& path, const std::string& reference, double tolerance,
                   const std::vector<std::string>& arrays) {
    const Snapshot s = SnapshotReader(path).snapshot(), t = SnapshotReader(reference).snapshot();
    ASSERT_EQ(s.points.size(), t.points.size());
    for (std::size_t n = 0; n < s.points.size(); ++n) ASSERT_EQ(norm(s.points[n] - t.points[n]), 0);
    EXPECT_EQ(s.connectivity, t.connectivity);
    EXPECT_EQ(s.pairs, t.pairs);
    EXPECT_EQ(s.released, t.released);
    EXPECT_EQ(s.case_hash, t.case_hash);
    for (const std::string& array : arrays)
      EXPECT_LT(difference(array_of(path, array), array_of(reference, array)), tolerance) << array;
    for (std::size_t j = 0; j < s.frames(); ++j) {
      EXPECT_NEAR(s.smallest_gap[j], t.smallest_gap[j], tolerance);
      EXPECT_NEAR(s.residual_equilibrium[j], t.residual_equilibrium[j], tolerance);
      EXPECT_NEAR(s.residual_closure[j], t.residual_closure[j], tolerance);
    }
  }

  TemporaryFolder folder;
};

}  // namespace

TEST_F(SolveCommand, RanksAndPartitionersGiveTheSameSnapshot) {
  const std::vector<std::string> more = {"--unit-prestress", "--sensitivities",
                                         "tissue.poisson_ratio,foundation.side_stiffness"};
  std::vector<std::string> arrays = {"displacement", "compliance", "dent"};
  for (const char* name : {"skin.prestress_u", "skin.prestress_v", "skin.prestress_uv",
                           "tissue.poisson_ratio", "foundation.side_stiffness"})
    arrays.push_back(std::string("displacement_per_") + name);
  const std::string reference = solve({1, "direct", "metis"}, more);
  // Rounding, times a condition of K below 1e5.
  for (const Way& way : {Way{2, "direct", "metis"}, {3, "direct", "zorder"}, {4, "direct", "zoltan"}}) {
    SCOPED_TRACE(std::to_string(way.ranks) + " ranks, " + way.partitioner);
    expect_same(solve(way, more), reference, 1e-10, arrays);
  }
  // Residuals of 1e-10, times that; those of the compliance are 1e-5 for the sake of its 1 %.
  const std::string by_iterations = solve({3, "iterative", "zoltan"});
  expect_same(by_iterations, reference, 1e-8, {"displacement", "dent"});
  EXPECT_LT(difference(array_of(by_iterations, "compliance"), array_of(reference, "compliance")), 1e-3);
}

/// Within a fifth, by both methods, of what the operating system counts.
TEST_F(SolveCommand, ThePeakOfMemoryIsToldBefore) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "the sanitizer's own memory would be counted too";
#endif
  const std::string file =
      folder.write("case.toml", "case.mesh.element_size = 0.8\ncase.cut.frames = \"column\"\n");
  for (const char* method : {"direct", "iterative"}) {
    const Outcome outcome = expect_success(run_cleft(
        "solve", {file, "--out", folder / "peak.h5", "--json", "--no-estimate", "--method", method}));
    const auto figures = nlohmann::json::parse(outcome.output.substr(outcome.output.find("{\n")));
    double peak = 0;
    for (const double megabytes : figures["peak_memory_mb"]) peak = std::max(peak, megabytes);
    EXPECT_NEAR(figures["expected_peak_memory_mb"].get<double>(), peak, 0.2 * peak) << method;
  }
}

TEST_F(SolveCommand, ContactIsTheSameOnSeveralRanks) {
  const std::vector<std::string> contact = {"--set", "cut.contact=true"};
  const std::string reference = solve({1, "direct", "metis"}, contact);
  const std::vector<double> gaps = SnapshotReader(reference).snapshot().smallest_gap;
  EXPECT_GT(*std::min_element(gaps.begin(), gaps.end()), -1e-12);
  expect_same(solve({2, "direct", "zorder"}, contact), reference, 1e-10, {"displacement"});
}

/// Newton's method stops at residuals of 1e-7.
TEST_F(SolveCommand, TheFiniteModelIsTheSameOnSeveralRanks) {
  const std::vector<std::string> finite = {"--set", "model=finite", "--set", "skin.law=fung"};
  const std::string reference = solve({1, "direct", "metis"}, finite);
  expect_same(solve({2, "direct", "zorder"}, finite), reference, 1e-6, {"displacement"});
  expect_same(solve({3, "direct", "metis"}, finite), reference, 1e-6, {"displacement"});
}

TEST_F(SolveCommand, TheFiniteModelReportsItsResiduals) {
  const Outcome outcome = expect_success(
      run_cleft("solve", {folder.write("case.toml", sheared_case), "--out", folder / "finite.h5", "--json",
                          "--verbose", "--set", "model=finite"}));
  EXPECT_NE(outcome.output.find("frame 1: residual "), std::string::npos) << outcome.output;
  const auto figures = nlohmann::json::parse(outcome.output.substr(outcome.output.find("{\n")));
  ASSERT_EQ(figures["newton"].size(), figures["frames"]);
  for (const auto& frame : figures["newton"]) {
    EXPECT_EQ(frame["residuals"].size(), frame["iterations"].size() + 1);
    EXPECT_LT(frame["residuals"].back(), 1e-7);
    EXPECT_EQ(frame["load_steps"], 1);
  }
  check_snapshot(folder / "finite.h5");
  EXPECT_EQ(SnapshotReader(folder / "finite.h5").snapshot().parameters->model, Model::finite);
}

TEST_F(SolveCommand, EveryRunOnAsManyRanksWritesTheSameBytes) {
  const std::string file = folder.write("coarse.toml", "case.mesh.element_size = 3\n");
  const std::string finite =
      folder.write("finite.toml", "case.mesh.element_size = 3\ncase.model = \"finite\"\n");
  for (const int ranks : {2, 3}) {
    if (ranks == 3) {
      expect_success(
          cleft_on_ranks("solve", ranks, {finite, "--out", folder / "finite.h5", "--no-estimate"}));
      const std::string first = read_text_file(folder / "finite.h5");
      expect_success(
          cleft_on_ranks("solve", ranks, {finite, "--out", folder / "finite.h5", "--no-estimate"}));
      EXPECT_TRUE(read_text_file(folder / "finite.h5") == first);
    }
    std::string first;
    for (int again = 0; again < 2; ++again) {
      expect_success(cleft_on_ranks("solve", ranks, {file, "--out", folder / "again.h5", "--no-estimate"}));
      const std::string bytes = read_text_file(folder / "again.h5");
      if (again == 0) first = bytes;
      EXPECT_TRUE(bytes == first) << "on " << ranks << " ranks";
    }
  }
}

TEST_F(SolveCommand, SeveralCasesGoIntoAFolderAndAListOfFigures) {
  const std::string first = folder.write("first.toml", sheared_case);
  const std::string second =
      folder.write("second.toml", sheared_case + std::string("skin.prestress_v = 0.04\n"));
  std::filesystem::create_directory(folder / "out");
  const Outcome outcome =
      expect_success(run_cleft("solve", {first, second, "--out", folder / "out", "--json"}));
  // MPI may say something about the machine before.
  const auto figures = nlohmann::json::parse(outcome.output.substr(outcome.output.find("[\n")));
  ASSERT_EQ(figures.size(), 2);
  EXPECT_EQ(figures[0]["out"], folder / "out/first.h5");
  EXPECT_EQ(figures[1]["out"], folder / "out/second.h5");
  for (const auto& f : figures) EXPECT_EQ(f["cases_sharing"], 2);
  EXPECT_TRUE(figures[0].contains("seconds"));
  EXPECT_FALSE(figures[1].contains("seconds"));
  check_snapshot(folder / "out/first.h5");
  check_snapshot(folder / "out/second.h5");
  EXPECT_GT(figures[1]["gape_mm"], figures[0]["gape_mm"]);
}

}  // namespace cleft
