#include "explorer/session/command_table.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "explorer/session/commands.h"

namespace cleft {

void CommandWords::wrong(const std::string& what) const {
  throw InputError(command_ + ": " + what + " (usage: " + command_ + (usage_.empty() ? "" : " ") + usage_ +
                   ")");
}

std::string CommandWords::text(const std::string& what) {
  if (empty()) wrong("needs " + what);
  return words_[next_++];
}

double CommandWords::number(const std::string& what) {
  const std::string word = text(what);
  const double value = [&] {
    try {
      return parse_number(word, what);
    } catch (const InputError& e) {
      wrong(e.what());
    }
  }();
  if (!std::isfinite(value)) wrong(what + " '" + word + "' is not finite");
  return value;
}

double CommandWords::number_in(const std::string& what, double least, double greatest) {
  const double value = number(what);
  if (value < least || value > greatest)
    wrong(what + " " + shortest(value) + ": must be from " + shortest(least) + " to " + shortest(greatest));
  return value;
}

int CommandWords::whole(const std::string& what, int least, int greatest) {
  const double value = number(what);
  if (value != std::floor(value) || value < least || value > greatest)
    wrong(what + " " + shortest(value) + ": must be a whole number from " + std::to_string(least) + " to " +
          std::to_string(greatest));
  return static_cast<int>(value);
}

bool CommandWords::on_or_off() {
  const std::string word = text("on or off");
  if (word != "on" && word != "off") wrong("'" + word + "' is neither on nor off");
  return word == "on";
}

std::vector<double> CommandWords::numbers(const std::string& what, std::size_t least, std::size_t most) {
  const std::string word = text(what);
  std::vector<double> values;
  for (std::size_t begin = 0; begin <= word.size();) {
    const std::size_t end = std::min(word.find(',', begin), word.size());
    try {
      values.push_back(parse_number(word.substr(begin, end - begin), what));
    } catch (const InputError& e) {
      wrong(e.what());
    }
    begin = end + 1;
  }
  for (const double v : values)
    if (!std::isfinite(v)) wrong(what + " '" + word + "' is not finite");
  if (values.size() < least || values.size() > most)
    wrong(what + " '" + word + "' has " + std::to_string(values.size()) + " numbers");
  return values;
}

std::string CommandWords::rest() {
  std::string all;
  for (; next_ < words_.size(); ++next_) all += (all.empty() ? "" : " ") + words_[next_];
  return all;
}

void CommandWords::expect_end() const {
  if (!empty()) wrong("'" + words_[next_] + "' is too much");
}

const std::vector<CommandGroup>& command_groups() {
  static const std::vector<CommandGroup> groups{{"Study and cases", study_commands()},
                                                {"Time", time_commands()},
                                                {"View", view_commands()},
                                                {"Cuts", cut_commands()},
                                                {"Looking closer", closer_commands()},
                                                {"Questions to the study", answer_commands()},
                                                {"Session and output", session_commands()}};
  return groups;
}

const Command& find_command(const std::string& name) {
  std::vector<std::string> names;
  for (const CommandGroup& group : command_groups())
    for (const Command& command : group.commands) {
      if (command.name == name) return command;
      names.push_back(command.name);
    }
  throw InputError("'" + name + "' is no command" + did_you_mean(name, names) + "; `help` lists them all");
}

std::vector<std::string> split_line(const std::string& line) {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < line.size();) {
    if (std::isspace(static_cast<unsigned char>(line[i]))) {
      ++i;
      continue;
    }
    if (line[i] == '#') break;
    std::string word;
    while (i < line.size() && !std::isspace(static_cast<unsigned char>(line[i]))) {
      if (line[i] != '\'' && line[i] != '"') {
        word += line[i++];
        continue;
      }
      const std::size_t end = line.find(line[i], i + 1);
      if (end == std::string::npos) throw InputError("a quote is not closed: " + line);
      word += line.substr(i + 1, end - i - 1);
      i = end + 1;
    }
    words.push_back(word);
  }
  return words;
}

std::string quoted(const std::string& word) {
  if (!word.empty() && word.find_first_of(" \t\"'#") == std::string::npos) return word;
  const char quote = word.find('\'') == std::string::npos ? '\'' : '"';
  return quote + word + quote;
}

std::string help_sheet() {
  std::string sheet;
  for (const CommandGroup& group : command_groups()) {
    sheet += (sheet.empty() ? "" : "\n") + group.title + "\n";
    for (const Command& c : group.commands) {
      const std::string usage = "  " + c.name + (c.arguments.empty() ? "" : " ") + c.arguments;
      sheet += usage +
               (usage.size() < 38 ? std::string(38 - usage.size(), ' ') : "\n" + std::string(38, ' ')) +
               c.help + "\n";
    }
  }
  return sheet;
}

}  // namespace cleft
