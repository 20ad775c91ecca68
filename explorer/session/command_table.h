// Each action of a user is a line of text: the table of commands, and the syntax of lines.
//
// To add one: a row in the table of the file commands_*.cpp it belongs to. Help sheet, errors for unknown
// names, scripts, recordings and the window's command box follow from the row.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "base/error.h"

namespace cleft {

class Session;

/// The words after a command's name, read one after another.
class CommandWords {
 public:
  CommandWords(std::string command, std::string usage, std::vector<std::string> words)
      : command_(std::move(command)), usage_(std::move(usage)), words_(std::move(words)) {}

  bool empty() const { return next_ == words_.size(); }
  /// Throws InputError with the usage if there is none left.
  std::string text(const std::string& what);
  double number(const std::string& what);
  double number_in(const std::string& what, double least, double greatest);
  /// A whole number; of cases, from 1.
  int whole(const std::string& what, int least, int greatest);
  bool on_or_off();
  std::vector<double> numbers(const std::string& what, std::size_t least, std::size_t most);  ///< x,y,z
  /// All that is left, with blanks between.
  std::string rest();
  [[noreturn]] void wrong(const std::string& what) const;
  void expect_end() const;

 private:
  std::string command_, usage_;
  std::vector<std::string> words_;
  std::size_t next_ = 0;
};

struct Command {
  std::string name, arguments, help;
  void (*run)(Session&, CommandWords&);
  /// Commands that only query or write are not recorded; of several `latest` in a row the last is recorded.
  enum Recording { all, latest, none } recorded = all;
  /// Whether it changes only how things are looked at, as time and camera, so that it is no step of `undo
  /// any`.
  bool looks = false;
};

struct CommandGroup {
  std::string title;
  std::span<const Command> commands;
};
const std::vector<CommandGroup>& command_groups();

/// Throws InputError naming the nearest command.
const Command& find_command(const std::string& name);

/// Words of a line: separated by blanks, '...' or "..." keep blanks, # begins a comment. Throws InputError if
/// a quote is not closed.
std::vector<std::string> split_line(const std::string& line);
/// A word with the quotes that a line needs.
std::string quoted(const std::string& word);

/// All commands with arguments and help, group by group.
std::string help_sheet();

}  // namespace cleft
