#include "base/command/command.h"

#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <iostream>

#include "base/error.h"
#include "base/text.h"

namespace cleft {

namespace {

/// In one piece, so that a log has all of it or, where it cannot be written, nothing.
void complain(const CommandLine& line, const char* kind, const std::string& what) {
  std::cerr << line.name() + ": " + kind + ": " + what + '\n';
}

}  // namespace

int run_command(CommandLine& line, int argc, char** argv, const std::function<void()>& body) {
  if (const int code = line.parse(argc, argv, producer()); code >= 0) return code;
  try {
    body();
    if (!std::cout.flush()) throw std::runtime_error("standard output could not be written");
    return 0;
  } catch (const InputError& e) {
    complain(line, "error", e.what());
    return 2;
  } catch (const std::exception& e) {
    complain(line, "failed", e.what());
    return 1;
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

Progress::Progress(std::string task) : task_(std::move(task)), terminal_(isatty(STDERR_FILENO) == 1) {
  if (const char* file = std::getenv(progress_file)) file_ = file;
}

Progress::~Progress() {
  if (written_) std::cerr << "\r\033[K" << std::flush;
}

void Progress::operator()(const std::string& state) {
  if (!file_.empty()) std::ofstream(file_) << state << "\n";  // nothing depends on it
  if (!terminal_) return;
  std::cerr << "\r\033[K" << task_ << ": " << state << std::flush;
  written_ = true;
}

}  // namespace cleft
