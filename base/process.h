// Child processes.
#pragma once

#include <csignal>
#include <map>
#include <string>
#include <vector>

namespace cleft {

/// The folder of the running program, which also contains the other commands.
std::string executable_folder();
/// The path of `cleft NAME`: beside this program, or in the folder that the environment variable CLEFT_BIN
/// names.
std::string command_path(const std::string& name);

struct ProcessResult {
  int exit_code = 0;       ///< valid if signal is 0
  int signal = 0;          ///< the signal that ended it, or 0
  double peak_memory = 0;  ///< largest number of bytes that it, or one of its children, has held
  bool success() const { return exit_code == 0 && signal == 0; }
};

/// The number of requests to stop a run; a signal handler may increase it.
using StopCount = volatile std::sig_atomic_t;

/// Runs a program (argv[0] is its path or a name on PATH) to its end; both its outputs go to the file `log`,
/// or its standard output to `output`, if that is given. `environment` is added to this process's own. The
/// child leads its own process group, which Ctrl-C in a terminal does not reach: when *stop is 1 it gets
/// SIGTERM, and from 2 on, or if it has not ended within 5 s, the group is killed. The child does not outlive
/// this process: if this process is killed, so is the child (the kernel watches the thread that starts it,
/// which must wait for its end, as this function does), and if a signal ends it, the group (unfinished.h).
/// Throws std::runtime_error naming the program if it cannot be started.
ProcessResult run_process(const std::vector<std::string>& argv, const std::string& log,
                          const std::map<std::string, std::string>& environment,
                          const StopCount* stop = nullptr, const std::string& output = "");

}  // namespace cleft
