// A study, run, interrupted, damaged and run again.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/text.h"
#include "params/run/study_folder.h"
#include "tests/pipeline/commands.h"
#include "tests/support/older_field.h"
#include "tests/support/small_study.h"
#include "tests/support/temporary_folder.h"

namespace cleft {

namespace fs = std::filesystem;

namespace {

constexpr const char* study = R"(
name = "small"
[case]
patch.length = 14
patch.width = 8
patch.height = 4
cut.length = 8
cut.depth = 2
mesh.element_size = 1.5
[vary]
"tissue.young_modulus" = [0.01, 0.03]
"skin.prestress_v" = [0.02, 0.04]
[encode]
tolerance = 0.05
)";

nlohmann::json status(const std::string& folder) {
  return nlohmann::json::parse(expect_success(run_cleft("status", {folder, "--json"})).output);
}

/// The table of the cases as CSV holds what it holds as JSON, and figures are those of the cases' fields.
void expect_tables_agree(const std::string& folder) {
  const nlohmann::json cases = status(folder)["cases"];
  std::istringstream csv(expect_success(run_cleft("status", {folder, "--csv"})).output);
  std::string line;
  std::getline(csv, line);
  EXPECT_EQ(line,
            "case,state,skin.prestress_v,tissue.young_modulus,node_error,largest_displacement_mm,bytes,"
            "seconds,raw_data");
  for (const auto& one : cases) {
    std::getline(csv, line);
    EXPECT_EQ(line.substr(0, line.find(',')), one["case"]);
    EXPECT_NE(line.find(one["node_error"].dump() + "," + one["largest_displacement_mm"].dump()),
              std::string::npos)
        << line;
    const std::string field = folder + "/cases/" + one["case"].get<std::string>() + "/case.dffd";
    const auto report =
        nlohmann::json::parse(expect_success(run_cleft("info", {field, "--json"})).output)["report"];
    for (const char* figure : {"node_error", "largest_displacement_mm"}) {
      const double in_file = report[figure];  // of seven digits
      EXPECT_NEAR(one[figure].get<double>(), in_file, 1e-6 * in_file) << figure;
    }
  }
  EXPECT_FALSE(std::getline(csv, line)) << line;
}

}  // namespace

TEST(StudyRun, PublishesEveryCaseOnceAndChecks) {
  const TemporaryFolder place;
  const std::string file = place.write("study.toml", study), folder = place / "out";
  EXPECT_NE(expect_success(run_cleft("run", {file, "--out", folder, "--dry-run"})).output.find("4 cases"),
            std::string::npos);
  EXPECT_EQ(
      nlohmann::json::parse(
          expect_success(run_cleft("run", {file, "--out", folder, "--dry-run", "--json"})).output)["cases"]
          .size(),
      4u);
  EXPECT_FALSE(fs::exists(folder)) << "--dry-run must write nothing";
  expect_success(run_cleft("run", {file, "--out", folder}));
  EXPECT_EQ(status(folder)["published"], 4);
  expect_tables_agree(folder);
  expect_success(run_cleft("check", {folder}));
  EXPECT_TRUE(fs::is_empty(folder + "/attempts"));
  EXPECT_FALSE(fs::exists(folder + "/pack.log"));

  // All fields in one file, which says the same of each as its own file.
  const auto packed =
      nlohmann::json::parse(expect_success(run_cleft("info", {folder + "/study.dffd", "--json"})).output);
  ASSERT_EQ(packed["list"].size(), 4u);
  for (const auto& one : packed["list"]) {
    const std::string own = folder + "/cases/" + std::string(one["name"]) + "/case.dffd";
    const auto info = nlohmann::json::parse(expect_success(run_cleft("info", {own, "--json"})).output);
    for (const char* name : {"case", "report", "parameters", "hash"}) EXPECT_EQ(one[name], info[name]);
    EXPECT_EQ(info["hash"], one["name"]) << "that of its folder, as `cleft status` prints it";
    const std::string snapshot = folder + "/cases/" + std::string(one["name"]) + "/case.h5";
    EXPECT_NE(expect_success(run_cleft("info", {snapshot})).output.find("hash: " + std::string(one["name"])),
              std::string::npos);
  }

  const auto before = fs::last_write_time(folder + "/cases");
  EXPECT_NE(expect_success(run_cleft("run", {file, "--out", folder, "--json"}))
                .output.find("\"already_published\": 4"),
            std::string::npos);
  EXPECT_EQ(fs::last_write_time(folder + "/cases"), before);

  // A case that is lost is the only one made again.
  const std::string lost = status(folder)["cases"][2]["case"];
  fs::remove_all(folder + "/cases/" + lost);
  EXPECT_EQ(status(folder)["missing"], 1);
  const auto expect_stale = [&](const std::string& what) {
    const Outcome found = run_cleft("check", {folder});
    EXPECT_EQ(found.exit_code, 2);
    EXPECT_NE(found.output.find(what), std::string::npos) << found.output;
  };
  expect_stale("study.dffd: holds case " + lost + ", which is not published");
  expect_success(run_cleft("pack", {folder}));
  const std::string without = read_text_file(folder + "/study.dffd");
  const std::string shown = expect_success(run_cleft("info", {folder + "/study.dffd"})).output;
  EXPECT_NE(shown.find("cases: 3"), std::string::npos);
  EXPECT_NE(shown.find("node_error  skin.prestress_v  tissue.young_modulus\n"), std::string::npos) << shown;
  EXPECT_EQ(shown.find('{'), std::string::npos) << "a table, for people: " << shown;
  EXPECT_NE(expect_success(run_cleft("run", {file, "--out", folder, "--json", "--ranks", "2"}))
                .output.find("\"published\": 1"),
            std::string::npos);
  expect_success(run_cleft("check", {folder}));
  place.write("out/study.dffd", without);
  expect_stale("study.dffd: lacks the published case " + lost);

  // A new [encode] encodes again and does not solve again.
  const auto encoded_as = [&](const std::string& settings) {
    std::string other = study;
    other.replace(other.find("tolerance = 0.05"), 16, settings);
    expect_success(run_cleft("run", {place.write("study.toml", other), "--out", folder}));
    const std::string one = folder + "/cases/" + std::string(status(folder)["cases"][0]["case"]);
    return std::pair(
        nlohmann::json::parse(expect_success(run_cleft("info", {one + "/case.dffd", "--json"})).output),
        fs::hard_link_count(one + "/case.h5"));
  };
  const auto [finer, finer_links] = encoded_as("tolerance = 0.02");
  EXPECT_EQ(finer_links, 2u);
  EXPECT_EQ(finer["parametrization"], "front");
  EXPECT_GT(finer["fit_seconds"], 0);
  EXPECT_GT(finer["measure_seconds"], 0);
  EXPECT_LE(finer["report"]["node_error"], 0.02);
  const auto [fixed, fixed_links] = encoded_as("parametrization = 'fixed'\ncontrol_points = [12, 10, 6, 6]");
  EXPECT_EQ(fixed_links, 3u);
  EXPECT_EQ(fixed["parametrization"], "fixed");
  EXPECT_EQ(fixed["control_points"], nlohmann::json({12, 10, 6, 6}));
  const std::string encoded = status(folder)["cases"][0]["case"];
  expect_success(run_cleft("check", {folder}));

  // A damaged byte is found.
  const std::string victim = folder + "/cases/" + encoded + "/case.dffd";
  std::string bytes = read_text_file(victim);
  bytes[bytes.size() / 2] ^= 1;
  place.write("out/cases/" + encoded + "/case.dffd", bytes);
  const Outcome found = run_cleft("check", {folder});
  EXPECT_EQ(found.exit_code, 2);
  EXPECT_NE(found.output.find(encoded), std::string::npos) << found.output;
}

/// Of all published files but the manifests, which contain times, and logs, where libraries may name the
/// machine.
std::map<std::string, std::string> study_bytes(const std::string& folder) {
  std::map<std::string, std::string> files = published_bytes(folder);
  files["study.dffd"] = read_text_file(folder + "/study.dffd");
  return files;
}

TEST(StudyRun, IsTheSameHoweverItsCasesAreGrouped) {
  const TemporaryFolder place;
  const std::string file = place.write("study.toml", study);
  expect_success(run_cleft("run", {file, "--out", place / "together", "--jobs", "1"}));
  expect_success(run_cleft("run", {file, "--out", place / "apart", "--jobs", "4", "--memory", "0.001"}));
  const auto together = study_bytes(place / "together");
  EXPECT_EQ(together.size(), 13u);
  EXPECT_TRUE(together == study_bytes(place / "apart"));

  // What a case was made with stands in its manifest.
  const StudyFolder folder(place / "together");
  for (const std::string& hash : folder.published_cases()) {
    const auto manifest = folder.manifest(hash);
    EXPECT_EQ(manifest["solver"]["cases_sharing"], 2);
    for (const char* library : {"cleft", "deal.II", "Trilinos", "MUMPS", "HDF5", "MPI"})
      EXPECT_TRUE(manifest["solver"]["versions"].contains(library)) << library;
    EXPECT_TRUE(manifest["encoder"]["versions"].contains("Eigen"));
    EXPECT_EQ(manifest["parameters"]["patch.length"], 14);
    for (const char* name : {"host", "ranks", "threads", "seconds", "published", "sampling"})
      EXPECT_TRUE(manifest.contains(name)) << name;
  }

  // The measured cases tell what one more will take.
  std::string more = study;
  more.replace(more.find("[0.02, 0.04]"), 12, "[0.02, 0.04, 0.05]");
  const auto plan =
      nlohmann::json::parse(expect_success(run_cleft("run", {place.write("more.toml", more), "--out",
                                                             place / "together", "--dry-run", "--json"}))
                                .output);
  EXPECT_EQ(plan["published"], 4);
  EXPECT_EQ(plan["to_run"], 2);
  EXPECT_GT(plan["estimated_bytes"], 1e5);

  // A field that is gone is missed, made again, and the same.
  const std::string lost = folder.published_cases().front();
  fs::remove(folder.published(lost) + "/case.dffd");
  EXPECT_EQ(status(folder.path())["damaged"], 1);
  EXPECT_EQ(status(folder.path())["published"], 3);
  const Outcome again = expect_success(run_cleft("run", {file, "--out", folder.path(), "--jobs", "1"}));
  EXPECT_NE(again.output.find("case " + lost + ": case.dffd is missing; it is made again"), std::string::npos)
      << again.output;
  EXPECT_EQ(status(folder.path())["published"], 4);
  EXPECT_TRUE(together == study_bytes(folder.path()));
}

TEST(StudyRun, OnTwoRanksIsTheSameEveryTime) {
  const TemporaryFolder place;
  const std::string file = place.write("study.toml", small_study);
  for (const char* folder : {"first", "second", "third"})
    expect_success(run_cleft("run", {file, "--out", place / folder, "--ranks", "2", "--jobs", "2"}));
  EXPECT_TRUE(study_bytes(place / "first") == study_bytes(place / "second"));
  EXPECT_TRUE(study_bytes(place / "first") == study_bytes(place / "third"));
}

TEST(StudyRun, PacksWhatIsPublishedWhileItGoesOn) {
  const TemporaryFolder place;
  // One case takes a second, the other one minutes.
  const std::string file = place.write("study.toml", "[vary]\n'mesh.element_size' = [3, 0.4]\n"),
                    packed = place / "out/study.dffd";
  const pid_t child = fork();
  if (child == 0) {
    execl(CLEFT_BIN "/cleft", "cleft", "run", file.c_str(), "--out", (place / "out").c_str(), "--jobs", "2",
          "--memory", "1000", nullptr);
    _exit(127);
  }
  int result = 0;
  for (int i = 0; i < 900 && !fs::exists(packed); ++i) usleep(100'000);
  EXPECT_EQ(waitpid(child, &result, WNOHANG), 0) << "it goes on";
  EXPECT_TRUE(fs::exists(packed));
  kill(child, SIGTERM);
  waitpid(child, &result, 0);
  const auto info = nlohmann::json::parse(expect_success(run_cleft("info", {packed, "--json"})).output);
  EXPECT_EQ(info["cases"], 1);
  expect_success(run_cleft("check", {place / "out"}));
}

TEST(StudyRun, CasesOfAnOlderFormatAreNamedAndLeftOut) {
  const TemporaryFolder place;
  const std::string file = place.write("study.toml", small_study), folder = place / "out";
  publish_older_case(folder, "0123456789abcdef");
  fs::copy(file, folder + "/study.toml");
  const std::string told = "of an older format: case 0123456789abcdef; cleft run";
  for (const Outcome& outcome :
       {run_cleft("run", {file, "--out", folder}), run_cleft("pack", {folder}), run_cleft("check", {folder})})
    EXPECT_NE(expect_success(outcome).output.find(told), std::string::npos) << outcome.output;
  EXPECT_EQ(status(folder)["published"], 4);
}

TEST(StudyRun, WithoutItsSnapshotsIsSound) {
  const TemporaryFolder place;
  const std::string file = place.write("study.toml", std::string("keep_snapshots = 'none'\n") + study);
  expect_success(run_cleft("run", {file, "--out", place / "out"}));
  const std::string checked = expect_success(run_cleft("check", {place / "out"})).output;
  EXPECT_NE(checked.find("4 cases without raw data"), std::string::npos) << checked;
  const auto now = status(place / "out");
  EXPECT_EQ(now["published"], 4);
  EXPECT_EQ(now["without_snapshot"], 4);
  const std::string one = place / "out/cases/" + std::string(now["cases"][0]["case"]);
  EXPECT_FALSE(fs::exists(one + "/case.h5"));
  EXPECT_NE(expect_success(run_cleft("info", {one + "/case.dffd"})).output.find("raw_data: dropped"),
            std::string::npos);
  const Outcome exported = run_cleft("export", {place / "out", "--paraview", place / "views"});
  EXPECT_EQ(exported.exit_code, 2);
  EXPECT_NE(exported.output.find("keep_snapshots"), std::string::npos) << exported.output;
}

TEST(StudyRun, EstimatesNoErrorsWhereItSaysSo) {
  const TemporaryFolder place;
  for (const char* which : {"all", "none"}) {
    const std::string file = place.write("study.toml",
                                         std::string("error_estimates = '") + which + "'\n" + study),
                      out = place / which;
    expect_success(run_cleft("run", {file, "--out", out}));
    const std::string one = out + "/cases/" + std::string(status(out)["cases"][0]["case"]);
    const std::string manifest = read_text_file(one + "/manifest.json");
    EXPECT_EQ(manifest.find("expected_gape_error\"") != std::string::npos, std::string(which) == "all");
  }
  const Outcome refused = run_cleft(
      "run",
      {place.write("study.toml", std::string("error_estimates = 'some'\n") + study), "--out", place / "x"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.output.find("error_estimates = \"some\": must be \"all\" or \"none\""), std::string::npos)
      << refused.output;
}

TEST(StudyRun, ItsFileHasFewerBytesWhereItSaysSo) {
  const TemporaryFolder place;
  const std::string file = place.write("study.toml", std::string("pack_error = 0.02\n") + study),
                    packed = place / "out/study.dffd";
  expect_success(run_cleft("run", {file, "--out", place / "out"}));
  const auto bytes = fs::file_size(packed);
  const auto info = nlohmann::json::parse(expect_success(run_cleft("info", {packed, "--json"})).output);
  ASSERT_EQ(info["list"].size(), 4u);
  for (const auto& one : info["list"]) {
    EXPECT_GT(one["modes_error"], 0) << one;
    EXPECT_LE(one["modes_error"], 0.02) << one;
  }
  expect_success(run_cleft("check", {place / "out"}));
  expect_success(run_cleft("pack", {place / "out"}));
  EXPECT_LT(bytes, fs::file_size(packed));
}

TEST(StudyRun, AFailedCaseKeepsItsLogAndStopsNoOther) {
  const TemporaryFolder place;
  // Without springs the patch floats: K is singular, and the factorisation is set.
  std::string text = study;
  const std::string varied = "\"skin.prestress_v\" = [0.02, 0.04]";
  text.replace(text.find(varied), varied.size(), "\"foundation.stiffness\" = [0.005, 1e-300]");
  text.insert(text.find("[vary]"), "foundation.side_stiffness = 0\n");
  const Outcome outcome = run_cleft("run", {place.write("study.toml", text), "--out", place / "out"});
  EXPECT_EQ(outcome.exit_code, 1) << outcome.output;
  const auto now = status(place / "out");
  EXPECT_EQ(now["published"], 2) << now.dump(2);
  EXPECT_EQ(now["failed"], 2) << now.dump(2);
  for (const auto& one : now["cases"]) {
    const std::string reason = one.value("reason", "");
    EXPECT_EQ(one["state"] == "failed", reason.find("not positive definite") != std::string::npos) << one;
    if (one["state"] != "failed") continue;
    const std::string attempts = place / "out/attempts/" + std::string(one["case"]);
    const std::string attempt = fs::directory_iterator(attempts)->path().string();
    EXPECT_TRUE(fs::exists(attempt + "/case.toml") && fs::exists(attempt + "/failed.txt"));
  }

  // It is tried again only on request.
  const std::string file = place / "study.toml";
  const Outcome again = run_cleft("run", {file, "--out", place / "out"});
  EXPECT_EQ(again.exit_code, 1);
  EXPECT_NE(again.output.find("--retry-failed"), std::string::npos) << again.output;
  const Outcome retried = run_cleft("run", {file, "--out", place / "out", "--retry-failed"});
  EXPECT_EQ(retried.exit_code, 1);
  EXPECT_EQ(retried.output.find("--retry-failed"), std::string::npos) << retried.output;
}

TEST(StudyRun, ATerminatedRunGivesUpAtOnceAndSaysSo) {
  const TemporaryFolder place;
  // Cases that take minutes each: it must not wait for them.
  const std::string file =
      place.write("study.toml", "[case]\nmesh.element_size = 0.4\n[vary]\n'skin.thickness' = [1, 2, 3]\n");
  const pid_t child = fork();
  if (child == 0) {
    execl(CLEFT_BIN "/cleft", "cleft", "run", file.c_str(), "--out", (place / "out").c_str(), "--jobs", "1",
          nullptr);
    _exit(127);
  }
  usleep(1'500'000);
  kill(child, SIGTERM);
  int result = 0;
  for (int i = 0; i < 200 && waitpid(child, &result, WNOHANG) == 0; ++i) usleep(100'000);
  ASSERT_TRUE(WIFEXITED(result)) << "it did not end within 20 s";
  EXPECT_EQ(WEXITSTATUS(result), 1);
  const auto now = status(place / "out");
  EXPECT_EQ(now["published"], 0);
  EXPECT_EQ(now["missing"], 3) << now.dump(2);
}

TEST(StudyRun, ASecondInterruptKillsWhatIgnoresTheFirst) {
  const TemporaryFolder place;
  const std::string file = place.write("study.toml", "[vary]\n'skin.thickness' = [1, 2]\n");
  // Other commands are in the folder of cleft-run: here a solver that cannot be asked to stop.
  const std::string bin = place / "bin", started = place / "started";
  fs::create_directory(bin);
  fs::copy_file(CLEFT_BIN "/cleft-run", bin + "/cleft-run");
  place.write("bin/cleft-solve",
              "#!/bin/sh\ntrap '' TERM INT\ntouch " + started + "\nwhile :; do sleep 0.2; done\n");
  fs::permissions(bin + "/cleft-solve", fs::perms::owner_all);
  const pid_t child = fork();
  if (child == 0) {
    execl((bin + "/cleft-run").c_str(), "cleft-run", file.c_str(), "--out", (place / "out").c_str(), "--jobs",
          "1", nullptr);
    _exit(127);
  }
  for (int i = 0; i < 300 && !fs::exists(started); ++i) usleep(100'000);
  ASSERT_TRUE(fs::exists(started));
  int result = 0;
  kill(child, SIGINT);
  usleep(1'500'000);
  EXPECT_EQ(waitpid(child, &result, WNOHANG), 0) << "it waits for the solver, which goes on";
  kill(child, SIGINT);
  for (int i = 0; i < 200 && waitpid(child, &result, WNOHANG) == 0; ++i) usleep(100'000);
  ASSERT_TRUE(WIFEXITED(result)) << "it did not end within 20 s";
  EXPECT_EQ(WEXITSTATUS(result), 1);
  EXPECT_EQ(status(place / "out")["missing"], 2);
  EXPECT_NE(in_shell("pgrep -f " + bin + "/cleft-solve").exit_code, 0) << "the solver was killed";
}

TEST(StudyRun, ARankThatDiesEndsTheSolve) {
  const TemporaryFolder place;
  const std::string file = place.write("case.toml", "[case]\nmesh.element_size = 0.4\n");  // minutes
  const Outcome outcome = in_shell(
      "timeout 60 mpirun --oversubscribe --bind-to none -n 2 " CLEFT_BIN "/cleft-solve " + file + " --out " +
      place.path() + "/case.h5 & sleep 2; rank=$(pgrep -f -n '" CLEFT_BIN "/cleft-solve " + file +
      "'); kill -9 $rank; wait $!");
  EXPECT_EQ(outcome.exit_code, 137) << "128 + SIGKILL, not the 124 of a hang: " << outcome.output;
  EXPECT_NE(outcome.output.find("signal 9"), std::string::npos) << outcome.output;
  EXPECT_EQ(place.entries(), 1) << "nothing but the case file";
}

TEST(StudyRun, KilledRanksLeaveNothingInSharedMemory) {
  const TemporaryFolder place;
  const std::string file = place.write("study.toml", "[case]\nmesh.element_size = 0.4\n");  // minutes
  const std::string folder = place / "out";
  const auto start = [&] {
    const pid_t child = fork();
    if (child == 0) {
      execl(CLEFT_BIN "/cleft-run", "cleft-run", file.c_str(), "--out", folder.c_str(), "--ranks", "2",
            nullptr);
      _exit(127);
    }
    return child;
  };
  const auto is_shared = [](pid_t driver) {
    return in_shell("ls /dev/shm/cleft-*-" + std::to_string(driver) + "/vader_segment.*").exit_code == 0;
  };

  pid_t driver = start();
  int result = 0, kills = 0;
  for (int i = 0; i < 300 && waitpid(driver, &result, WNOHANG) == 0; ++i, usleep(200'000))
    if (is_shared(driver))
      kills += in_shell("kill -9 $(pgrep -n -f '^" CLEFT_BIN "/cleft-solve " + folder + "')").exit_code == 0;
  ASSERT_TRUE(WIFEXITED(result)) << "it did not give up";
  EXPECT_GE(kills, 3);
  EXPECT_NE(in_shell("ls -d /dev/shm/cleft-*-" + std::to_string(driver)).exit_code, 0);

  driver = start();
  for (int i = 0; i < 100 && !is_shared(driver); ++i) usleep(100'000);
  kill(driver, SIGKILL);
  waitpid(driver, &result, 0);
  EXPECT_TRUE(is_shared(driver)) << "it had no time to remove it";
  place.write("study.toml", study);
  expect_success(run_cleft("run", {file, "--out", folder}));
  EXPECT_NE(in_shell("ls -d /dev/shm/cleft-*-" + std::to_string(driver)).exit_code, 0);
}

TEST(StudyRun, AKilledRunIsFinishedByTheNext) {
  const TemporaryFolder place;
  const std::string file = place.write("study.toml", study), folder = place / "out";
  for (const int milliseconds : {100, 400, 700}) {
    const pid_t child = fork();
    if (child == 0) {
      setpgid(0, 0);
      execl(CLEFT_BIN "/cleft", "cleft", "run", file.c_str(), "--out", folder.c_str(), nullptr);
      _exit(127);
    }
    usleep(1000 * milliseconds);
    kill(-child, SIGKILL);
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
  }
  expect_success(run_cleft("run", {file, "--out", folder}));
  EXPECT_EQ(status(folder)["published"], 4);
  EXPECT_TRUE(fs::is_empty(folder + "/attempts"));
  expect_success(run_cleft("check", {folder}));
}

TEST(AdaptiveStudy, AddsCasesUntilItsErrorIsBelowTheOneWanted) {
  const TemporaryFolder folder;
  const std::string text = std::string(study).substr(0, std::string(study).find("[vary]")) +
                           "[vary]\n'tissue.young_modulus' = { from = 0.01, to = 0.03, scale = 'log' }\n"
                           "'cut.depth' = { from = 1.5, to = 3 }\n"
                           "[sampling]\nmethod = 'adaptive'\nstart = 4\nbatch = 2\nmost = 12\nof = 'gape'\n";
  const std::string file = folder.write("study.toml", text + "error = 0.1\n"), out = folder / "out";
  expect_success(run_cleft("run", {file, "--out", out}));
  nlohmann::json now = status(out);
  const auto cases = now.at("cases").size();
  EXPECT_EQ(now.at("published"), cases);
  EXPECT_LT(now.at("sampling").at("errors").back().at("error").get<double>(), 0.1);
  expect_success(run_cleft("run", {file, "--out", out}));  // nothing is missing
  EXPECT_EQ(status(out).at("cases").size(), cases);

  // A smaller error goes on from there, to the most there may be.
  const std::string smaller = folder.write("smaller.toml", text + "error = 1e-9\n");
  const Outcome outcome = expect_success(run_cleft("run", {smaller, "--out", out}));
  EXPECT_NE(outcome.output.find("the most that the study may have"), std::string::npos) << outcome.output;
  now = status(out);
  EXPECT_EQ(now.at("published"), 12);
  EXPECT_GE(now.at("sampling").at("errors").size(), 3u);
  EXPECT_LT(now.at("sampling").at("errors").back().at("error").get<double>(),
            now.at("sampling").at("errors").at(0).at("error").get<double>());
}

}  // namespace cleft
