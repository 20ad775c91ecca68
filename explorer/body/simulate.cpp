#include "explorer/body/simulate.h"

#include <stdlib.h>  // mkdtemp

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include "base/error.h"
#include "base/output_file.h"
#include "base/stopwatch.h"
#include "base/text.h"
#include "base/unfinished.h"
#include "params/study.h"

namespace cleft {

namespace {

/// A folder for the files of one simulation.
class WorkFolder {
 public:
  WorkFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "cleft-simulate-XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error(name + ": a temporary folder cannot be made");
    path_ = name;
    begin_unfinished(path_);
  }
  ~WorkFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
    end_unfinished(path_);
  }
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
  std::string operator/(const std::string& name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

/// Beside this program, or in the folder that the environment variable CLEFT_BIN names.
std::string solver() {
  const char* folder = std::getenv("CLEFT_BIN");
  return (folder ? std::string(folder) : executable_folder()) + "/cleft-solve";
}

/// What the solver said last, without its name and those of temporary files.
std::string last_message(const std::string& log, const std::string& case_file) {
  std::string text = read_text_file(log);
  for (auto at = text.find(case_file); at != std::string::npos; at = text.find(case_file))
    text.erase(at, case_file.size());
  while (!text.empty() && text.back() == '\n') text.pop_back();
  for (const char* mark : {"error: ", "failed: "})
    if (const auto at = text.rfind(mark); at != std::string::npos)
      return text.substr(at + std::string(mark).size());
  return text.empty() ? "it said nothing" : text;
}

}  // namespace

BodySimulation simulate(const BodyRequest& request, const std::function<void(const std::string&)>& progress,
                        const StopCount* stop) {
  const auto tell = [&](const std::string& step) {
    if (progress) progress(step);
  };
  const auto end_if_stopped = [&] {
    if (stop && *stop > 0) throw std::runtime_error("the simulation was stopped");
  };
  const Stopwatch watch;
  const WorkFolder folder;
  BodySimulation result;
  tell("meshing the body");
  result.body = make_body(request, &result.report);
  end_if_stopped();
  write_body(folder / "body.h5", result.body);
  Case one;
  one.parameters = request.parameters;
  write_text_file(folder / "case.toml", case_file_text(one));
  tell("solving " + std::to_string(result.report.nodes) + " nodes");
  const ProcessResult ended = run_process({solver(), folder / "case.toml", "--mesh", folder / "body.h5",
                                           "--out", folder / "case.h5", "--no-estimate", "--json"},
                                          folder / "solve.log", {}, stop, folder / "solve.json");
  if (!ended.success()) {
    end_if_stopped();
    const std::string what =
        "the body could not be solved: " + last_message(folder / "solve.log", folder / "case.toml: ");
    if (ended.exit_code == 2) throw InputError(what);
    throw std::runtime_error(what);
  }
  result.series = std::make_unique<SnapshotReader>(folder / "case.h5");
  const std::vector<Vec3> open = result.series->displacement(result.series->snapshot().frames() - 1);
  for (const BodyPair& pair : result.body.pairs)
    result.gape = std::max(result.gape, dot(pair.normal, open[pair.right] - open[pair.left]));
  result.seconds = watch.seconds();
  return result;
}

}  // namespace cleft
