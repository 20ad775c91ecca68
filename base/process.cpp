#include "base/process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "base/stopwatch.h"
#include "base/unfinished.h"

extern char** environ;

namespace cleft {

namespace {

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> list;
  for (std::string& text : texts) list.push_back(text.data());
  list.push_back(nullptr);
  return list;
}

std::vector<std::string> merged_environment(const std::map<std::string, std::string>& added) {
  std::vector<std::string> entries;
  for (char** entry = environ; *entry; ++entry) {
    const std::string text = *entry;
    if (!added.contains(text.substr(0, text.find('=')))) entries.push_back(text);
  }
  for (const auto& [name, value] : added) entries.push_back(name + "=" + value);
  return entries;
}

/// A file descriptor that is closed at the end.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  operator int() const { return number_; }  // NOLINT: meant to be passed to system calls

 private:
  int number_;
};

int opened(const std::string& path) {
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (file < 0) throw std::runtime_error(path + ": could not be written: " + std::strerror(errno));
  return file;
}

/// In the child: what may be called between fork and exec in a process with threads, and no more.
[[noreturn]] void become(char** argv, char** variables, int out, int log, pid_t parent, int failure) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);     // mpirun may hang if it is requested to end while it starts
  if (getppid() != parent) _exit(127);  // it has died already
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  const int nothing = open("/dev/null", O_RDONLY);
  dup2(nothing, STDIN_FILENO), dup2(out, STDOUT_FILENO), dup2(log, STDERR_FILENO);
  close(nothing);
  execvpe(argv[0], argv, variables);
  const int error = errno;
  if (write(failure, &error, sizeof error) < 0) _exit(126);
  _exit(127);
}

/// Waits for the child's end, and forwards `stop`. A child that does not follow in a few seconds is killed:
/// mpirun, requested to end while it starts, may go on.
int awaited(pid_t child, const StopCount* stop, rusage& usage) {
  constexpr double patience = 5;  // seconds
  const Descriptor end(static_cast<int>(syscall(SYS_pidfd_open, child, 0)));
  int status = 0, told = 0;
  Stopwatch since_told;
  for (;;) {
    const pid_t ended = wait4(child, &status, WNOHANG, &usage);
    if (ended == child) return status;
    if (ended < 0 && errno != EINTR) throw std::runtime_error("the end of a child could not be awaited");
    const bool again = told > 0 && since_told.seconds() > patience;
    if (stop && (*stop > told || again)) {
      told = again ? told + 1 : *stop, since_told = Stopwatch();
      kill(told == 1 ? child : -child, told == 1 ? SIGTERM : SIGKILL);
    }
    pollfd ending{end, POLLIN, 0};
    poll(&ending, 1, end < 0 ? 10 : 50);  // without pidfd (Linux before 5.3) it is polled
  }
}

}  // namespace

std::string executable_folder() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path().string();
}

std::string command_path(const std::string& name) {
  const char* folder = std::getenv("CLEFT_BIN");
  return (folder ? std::string(folder) : executable_folder()) + "/cleft-" + name;
}

ProcessResult run_process(const std::vector<std::string>& argv, const std::string& log,
                          const std::map<std::string, std::string>& environment, const StopCount* stop,
                          const std::string& output) {
  std::vector<std::string> arguments = argv, variables = merged_environment(environment);
  const std::vector<char*> argument_list = pointers(arguments), variable_list = pointers(variables);
  const Descriptor log_file(opened(log)), output_file(output.empty() ? -1 : opened(output));
  int failure[2];
  if (pipe2(failure, O_CLOEXEC) != 0) throw std::runtime_error("no pipe could be made");
  const Descriptor read_end(failure[0]);
  const pid_t self = getpid(), child = fork();
  if (child == 0)
    become(const_cast<char**>(argument_list.data()), const_cast<char**>(variable_list.data()),
           output.empty() ? log_file : output_file, log_file, self, failure[1]);
  int error = child < 0 ? errno : 0;
  close(failure[1]);
  rusage usage{};
  if (child > 0 && read(read_end, &error, sizeof error) == sizeof error) awaited(child, nullptr, usage);
  if (error != 0) throw std::runtime_error(argv[0] + " could not be started: " + std::strerror(error));
  const UnfinishedChild unfinished(child);
  const int status = awaited(child, stop, usage);
  const double peak = 1024. * static_cast<double>(usage.ru_maxrss);
  if (WIFSIGNALED(status)) return {0, WTERMSIG(status), peak};
  return {WEXITSTATUS(status), 0, peak};
}

}  // namespace cleft
