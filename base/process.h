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
  int exit_code = 0;       ///< valid where signal is 0
  int signal = 0;          ///< the signal that ended it, or 0
  double peak_memory = 0;  ///< most bytes that it, or one of its own children, has held
  bool success() const { return exit_code == 0 && signal == 0; }
};

/// How often a run was asked to stop, as a signal handler may count it.
using StopCount = volatile std::sig_atomic_t;

/// Runs a program (argv[0] is its path or a name on PATH) to its end; both its outputs go to the file `log`,
/// or its standard output to `output`, where one is given. `environment` is added to this process's own.
///
/// The child is the head of a process group of its own, which a terminal's Ctrl-C does not reach: once *stop
/// is 1 it is sent SIGTERM, from 2 on the group is killed. It does not outlive this process, even where that
/// is killed: SIGTERM then ends it. (The kernel watches the thread that starts it, which must wait for its
/// end, as this does.) Throws std::runtime_error naming the program where it cannot be started.
ProcessResult run_process(const std::vector<std::string>& argv, const std::string& log,
                          const std::map<std::string, std::string>& environment,
                          const StopCount* stop = nullptr, const std::string& output = "");

}  // namespace cleft
