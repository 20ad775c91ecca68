#include "encoder/import/read_apart.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <exception>
#include <stdexcept>

#include "base/error.h"

namespace cleft {

namespace {

constexpr int refused = 2, failed = 1;  // exit codes of the process

/// What the library prints goes to `output`, and between two zeros the message of what is thrown.
[[noreturn]] void run_child(int output, const std::function<void()>& read) {
  const int nowhere = ::open("/dev/null", O_WRONLY);
  if (nowhere >= 0) ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(output, STDERR_FILENO);
  int code = 0;
  std::string message(1, '\0');
  try {
    read();
  } catch (const InputError& e) {
    code = refused, message += e.what();
  } catch (const std::exception& e) {
    code = failed, message += e.what();
  }
  message += '\0';
  if (::write(output, message.data(), message.size()) < 0) code = failed;
  std::exit(code);  // libraries close here, which shows what they could not read
}

/// All that comes out of a pipe until it is closed.
std::string text_of(int input) {
  std::string text;
  std::array<char, 1024> part{};
  for (ssize_t n; (n = ::read(input, part.data(), part.size())) != 0;) {
    if (n < 0 && errno != EINTR) break;
    if (n > 0) text.append(part.data(), static_cast<std::size_t>(n));
  }
  return text;
}

}  // namespace

void read_apart(const std::string& path, const std::function<void()>& read) {
  std::array<int, 2> pipe{};
  if (::pipe(pipe.data()) != 0) throw std::runtime_error("no pipe can be made");
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error("no process can be made");
  if (child == 0) run_child(pipe[1], read);
  ::close(pipe[1]);
  const std::string all = text_of(pipe[0]);
  ::close(pipe[0]);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  const std::size_t first = all.find('\0'), last = all.rfind('\0');
  const std::string message =
      first < last && last != std::string::npos ? all.substr(first + 1, last - first - 1) : "";
  const bool hdf5_complains = all.find("HDF5") != std::string::npos;
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0 && !hdf5_complains) return;
  if (WIFEXITED(status) && WEXITSTATUS(status) == refused && !message.empty()) throw InputError(message);
  throw FileError(path, "is damaged: the library that reads it " +
                            (message.empty() ? std::string("gave up") : "says: " + message));
}

}  // namespace cleft
