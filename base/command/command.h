// What all commands share: exit codes, --version, progress, and figures as text or JSON.
#pragma once

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

/// A line of progress on stderr, overwritten in place on a terminal and omitted otherwise; also in the file
/// of CLEFT_PROGRESS.
class Progress {
 public:
  explicit Progress(std::string task);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  void operator()(const std::string& state);

 private:
  std::string task_, file_;
  bool terminal_, written_ = false;
};

}  // namespace cleft
