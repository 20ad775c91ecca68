// cleft chart: speed and size against accuracy, for a study's own cases.
#include <algorithm>
#include <filesystem>
#include <functional>
#include <thread>

#include "base/command/command.h"
#include "base/error.h"
#include "base/output_file.h"
#include "base/output_folder.h"
#include "base/text.h"
#include "params/parameters/table.h"
#include "params/run/study_folder.h"
#include "solver/snapshot/snapshot.h"
#include "tradeoff/measures.h"

using namespace cleft;

namespace {

const std::vector<std::string> links = {"encoder", "solver", "replay", "haptic"};

/// The case of the hash or, where none is given, the first published one that has kept its snapshot.
ChartedCase charted_case(const StudyFolder& folder, const std::string& wanted) {
  std::vector<std::string> hashes = folder.published_cases();
  std::sort(hashes.begin(), hashes.end());
  if (hashes.empty())
    throw InputError(folder.path() + ": no case is published: cleft run " + folder.study_file() + " --out " +
                     folder.path());
  if (!wanted.empty() && !folder.is_published(wanted))
    throw InputError("--case " + wanted + ": is not published in " + folder.path() +
                     did_you_mean(wanted, hashes));
  for (const std::string& hash : hashes) {
    const std::string snapshot = folder.published(hash) + "/case.h5";
    if ((!wanted.empty() && hash != wanted) || !std::filesystem::exists(snapshot)) continue;
    const Study study = read_study(folder.study_file());
    ChartedCase charted;
    charted.snapshot = snapshot;
    charted.tolerance = study.base.encode.tolerance,
    charted.parametrization = study.base.encode.parametrization;
    const SnapshotReader reader(snapshot);
    for (const auto& [name, value] : reader.snapshot().parameters.all())
      set_parameter(charted.parameters, name, value, snapshot);
    return charted;
  }
  throw InputError(folder.path() + ": " + (wanted.empty() ? "no case has" : "case " + wanted + " has not") +
                   " kept its snapshot: set keep_snapshots = \"all\" and run the study again");
}

std::string machine() {
  std::string model = "unknown processor";
  for (const std::string text = read_text_file("/proc/cpuinfo"); const char* key : {"model name\t: "})
    if (const auto at = text.find(key); at != std::string::npos)
      model = text.substr(at + std::string(key).size(), text.find('\n', at) - at - std::string(key).size());
  return model + ", " + std::to_string(std::thread::hardware_concurrency()) + " threads";
}

}  // namespace

int main(int argc, char** argv) {
  CommandLine app("Charts of size and speed against accuracy, measured on a case of a study.", "cleft chart");
  std::string study, out = "chart.svg", wanted;
  std::vector<std::string> only = links;
  bool json = false;
  ChartOptions options;
  app.add_option("DIR", study, "study folder")->required();
  app.add_option("--out", out, "chart.svg; the picture as .png and the numbers as .csv go beside it")
      ->capture_default_str();
  app.add_option("--case", wanted, "hash of the case [the first that has kept its snapshot]");
  app.add_option("--only", only, "links of the chain: encoder, solver, replay, haptic")
      ->delimiter(',')
      ->check(one_of(links));
  app.add_option("--most-nodes", options.most_nodes, "of the finest mesh, which the others are compared with")
      ->check(above(100))
      ->capture_default_str();
  app.add_flag("--json", json, "print the figures as JSON");

  return run_command(app, argc, argv, [&] {
    const std::filesystem::path path(out);
    if (path.extension() != ".svg") throw InputError("--out " + out + ": must end in .svg");
    const std::string stem = (path.parent_path() / path.stem()).string();
    const OutputFile probe(out);  // reports a bad name before the work
    const ChartedCase charted = charted_case(StudyFolder(study), wanted);
    Progress progress("charting");
    std::size_t begun = 0;  // links, of those that are asked for
    options.progress = [&](const std::string& state) {
      progress(state,
               static_cast<double>(std::max<std::size_t>(begun, 1) - 1) / static_cast<double>(only.size()));
    };
    const OutputFolder work(path.has_parent_path() ? path.parent_path().string() : ".", "chart");
    std::vector<Chart> charts;
    const auto add = [&](const std::string& link, const std::function<std::vector<Chart>()>& measure) {
      if (std::find(only.begin(), only.end(), link) == only.end()) return;
      ++begun;
      for (Chart& chart : measure()) charts.push_back(std::move(chart));
    };
    add("encoder", [&] { return encoder_charts(charted, options); });
    add("solver", [&] { return solver_charts(charted, options, work.path()); });
    add("replay", [&] { return replay_charts(charted, options, work.path()); });
    add("haptic", [&] { return haptic_charts(options); });
    draw_charts(charts, stem, "Speed and size against accuracy", producer() + ", " + machine());
    write_text_file(stem + ".csv", csv_of(charts));
    Json figures = {{"out", out},
                    {"case", std::filesystem::path(charted.snapshot).parent_path().filename().string()}};
    for (const Chart& chart : charts)
      figures["charts"].push_back({{"name", chart.name}, {"points", chart.points.size()}});
    print_figures(figures, json);
  });
}
