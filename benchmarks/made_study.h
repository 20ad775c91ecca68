// A study of many cases that nobody solved.
#pragma once

#include <string>
#include <vector>

#include "encoder/field/field.h"
#include "encoder/field/file/study_file.h"

namespace cleft {

/// Cases of the given one's knots and steps, whose parameters and control points differ, published in
/// FOLDER/cases.
std::vector<StudyCase> make_study(const Field& base, const std::string& folder, int count);

}  // namespace cleft
