// What all commands share: exit codes, --version, progress, and figures as text or JSON.
#pragma once

#include <chrono>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "base/command/command_line.h"

namespace cleft {

using Json = nlohmann::ordered_json;

/// Parses the command line and runs `body`. Exit codes: 0 done, 1 failed, 2 wrong usage or input.
/// Messages go to stderr as "cleft solve: error: ...".
int run_command(CommandLine& line, int argc, char** argv, const std::function<void()>& body);

/// Prints figures on stdout: one JSON object with `as_json`, else a line "name: value" for each.
void print_figures(const Json& figures, bool as_json);

/// The environment variable that names a file into which a command writes its progress, for its parent
/// process.
inline constexpr const char* progress_file = "CLEFT_PROGRESS";

/// A line of progress on stderr: on a terminal overwritten in place; elsewhere a line a minute, if the
/// command is nobody's child by CLEFT_PROGRESS, in whose file each state is too. A state that ends in "N of
/// M" is followed by the percentage, and by the time that the rest of this step takes at its pace so far.
class Progress {
 public:
  explicit Progress(std::string task);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  void operator()(const std::string& state);
  /// The same where the part of the whole work that is done, 0 to 1, is known.
  void operator()(const std::string& state, double part);

 private:
  using Clock = std::chrono::steady_clock;
  std::string with_time_left(const std::string& state);
  void write(const std::string& state, const std::string& line);

  std::string task_, file_;
  bool terminal_, silent_, written_ = false;
  Clock::time_point begun_ = Clock::now(), last_line_ = begun_;
  std::string step_;              // the state before its "N of M"
  Clock::time_point step_began_;  // with this N:
  double first_ = 0;
};

/// "12 %", and " (about 2 min left)" where the pace is known: of step `done` of `all`, where `first` was
/// begun `seconds` ago.
std::string part_and_time_left(double first, double done, double all, double seconds);

}  // namespace cleft
