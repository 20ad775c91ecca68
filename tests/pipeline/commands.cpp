#include "tests/pipeline/commands.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "base/process.h"
#include "base/text.h"
#include "tests/support/temporary_folder.h"

namespace {

Outcome run(const std::vector<std::string>& argv) {
  const TemporaryFolder folder;
  std::map<std::string, std::string> environment{{"OMPI_ALLOW_RUN_AS_ROOT", "1"},
                                                 {"OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1"}};
  // Ranks that wait for messages make way for the others. A process alone would make way for all that runs
  // beside it, at every call of MPI.
  if (argv.front() == "mpirun" || std::find(argv.begin(), argv.end(), "--ranks") != argv.end())
    environment["OMPI_MCA_mpi_yield_when_idle"] = "1";
  const cleft::ProcessResult result = cleft::run_process(argv, folder / "log", environment);
  return {result.signal ? -result.signal : result.exit_code, cleft::read_text_file(folder / "log")};
}

}  // namespace

Outcome run_cleft(const std::string& command, const std::vector<std::string>& arguments) {
  std::vector<std::string> argv = {CLEFT_BIN "/cleft", command};
  argv.insert(argv.end(), arguments.begin(), arguments.end());
  return run(argv);
}

Outcome cleft_on_ranks(const std::string& command, int ranks, const std::vector<std::string>& arguments) {
  std::vector<std::string> argv = {"mpirun",
                                   "--oversubscribe",
                                   "--bind-to",
                                   "none",
                                   "-n",
                                   std::to_string(ranks),
                                   CLEFT_BIN "/cleft-" + command};
  argv.insert(argv.end(), arguments.begin(), arguments.end());
  return run(argv);
}

Outcome in_shell(const std::string& command) { return run({"bash", "-c", command}); }

Outcome on_a_full_disk(int kilobytes, const std::string& command) {
  // The signal is ignored, so that writing fails as it does where no space is left. ulimit counts blocks of
  // 1024 bytes.
  return run({"bash", "-c", "trap '' XFSZ; ulimit -f " + std::to_string(kilobytes) + "; " + command});
}

Outcome expect_success(Outcome outcome) {
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  return outcome;
}

nlohmann::json figures_of(const Outcome& outcome) {
  std::size_t begin = outcome.output.find('{');
  if (begin == std::string::npos) return nlohmann::json::parse(outcome.output);
  // Of a list of objects.
  const std::size_t before =
      begin == 0 ? std::string::npos : outcome.output.find_last_not_of(" \n", begin - 1);
  if (before != std::string::npos && outcome.output[before] == '[') begin = before;
  return nlohmann::json::parse(outcome.output.substr(begin));
}
