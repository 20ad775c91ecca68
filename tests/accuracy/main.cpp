// Figures of the encoder that people watch from release to release.
//   accuracy make FOLDER           solves and writes the reference snapshots
//   accuracy check FOLDER CASE     encodes one; fails where a figure is worse than in accuracy.csv
//   accuracy renew FOLDER          encodes all, writes accuracy.csv and prints what differs
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "base/output_file.h"
#include "base/process.h"
#include "base/text.h"
#include "benchmarks/encoder/unseen.h"
#include "encoder/field/file/field_file.h"
#include "tests/accuracy/figures.h"
#include "tests/accuracy/generated.h"
#include "tests/accuracy/references.h"

using namespace cleft;
namespace fs = std::filesystem;

namespace {

/// Runs a command of the build and gives what it printed.
std::string run_cleft(std::vector<std::string> argv, const std::string& log) {
  argv.insert(argv.begin(), CLEFT_BIN "/cleft");
  const ProcessResult result =
      run_process(argv, log, {{"OMPI_ALLOW_RUN_AS_ROOT", "1"}, {"OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1"}});
  const std::string output = read_text_file(log);
  if (!result.success()) throw std::runtime_error("cleft " + argv[1] + " failed:\n" + output);
  return output;
}

void make(const std::string& folder) {
  fs::create_directories(folder);
  std::vector<std::string> command = {"solve"};
  for (const std::string& name : solved_references()) command.push_back(case_file(name));
  command.insert(command.end(), {"--out", folder});
  run_cleft(command, folder + "/solve.log");
  write_imported(folder + "/imported.h5");
  write_uncut(folder + "/uncut.h5");
}

AccuracyRow encoded(const std::string& folder, const std::string& name, double tolerance) {
  const std::string stem = folder + "/" + name + "_" + shortest(tolerance);
  const std::string output = run_cleft({"encode", folder + "/" + name + ".h5", "--out", stem + ".dffd",
                                        "--tolerance", shortest(tolerance), "--json"},
                                       stem + ".log");
  const auto figures = nlohmann::json::parse(output.substr(output.find('{')));
  AccuracyRow row{name, tolerance, {}};
  for (std::size_t i = 0; i <= least_volume; ++i) row.figures[i] = figures.at(figure_names[i]).get<double>();

  const SnapshotReader reader(folder + "/" + name + ".h5");
  const Series series(reader);
  row.figures[centroid_error] = error_at_centroids(read_field(stem + ".dffd"), series, reader.snapshot());
  EncodeOptions options;
  options.tolerance = tolerance;
  for (const auto& [frame, error] : errors_unseen(series, options))
    row.figures[unseen_error] = std::max(row.figures[unseen_error], error);
  return row;
}

/// The encoder promises its tolerance; what to say where a row breaks that.
std::optional<std::string> broken_promise(const AccuracyRow& row) {
  const double error = row.figures[node_error];
  if (error <= row.tolerance) return {};
  return row.case_name + " at tolerance " + shortest(row.tolerance) + ": node_error " + shortest(error) +
         " is above the tolerance";
}

int check(const std::string& folder, const std::string& name) {
  const std::vector<AccuracyRow> before = read_accuracy(accuracy_file());
  std::vector<std::string> faults;
  for (const double tolerance : reference_tolerances) {
    const AccuracyRow now = encoded(folder, name, tolerance);
    if (const auto broken = broken_promise(now)) faults.push_back(*broken);
    const AccuracyRow* was = find_row(before, name, tolerance);
    if (!was) {
      faults.push_back(name + " at tolerance " + shortest(tolerance) + ": accuracy.csv has no row for it");
      continue;
    }
    const Differences differences = compare(*was, now);
    for (const std::string& what : differences.better) std::printf("better: %s\n", what.c_str());
    for (const std::string& what : differences.worse) faults.push_back("worse: " + what);
  }
  for (const std::string& fault : faults) std::printf("%s\n", fault.c_str());
  if (!faults.empty()) std::printf("Where that is wanted, tests/accuracy/renew.sh renews the table.\n");
  return faults.empty() ? 0 : 1;
}

int renew(const std::string& folder) {
  std::vector<AccuracyRow> before, now;
  if (fs::exists(accuracy_file())) before = read_accuracy(accuracy_file());
  int broken_rows = 0;
  for (const std::string& name : references())
    for (const double tolerance : reference_tolerances) {
      const AccuracyRow& row = now.emplace_back(encoded(folder, name, tolerance));
      if (const auto broken = broken_promise(row)) std::printf("%s\n", broken->c_str()), ++broken_rows;
      if (const AccuracyRow* was = find_row(before, name, tolerance)) {
        const Differences differences = compare(*was, row);
        for (const std::string& what : differences.worse) std::printf("worse:  %s\n", what.c_str());
        for (const std::string& what : differences.better) std::printf("better: %s\n", what.c_str());
      } else {
        std::printf("new:    %s at tolerance %s\n", name.c_str(), shortest(tolerance).c_str());
      }
      std::fflush(stdout);
    }
  write_text_file(accuracy_file(), accuracy_text(now));
  return broken_rows == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string command = argc > 2 ? argv[1] : "";
  try {
    if (command == "make" && argc == 3) return make(argv[2]), 0;
    if (command == "check" && argc == 4) return check(argv[2], argv[3]);
    if (command == "renew" && argc == 3) return renew(argv[2]);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "accuracy: error: %s\n", e.what());
    return 1;
  }
  std::fprintf(stderr, "usage: accuracy make FOLDER | check FOLDER CASE | renew FOLDER\n");
  return 2;
}
