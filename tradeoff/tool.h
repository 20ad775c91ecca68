// Runs other commands of the project and reads their figures.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace cleft {

/// Runs `cleft NAME ARGUMENTS --json` and returns what it prints; its messages go to `folder`. Throws
/// std::runtime_error with its last message if it fails.
nlohmann::json run_tool(const std::string& name, std::vector<std::string> arguments,
                        const std::string& folder);

/// The sum of the seconds that a command's figures give for its phases.
double total_seconds(const nlohmann::json& figures);

}  // namespace cleft
