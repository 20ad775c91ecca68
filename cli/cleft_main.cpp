// cleft: runs the subcommand's executable in the same folder, cleft solve -> cleft-solve.
#include <unistd.h>

#include <iostream>
#include <string>
#include <vector>

#include "base/process.h"
#include "base/text.h"

namespace {

struct Command {
  std::string name, help;
};
const std::vector<Command> commands = {
    {"run", "run a study of many cases"},
    {"status", "what of a study is done"},
    {"solve", "simulate a growing cut"},
    {"body", "mesh a body with its cuts, to solve it"},
    {"encode", "fit a field to a snapshot"},
    {"eval", "displacements of a field"},
    {"cut", "cut a surface mesh along a path"},
    {"haptic", "feel and cut a mesh"},
    {"explore", "look at a study, or draw it"},
    {"info", "what a file holds"},
    {"check", "verify files and studies"},
    {"find", "cases where a condition holds"},
    {"advise", "settings for an error"},
    {"chart", "speed against accuracy"},
    {"export", "write files for ParaView"},
    {"import", "take another program's series"},
    {"decode", "a field as its source's series"},
    {"pack", "a study's fields in one file"},
    {"interpolate", "a case never simulated"},
    {"certify", "a bound of its error"},
    {"residual", "how far a series is from solved"},
    {"analyze", "what a figure depends on"},
    {"fit", "parameters that explain measurements"},
    {"propose", "the next cases of a study"},
};

std::string usage() {
  std::string text = "Usage: cleft COMMAND [OPTIONS]\n       cleft help COMMAND\n\nCommands:\n";
  for (const auto& [name, help] : commands)
    text += "  " + name + std::string(13 - name.size(), ' ') + help + "\n";
  return text + "\nOptions: --help, --version. Exit codes: 0 done, 1 failed, 2 wrong usage or input.\n";
}

}  // namespace

int main(int argc, char** argv) {
  const std::string word = argc > 1 ? argv[1] : "";
  const bool help = word == "help" && argc > 2;
  if (!help && (word == "--help" || word == "-h" || word == "help")) return std::cout << usage(), 0;
  if (word == "--version") return std::cout << cleft::producer() << "\n", 0;
  if (word.empty()) return std::cerr << usage(), 2;

  std::vector<std::string> names;
  for (const Command& command : commands) names.push_back(command.name);
  const std::string wanted = help ? argv[2] : word;
  for (const std::string& name : names)
    if (name == wanted) {
      const std::string program = cleft::executable_folder() + "/cleft-" + name;
      std::string flag = "--help";
      char* const for_help[] = {argv[2], flag.data(), nullptr};
      execv(program.c_str(), help ? for_help : argv + 1);
      return std::cerr << "cleft: failed: " << program
                       << " could not be started; is the installation complete?\n",
             1;
    }
  return std::cerr << "cleft: error: unknown command '" << wanted << "'" << cleft::did_you_mean(wanted, names)
                   << " (see cleft --help)\n",
         2;
}
