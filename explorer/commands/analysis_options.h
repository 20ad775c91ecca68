// What the commands that ask a study have in common.
#pragma once

#include <array>
#include <cstdio>
#include <iostream>
#include <string>
#include <vector>

#include "base/command/command.h"
#include "explorer/analysis/distribution.h"
#include "explorer/analysis/figure_model.h"

namespace cleft {

inline constexpr const char* help_of_given =
    "NAME=uniform(from, to), loguniform(from, to), normal(mean, deviation), triangular(from, peak, to) or "
    "FILE.csv: how likely a parameter's values are (repeatable; default: all of the study's range alike)";

/// "case 3 of 40".
inline ReportPart report_cases(Progress& progress, int cases) {
  return [&progress, cases](double part) {
    progress("case " + std::to_string(1 + static_cast<int>(part * cases)) + " of " + std::to_string(cases));
  };
}

inline std::vector<InputDistribution> distributions_of(const FigureModel& model,
                                                       const std::vector<std::string>& given) {
  std::vector<RangeOfName> ranges;
  for (const FigureModel::Varied& one : model.varying())
    ranges.push_back({one.name, one.least, one.greatest});
  return distributions_of(ranges, given);
}

/// Of cases that the study has and that cannot be read.
inline void warn_of_left_out(const PublishedStudy& study, const std::string& command) {
  for (const std::string& sentence : study.left_out())
    std::cerr << "cleft " << command << ": warning: " << sentence << "\n";
}

/// With four digits.
inline std::string rounded(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4g", value);
  return text.data();
}

}  // namespace cleft
