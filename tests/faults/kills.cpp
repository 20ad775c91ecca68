#include "tests/faults/kills.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>

#include "base/stopwatch.h"
#include "base/text.h"

namespace cleft::faults {

namespace fs = std::filesystem;

namespace {

struct Process {
  pid_t id, parent;
  std::string name;
};

std::optional<Process> process_of(const std::string& id) {
  std::ifstream file("/proc/" + id + "/stat");
  std::string text;
  if (!std::getline(file, text)) return {};
  const std::size_t open = text.find('('), close = text.rfind(')');
  char state = 0;
  pid_t parent = 0;
  std::istringstream(text.substr(close + 1)) >> state >> parent;
  if (state == 'Z') return {};
  return Process{std::stoi(id), parent, text.substr(open + 1, close - open - 1)};
}

/// All that descend from a process, parents first.
std::vector<Process> descendants(pid_t of) {
  std::vector<Process> all, found;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    const std::string id = entry.path().filename().string();
    if (std::all_of(id.begin(), id.end(), [](char c) { return c >= '0' && c <= '9'; }))
      if (const auto process = process_of(id)) all.push_back(*process);
  }
  std::vector<pid_t> parents = {of};
  for (std::size_t i = 0; i < parents.size(); ++i)
    for (const Process& process : all)
      if (process.parent == parents[i]) {
        found.push_back(process);
        parents.push_back(process.id);
      }
  return found;
}

bool is_gone(pid_t id) { return !process_of(std::to_string(id)); }

/// A run in parallel with this program.
class Driver {
 public:
  Driver(std::vector<std::string> command, const std::string& log) : id_(fork()) {
    if (id_ != 0) return;
    std::vector<char*> argv;
    for (std::string& word : command) argv.push_back(word.data());
    argv.push_back(nullptr);
    if (!freopen(log.c_str(), "w", stderr) || dup2(STDERR_FILENO, STDOUT_FILENO) < 0) _exit(126);
    execv(argv[0], argv.data());
    _exit(127);
  }
  ~Driver() {
    if (runs()) kill(id_, SIGKILL), waitpid(id_, nullptr, 0);
  }
  Driver(const Driver&) = delete;
  Driver& operator=(const Driver&) = delete;

  pid_t id() const { return id_; }
  bool runs() {
    if (!ended_ && waitpid(id_, &status_, WNOHANG) == id_) ended_ = true;
    return !ended_;
  }
  bool succeeded() const { return ended_ && WIFEXITED(status_) && WEXITSTATUS(status_) == 0; }

 private:
  pid_t id_;
  int status_ = 0;
  bool ended_ = false;
};

/// Nothing that a killed driver had started lives on.
void expect_no_orphans(const std::vector<Process>& children) {
  const Stopwatch watch;
  constexpr double enough = 60;  // seconds; a few hundredths, but a rank whose libraries are still being
                                 // loaded ends after that, which takes long where the machine is busy
  for (const Process& child : children)
    while (!is_gone(child.id)) {
      promise(watch.seconds() < enough, child.name + " outlives its killed driver");
      usleep(10'000);
    }
}

/// Kills one process of a run; whether there was one.
bool kill_one(Driver& driver, KillReport& report, std::mt19937& random) {
  const std::vector<Process> children = descendants(driver.id());
  const auto among = [&](std::size_t count) {
    return std::uniform_int_distribution<std::size_t>(0, count - 1)(random);
  };
  if (!driver.runs()) return false;
  ++report.kills;
  if (children.empty() || among(3) == 0) {
    kill(driver.id(), SIGKILL);
    while (driver.runs()) usleep(1000);
    ++report.drivers;
    expect_no_orphans(children);
    return true;
  }
  const Process& victim = children[among(children.size())];
  kill(victim.id, SIGKILL);
  ++(victim.parent == driver.id() ? report.workers : report.ranks);
  return true;
}

}  // namespace

KillReport kill_at_random(const StudyUnderFault& study, int kills, std::mt19937& random) {
  KillReport report;
  while (report.kills < kills) {
    const std::string folder = study.place() + "/killed" + std::to_string(report.studies);
    std::map<std::string, std::string> known;
    const auto expect_none_lost = [&] {
      const auto now = study.published(folder);
      for (const auto& [hash, token] : known) {
        promise(now.contains(hash), folder + ": the published case " + hash + " is lost");
        promise(now.at(hash) == token, folder + ": the published case " + hash + " was replaced");
      }
      known = now;
    };
    for (int starts = 0; starts < 40; ++starts) {
      Driver driver(study.command(folder), folder + ".log");
      std::optional<Driver> other;
      if (random() % 4 == 0) other.emplace(study.command(folder), folder + ".other.log"), ++report.raced;
      while (driver.runs() && report.kills < kills) {
        const double wait = std::exponential_distribution<double>(1 / 0.5)(random);
        usleep(static_cast<useconds_t>(1e6 * std::min(wait, 3.)));
        if (driver.runs()) kill_one(driver, report, random);
        expect_none_lost();
      }
      while (driver.runs() || (other && other->runs())) usleep(10'000);
      expect_none_lost();
      if (driver.succeeded() || report.kills >= kills) break;
    }
    study.finish(folder);
    expect_none_lost();
    fs::remove_all(folder);
    ++report.studies;
  }
  return report;
}

}  // namespace cleft::faults
