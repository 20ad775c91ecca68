// The two kinds of errors: a user's mistake, and a broken invariant.
#pragma once

#include <sstream>
#include <stdexcept>
#include <string>

namespace cleft {

/// Wrong input. The message names the value, its place and the remedy. Commands exit with code 2.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A file that cannot be read in its format: "case.h5: <what is wrong>".
struct FileError : InputError {
  FileError(const std::string& file, const std::string& what) : InputError(file + ": " + what) {}
};

/// Runs a function; InputErrors that it throws about the content of a file become FileErrors with its name.
template <class Function>
auto told_of_file(const std::string& file, Function&& function) {
  try {
    return function();
  } catch (const FileError&) {
    throw;
  } catch (const InputError& e) {
    throw FileError(file, e.what());
  }
}

/// Collects users' mistakes, so that all are reported together.
class Mistakes {
 public:
  /// Runs a function and stores an InputError that it throws; returns true if it throws none.
  template <class Function>
  bool collect(Function&& function) {
    try {
      function();
      return true;
    } catch (const InputError& e) {
      add(e.what());
      return false;
    }
  }
  void add(const std::string& what) { text_ += (text_.empty() ? "" : "\n  ") + what; }
  void throw_if_any() const {
    if (!text_.empty()) throw InputError(text_);
  }

 private:
  std::string text_;
};

[[noreturn]] inline void broken_invariant(const char* file, int line, const std::string& what) {
  throw std::logic_error(std::string(file) + ":" + std::to_string(line) + ": broken invariant: " + what);
}

}  // namespace cleft

/// A check for bugs, always on: prints both operands. Not for users' mistakes.
#define CLEFT_CHECK(left, op, right)                                                                     \
  do {                                                                                                   \
    const auto& cleft_left = (left);                                                                     \
    const auto& cleft_right = (right);                                                                   \
    if (!(cleft_left op cleft_right)) {                                                                  \
      std::ostringstream cleft_message;                                                                  \
      cleft_message << #left " " #op " " #right " (" << cleft_left << " against " << cleft_right << ")"; \
      ::cleft::broken_invariant(__FILE__, __LINE__, cleft_message.str());                                \
    }                                                                                                    \
  } while (false)
