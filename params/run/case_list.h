// The cases of a study with their states, as JSON and as text.
#pragma once

#include "params/run/study_folder.h"

namespace cleft {

/// {"case", "state", "reason" if it failed, and each parameter that varies}.
nlohmann::ordered_json case_entry(const Study& study, const Case& one, const CaseStatus& status);

/// Prints a line for each entry on standard output.
void print_cases(const nlohmann::ordered_json& entries);

}  // namespace cleft
