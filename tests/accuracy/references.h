// The reference cases, each at each tolerance a row of accuracy.csv.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace cleft {

inline constexpr std::array reference_tolerances = {0.05, 0.01, 0.002};

/// Names of the case files in cases/, sorted, and their paths.
std::vector<std::string> solved_references();
std::string case_file(const std::string& name);

/// Those and the generated ones.
std::vector<std::string> references();

/// The table in the repository.
std::string accuracy_file();

}  // namespace cleft
