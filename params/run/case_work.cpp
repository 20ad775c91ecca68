#include "params/run/case_work.h"

#include <sys/statvfs.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/error.h"
#include "base/sealed_json.h"
#include "base/stopwatch.h"
#include "base/text.h"
#include "params/parameters/table.h"
#include "params/run/estimates.h"
#include "params/run/lock.h"

namespace cleft {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

constexpr int most_kills = 3;  // of a case's process, in one run, before it is given up

/// The line of a log that names something; empty where none does.
std::string line_with(const std::string& text, const std::string& what) {
  const std::size_t at = text.find(what);
  if (at == std::string::npos) return "";
  const std::size_t begin = text.rfind('\n', at) + 1;
  return text.substr(begin, text.find('\n', at) - begin);
}

/// The last line with a message: mpirun frames its messages by dashes.
std::string last_words(const std::string& text) {
  std::istringstream lines(text);
  std::string last;
  for (std::string line; std::getline(lines, line);)
    if (line.find_first_not_of("- \t\r") != std::string::npos) last = line;
  return last;
}

/// The message of a command about its own failure, "cleft solve: error: ..." (base/command/command.h): empty
/// where it came to none, and something else has failed, as mpirun or the log.
std::string own_words(const std::string& log, const std::string& command) {
  for (const char* kind : {": error: ", ": failed: "}) {
    const std::string begin = "cleft " + command + kind, said = line_with(log, begin);
    if (!said.empty() && said.find(begin) + begin.size() < said.size()) return said;
  }
  return "";
}

std::string text_of(const std::string& file) { return fs::exists(file) ? read_text_file(file) : ""; }

/// Not flushed: that is done once, with all of the case.
void write_case_file(const std::string& path, const Case& a_case) {
  std::ofstream file(path, std::ios::binary);
  file << case_file_text(a_case);
  file.close();
  if (!file) throw std::runtime_error(path + ": could not be written: is the disk full?");
}

/// The figures that a command printed; null where it did not come to that.
Json figures_in(const std::string& file) {
  const Json figures = Json::parse(text_of(file), nullptr, false);
  return figures.is_discarded() ? Json() : figures;
}

/// A folder for files that a process makes of several cases.
std::string empty_group(const CaseOnItsWay& first) {
  std::string group = first.file("group");
  fs::remove_all(group);
  make_shared_folder(first.attempt.folder, "group");
  return group;
}

std::string time_now() {
  const std::time_t now = std::time(nullptr);
  char text[40];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", std::gmtime(&now));
  return text;
}

std::string host_name() {
  char name[256] = "";
  gethostname(name, sizeof name - 1);
  return name;
}

/// Most bytes that a solver of these cases held.
double memory_in(const Json& list) {
  double memory = 0;
  for (const Json& figures : list)
    if (figures.contains("peak_memory_mb"))
      for (const Json& megabytes : figures["peak_memory_mb"])
        memory = std::max(memory, 1e6 * megabytes.get<double>());
  return memory;
}

/// From outside: by a signal, or by mpirun's or a shell's word for one.
bool was_killed(const ProcessResult& result) { return result.signal != 0 || result.exit_code > 128; }

bool disk_is_full(const std::string& folder) {
  struct statvfs space;
  constexpr double least = 16e6;
  return statvfs(folder.c_str(), &space) == 0 &&
         static_cast<double>(space.f_bavail) * static_cast<double>(space.f_frsize) < least;
}

/// A place for what Open MPI's processes on this machine share, and for mpirun's own files. A rank or an
/// mpirun that is killed leaves them behind: they go when this goes, or with the attempt.
class SharedMemory {
 public:
  explicit SharedMemory(std::string place) : place_(std::move(place)) {
    std::error_code error;
    if (place_.empty() || !fs::create_directory(place_, error)) place_.clear();
    if (!place_.empty()) fs::permissions(place_, fs::perms::owner_all, error);
  }
  ~SharedMemory() {
    std::error_code ignored;
    if (!place_.empty()) fs::remove_all(place_, ignored);
  }
  SharedMemory(const SharedMemory&) = delete;
  SharedMemory& operator=(const SharedMemory&) = delete;

  void put_into(std::map<std::string, std::string>& environment) const {
    if (place_.empty()) return;
    for (const char* name : {"OMPI_MCA_orte_tmpdir_base", "OMPI_MCA_btl_vader_backing_directory"})
      if (!std::getenv(name)) environment[name] = place_;
  }

 private:
  std::string place_;
};

}  // namespace

CaseWork::CaseWork(const StudyFolder& folder, const Study& study, Settings settings, const StopCount& stop)
    : folder_(folder),
      study_(study),
      settings_(std::move(settings)),
      stop_(stop),
      bin_(executable_folder()) {}

/// Its output is in NAME.json of the reporting attempt, its errors in NAME.log, its progress in progress.
ProcessResult CaseWork::child(const std::string& command, const std::vector<std::string>& arguments,
                              const CaseOnItsWay& teller, const std::string& name) const {
  std::vector<std::string> argv;
  if (command == "solve") argv = settings_.mpi_launcher;
  argv.push_back(bin_ + "/cleft-" + command);
  argv.insert(argv.end(), arguments.begin(), arguments.end());
  std::map<std::string, std::string> environment = {{"CLEFT_PROGRESS", teller.file("progress")}};
  environment["OPENBLAS_NUM_THREADS"] = environment["OMP_NUM_THREADS"] = std::to_string(settings_.threads);
  if (geteuid() == 0)
    environment["OMPI_ALLOW_RUN_AS_ROOT"] = environment["OMPI_ALLOW_RUN_AS_ROOT_CONFIRM"] = "1";
  const bool by_mpirun = argv.front() == "mpirun";  // srun's ranks may be on other machines
  const SharedMemory shared(by_mpirun ? teller.attempt.shared_memory() : "");
  shared.put_into(environment);
  const ProcessResult result =
      run_process(argv, teller.file(name + ".log"), environment, &stop_, teller.file(name + ".json"));
  if (stop_) throw Interrupted();
  return result;
}

Failure CaseWork::failure_of(const std::string& command, const ProcessResult& result,
                             const std::string& log) const {
  if (result.signal) return {command + " was ended by signal " + std::to_string(result.signal), true};
  const std::string own = own_words(log, command), said = own.empty() ? last_words(log) : own;
  const bool of_machine = was_killed(result) || own.empty() || said.find("disk") != std::string::npos ||
                          said.find("could not be") != std::string::npos || disk_is_full(folder_.path());
  return {command + " ended with exit code " + std::to_string(result.exit_code) + ": " + said, of_machine};
}

void CaseWork::solve(const std::vector<CaseOnItsWay*>& cases) const {
  for (int kills = 1;; ++kills) try {
      return solve_together(cases);
    } catch (const Failure& killed) {
      if (kills < most_kills) continue;
      for (CaseOnItsWay* one : cases) one->failure = killed;
      return;
    }
}

void CaseWork::solve_together(const std::vector<CaseOnItsWay*>& cases) const {
  const CaseOnItsWay& first = *cases.front();
  const Stopwatch watch;
  const std::string group = empty_group(first);
  std::vector<std::string> arguments;
  for (const CaseOnItsWay* one : cases) {
    write_case_file(one->file("case.toml"), *one->one);
    fs::copy_file(one->file("case.toml"), group + "/" + one->hash + ".toml");
    arguments.push_back(group + "/" + one->hash + ".toml");
  }
  arguments.insert(arguments.end(), {"--out", group, "--json"});
  if (!study_.estimate_errors) arguments.push_back("--no-estimate");
  const ProcessResult result = child("solve", arguments, first, "solve");
  const std::string log = text_of(first.file("solve.log"));
  if (was_killed(result)) throw failure_of("solve", result, log);
  Json list = figures_in(first.file("solve.json"));
  if (list.is_object()) list = Json::array({list});
  if (list.empty() && cases.size() > 1 && !result.success()) {  // whose fault was it?
    fs::remove_all(group);
    for (CaseOnItsWay* one : cases) solve({one});
    return;
  }
  for (CaseOnItsWay* one : cases) {
    const std::string out = group + "/" + one->hash + ".h5";
    for (const Json& figures : list)
      if (figures.value("out", "") == out) one->manifest["solver"] = figures;
    if (one->manifest.contains("solver")) one->manifest["solver"].erase("out");
    one->seconds += watch.seconds() / static_cast<double>(cases.size());
    one->memory = memory_in(list);
    if (!list.empty() && fs::exists(out)) {
      fs::rename(out, one->file("case.h5"));
      continue;
    }
    const std::string own = line_with(log, out);
    one->failure = failure_of("solve", result, own.empty() ? log : own);
  }
  fs::remove_all(group);
}

bool CaseWork::reuse(CaseOnItsWay& one, const std::string& published) const {
  const Stopwatch watch;
  if (!child("check", {published + "/case.h5"}, one, "check").success()) return false;
  one.manifest["solver"] = read_sealed(published + "/manifest.json").value("solver", Json::object());
  std::error_code error;
  fs::create_hard_link(published + "/case.h5", one.file("case.h5"), error);
  if (error) fs::copy_file(published + "/case.h5", one.file("case.h5"));
  write_case_file(one.file("case.toml"), *one.one);
  one.seconds += watch.seconds();
  return true;
}

void CaseWork::encode(const std::vector<CaseOnItsWay*>& cases) const {
  if (cases.size() > 1 && encode_together(cases)) return;
  for (CaseOnItsWay* one : cases) encode_alone(*one);
}

/// False if the process has not encoded them all: then each is encoded by itself.
bool CaseWork::encode_together(const std::vector<CaseOnItsWay*>& cases) const {
  const CaseOnItsWay& first = *cases.front();
  const Stopwatch watch;
  const std::string group = empty_group(first);
  std::vector<std::string> arguments;
  for (const CaseOnItsWay* one : cases) {
    const std::string snapshot = group + "/" + one->hash + ".h5";
    fs::create_symlink(fs::absolute(one->file("case.h5")), snapshot);
    arguments.push_back(snapshot);
  }
  arguments.insert(arguments.end(), {"--out", group, "--json"});
  for (const std::string& argument : first.one->encode.arguments()) arguments.push_back(argument);
  const ProcessResult result = child("encode", arguments, first, "encode");
  const Json list = figures_in(first.file("encode.json"));
  const bool all = result.success() && list.is_array() && list.size() == cases.size();
  for (std::size_t c = 0; all && c < cases.size(); ++c) {
    CaseOnItsWay& one = *cases[c];
    fs::rename(group + "/" + one.hash + ".dffd", one.file("case.dffd"));
    one.manifest["encoder"] = list[c];
    one.manifest["encoder"].erase("out");
  }
  fs::remove_all(group);
  for (CaseOnItsWay* one : cases) one->seconds += watch.seconds() / static_cast<double>(cases.size());
  return all;
}

void CaseWork::encode_alone(CaseOnItsWay& one) const {
  const Stopwatch watch;
  std::vector<std::string> arguments = {one.file("case.h5"), "--out", one.file("case.dffd"), "--json"};
  for (const std::string& argument : one.one->encode.arguments()) arguments.push_back(argument);
  ProcessResult result;
  int kills = 0;
  do result = child("encode", arguments, one, "encode");
  while (was_killed(result) && ++kills < most_kills);
  if (!result.success()) one.failure = failure_of("encode", result, text_of(one.file("encode.log")));
  one.manifest["encoder"] = figures_in(one.file("encode.json"));
  one.seconds += watch.seconds();
}

void CaseWork::check(const std::vector<CaseOnItsWay*>& cases) const {
  const Stopwatch watch;
  std::vector<std::string> files;
  for (const CaseOnItsWay* one : cases)
    files.insert(files.end(), {one->file("case.h5"), one->file("case.dffd")});
  const ProcessResult result = child("check", files, *cases.front(), "check");
  for (CaseOnItsWay* one : cases) one->seconds += watch.seconds() / static_cast<double>(cases.size());
  if (result.success()) return;
  if (cases.size() > 1) {  // whose fault was it?
    for (CaseOnItsWay* one : cases) check({one});
    return;
  }
  cases.front()->failure = failure_of("check", result, text_of(cases.front()->file("check.log")));
  cases.front()->failure->again = true;  // what was written is not what was meant: not the case's fault
}

bool CaseWork::publish(CaseOnItsWay& one) const {
  Json manifest = {{"format", "cleft-case"},
                   {"version", 2},
                   {"producer", producer()},
                   {"case", one.hash},
                   {"solve", one.one->snapshot_hash()},
                   {"study", study_.name},
                   {"sampling",
                    {{"method", study_.sampling.method},
                     {"count", study_.sampling.count},
                     {"seed", study_.sampling.seed},
                     {"level", study_.sampling.level},
                     {"unit_tensions", study_.sampling.unit_tensions}}}};
  for (const Parameter& row : parameter_table())
    std::visit([&](const auto& v) { manifest["parameters"][row.name] = v; },
               get_parameter(one.one->parameters, row));
  const CaseSize size = size_of(one.one->parameters);
  manifest["size"] = {{"nodes", size.nodes}, {"columns", size.columns}, {"memory", one.memory}};
  manifest["solver"] = one.manifest["solver"];
  manifest["encoder"] = one.manifest["encoder"];
  manifest["host"] = host_name();
  manifest["ranks"] = settings_.ranks;
  manifest["threads"] = settings_.threads;
  manifest["seconds"] = one.seconds;
  manifest["published"] = time_now();
  manifest["snapshot"] = study_.keep_snapshots ? "kept" : "dropped";
  std::vector<std::string> files = {"case.toml", "case.dffd"};
  if (study_.keep_snapshots) files.push_back("case.h5");
  for (const char* log : {"solve.log", "encode.log"})
    if (fs::exists(one.file(log)) && fs::file_size(one.file(log)) > 0) files.push_back(log);
  return folder_.publish(one.attempt, one.hash, std::move(manifest), files);
}

}  // namespace cleft
