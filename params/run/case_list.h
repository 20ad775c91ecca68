// The cases of a study with their states, for people and for programs.
#pragma once

#include "params/run/study_folder.h"

namespace cleft {

/// {"case", "state", "reason" where it failed, and each parameter that varies}.
nlohmann::ordered_json case_entry(const Study& study, const Case& one, const CaseStatus& status);

/// A line for each entry, on standard output.
void print_cases(const nlohmann::ordered_json& entries);

}  // namespace cleft
