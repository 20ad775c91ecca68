#include "params/run/leftovers.h"

#include <signal.h>

#include <cerrno>
#include <chrono>
#include <filesystem>
#include <regex>

#include "params/run/lock.h"

namespace cleft {

namespace fs = std::filesystem;

namespace {

constexpr std::chrono::seconds least_age(10);
/// Files of Slurm's commands are written to at their end only, and the maker may be on another machine.
constexpr std::chrono::hours least_age_of_slurm(1);

bool is_alive(const std::string& number) {
  const pid_t process = static_cast<pid_t>(std::stol(number));
  return kill(process, 0) == 0 || errno == EPERM;
}

/// Removes what is older, has such a name, and a dead maker, whose number is the first group of the
/// expression.
void sweep(const std::string& folder, const std::regex& names, std::chrono::seconds older) {
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    std::smatch found;
    if (!std::regex_match(name, found, names) || is_alive(found[1])) continue;
    const auto age = fs::file_time_type::clock::now() - entry.last_write_time(error);
    const fs::path locked = entry.is_directory(error) ? entry.path() / "lock" : entry.path();
    if (!error && age > older && !Lock::is_held(locked.string())) fs::remove_all(entry.path(), error);
  }
}

}  // namespace

void sweep_leftovers(const std::string& study) {
  static const std::regex parts(R"(.*\.(\d{1,9})\.part(?:\.\w+)?)"), probes(R"(\.probe\.(\d{1,9}))"),
      of_slurm(R"(\.\w+\.(\d{1,9})\.(?:log|out))");
  sweep(study, parts, least_age);
  sweep(study, probes, least_age);
  sweep(study + "/slurm", of_slurm, least_age_of_slurm);
}

void sweep_pack_logs(const std::string& study, const std::string& own) {
  static const std::regex of_packings(R"(\.pack\.(\d+)\.log)");
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(study, ignored))
    if (entry.path() != fs::path(own) && std::regex_match(entry.path().filename().string(), of_packings))
      fs::remove(entry.path(), ignored);
}

}  // namespace cleft
