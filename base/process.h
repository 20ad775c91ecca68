// Child processes.
#pragma once

#include <csignal>
#include <map>
#include <string>
#include <vector>

namespace cleft {

/// The folder of the running program: its sister commands stand beside it.
std::string executable_folder();

struct ProcessResult {
  int exit_code = 0;  ///< valid where signal is 0
  int signal = 0;     ///< the signal that ended it, or 0
  bool success() const { return exit_code == 0 && signal == 0; }
};

/// Runs a program (argv[0] is its path or a name on PATH) to its end; both its outputs go to the file `log`.
/// `environment` is added to this process's own. Once *stop is a signal's number, the child is sent SIGTERM.
/// Throws std::runtime_error naming the program where it cannot be started.
ProcessResult run_process(const std::vector<std::string>& argv, const std::string& log,
                          const std::map<std::string, std::string>& environment,
                          const volatile std::sig_atomic_t* stop = nullptr);

}  // namespace cleft
