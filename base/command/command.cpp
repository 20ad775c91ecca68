#include "base/command/command.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <regex>

#include "base/message.h"
#include "base/text.h"
#include "base/unfinished.h"

namespace cleft {

namespace {

/// In one piece, so that a log has all of it or, where it cannot be written, nothing.
void complain(const CommandLine& line, const char* kind, const std::string& what) {
  std::cerr << line.name() + ": " + kind + ": " + what + '\n';
}

/// Cut to what one row of the terminal holds: a row alone can be cleared.
std::string fitted(const std::string& text) {
  winsize terminal{};
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &terminal) != 0 || terminal.ws_col == 0) return text;
  std::size_t most = terminal.ws_col - 1U;
  if (text.size() <= most) return text;
  constexpr unsigned char mask = 0xc0, continued = 0x80;  // no character of UTF-8 is cut in two
  while (most > 0 && (static_cast<unsigned char>(text[most]) & mask) == continued) --most;
  return text.substr(0, most);
}

}  // namespace

int run_command(CommandLine& line, int argc, char** argv, const std::function<void()>& body) {
  if (const int code = line.parse(argc, argv, producer()); code >= 0) return code;
  end_without_leftovers();
  try {
    body();
    if (!std::cout.flush()) throw std::runtime_error("standard output could not be written");
    wait_if_ending();
    return 0;
  } catch (const std::exception& e) {
    wait_if_ending();
    const bool mistake = is_users_mistake(e);
    complain(line, mistake ? "error" : "failed", message_of(e));
    return mistake ? 2 : 1;
  } catch (...) {  // Trilinos throws numbers
    complain(line, "failed", "an error without a message");
    return 1;
  }
}

void print_figures(const Json& figures, bool as_json) {
  if (as_json) {
    std::cout << figures.dump(2) << '\n';
    return;
  }
  for (const auto& [name, value] : figures.items()) {
    if (value.is_object()) {
      std::cout << name << ":\n";
      for (const auto& [inner, figure] : value.items())
        std::cout << "  " << inner << ": " << (figure.is_string() ? figure.get<std::string>() : figure.dump())
                  << '\n';
    } else {
      std::cout << name << ": " << (value.is_string() ? value.get<std::string>() : value.dump()) << '\n';
    }
  }
}

std::string part_and_time_left(double first, double done, double all, double seconds) {
  constexpr double enough = 5;  // seconds, for a pace
  const std::string part = std::to_string(static_cast<int>(100 * (done - 1) / all)) + " %";
  if (!(done > first && seconds >= enough)) return part;
  const double left = seconds * (all - done + 1) / (done - first);
  const bool minutes = left > 90;
  return part + " (about " + std::to_string(static_cast<int>(std::lround(minutes ? left / 60 : left))) +
         (minutes ? " min left)" : " s left)");
}

Progress::Progress(std::string task)
    : task_(std::move(task)), terminal_(isatty(STDERR_FILENO) == 1), silent_(CommandLine::quiet()) {
  if (const char* file = std::getenv(progress_file)) file_ = file;
}

Progress::~Progress() {
  if (written_) std::cerr << "\r\033[K" << std::flush;
}

void Progress::operator()(const std::string& state) { write(state, with_time_left(state)); }

void Progress::operator()(const std::string& state, double part) {
  const std::chrono::duration<double> elapsed = Clock::now() - begun_;
  write(state, state + ", " + part_and_time_left(1, 1 + part, 1, elapsed.count()));
}

void Progress::write(const std::string& state, const std::string& line) {
  if (!file_.empty()) std::ofstream(file_) << state << "\n";  // nothing depends on it
  if (silent_) return;
  if (terminal_) {
    std::cerr << "\r\033[K" << fitted(printable(task_ + ": " + line)) << std::flush;
    written_ = true;
    return;
  }
  if (!file_.empty() || Clock::now() - last_line_ < std::chrono::minutes(1)) return;
  std::cerr << task_ + ": " + line + "\n";
  last_line_ = Clock::now();
}

std::string Progress::with_time_left(const std::string& state) {
  static const std::regex counted(R"((.*?)(\d+) of (\d+)$)");
  std::smatch parts;
  if (!std::regex_match(state, parts, counted)) return state;
  const double done = std::stod(parts[2]), all = std::stod(parts[3]);
  if (parts[1] != step_ || done < first_) step_ = parts[1], step_began_ = Clock::now(), first_ = done;
  if (!(all > 0)) return state;
  const std::chrono::duration<double> elapsed = Clock::now() - step_began_;
  return state + ", " + part_and_time_left(first_, done, all, elapsed.count());
}

}  // namespace cleft
