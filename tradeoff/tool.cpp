#include "tradeoff/tool.h"

#include <stdexcept>

#include "base/process.h"
#include "base/text.h"

namespace cleft {

nlohmann::json run_tool(const std::string& name, std::vector<std::string> arguments,
                        const std::string& folder) {
  const std::string log = folder + "/" + name + ".log", output = folder + "/" + name + ".json";
  arguments.insert(arguments.begin(), executable_folder() + "/cleft-" + name);
  arguments.push_back("--json");
  if (!run_process(arguments, log, {}, nullptr, output).success())
    throw std::runtime_error("cleft " + name + " failed: " + read_text_file(log));
  return nlohmann::json::parse(read_text_file(output));
}

double total_seconds(const nlohmann::json& figures) {
  double sum = 0;
  for (const auto& [phase, seconds] : figures.at("seconds").items()) sum += seconds.get<double>();
  return sum;
}

}  // namespace cleft
