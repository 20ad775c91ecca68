// The options of a command. CLI11 parses them, and only command_line.cpp includes it: with CLI11's headers a
// command takes three times as long to compile.
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
class Validator;
}  // namespace CLI

namespace cleft {

/// What the text of an option has to be; says so in the help and in the message of a refusal.
using Check = std::shared_ptr<const CLI::Validator>;

Check at_least(double least);               ///< a finite number of at least `least`
Check above(double least);                  ///< a finite number above `least`
Check in_range(int least, int most);        ///< both ends belong to the range
Check in_range(double least, double most);  ///< both ends belong to the range
Check one_of(std::vector<std::string> texts);
template <class Value>
Check one_of(const std::map<std::string, Value>& table) {
  std::vector<std::string> names;
  for (const auto& [name, value] : table) names.push_back(name);
  return one_of(std::move(names));
}
Check nonnegative();
Check nonexistent_path();

/// One option. Each function returns the option itself, so that they can be chained.
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}
  Option* required();
  Option* capture_default_str();  ///< the help shows the value that the variable has now
  Option* check(const Check& check);
  Option* delimiter(char delimiter);     ///< several values in one argument, with `delimiter` between them
  Option* expected(int count);           ///< number of values
  Option* allow_extra_args(bool allow);  ///< false: one value for each time that the option is given
  Option* needs(const Option* other);
  Option* excludes(const Option* other);
  Option* group(const std::string& name);  ///< "": the help does not show the option

 private:
  CLI::Option* option_;
};

class CommandLine {
 public:
  CommandLine(const std::string& description, const std::string& name);
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  /// An option "--name", or a positional argument "NAME", whose value goes to `value`. Defined in
  /// command_line.cpp for the types that are listed there. The option belongs to the command line.
  template <class Value>
  Option* add_option(const std::string& name, Value& value, const std::string& help);
  Option* add_flag(const std::string& name, bool& value, const std::string& help);
  /// A flag that prints the text and ends the command with exit code 0, as --help does.
  Option* add_report(const std::string& name, std::function<std::string()> text, const std::string& help);
  /// Text below the options in the help; the function makes it when the help is shown.
  void footer(const std::string& text);
  void footer(std::function<std::string()> text);
  /// How often the option was given.
  [[nodiscard]] std::size_t count(const std::string& name) const;
  [[nodiscard]] std::string name() const;  ///< "cleft solve"
  /// Whether --quiet was given, which every command has: no lines of progress.
  static bool quiet();

  /// Sets the variables. Returns an exit code where the command shall end at once: 0 after --help and
  /// --version, 2 after a wrong usage, which stderr has been told; else -1.
  int parse(int argc, char** argv, const std::string& version);

 private:
  std::unique_ptr<CLI::App> app_;
  std::deque<Option> options_;
};

}  // namespace cleft
