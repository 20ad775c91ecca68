// Runs the commands as a user would.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

struct Outcome {
  int exit_code;
  std::string output;  ///< standard output and error
};

/// Runs a program of the build, e.g. run_cleft("solve", {"a.toml", "--out", "a.h5"}).
Outcome run_cleft(const std::string& command, const std::vector<std::string>& arguments);

/// The same of so many processes under mpirun.
Outcome cleft_on_ranks(const std::string& command, int ranks, const std::vector<std::string>& arguments);

/// `command` of the shell.
Outcome in_shell(const std::string& command);

/// `command` of the shell where no file may grow beyond `kilobytes`, as on a full disk.
Outcome on_a_full_disk(int kilobytes, const std::string& command);

/// What a command printed with --json, behind what a library may have written before.
nlohmann::json figures_of(const Outcome& outcome);

/// Fails the test, with the output, where the exit code differs.
Outcome expect_success(Outcome outcome);
