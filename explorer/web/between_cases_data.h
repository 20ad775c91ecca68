// What a page needs to interpolate between the cases of a study as StudyInterpolator does.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "explorer/study/study.h"

namespace cleft {

struct BetweenCasesData {
  std::string model;                              ///< JSON, docs/formats.md; empty: nothing lies between
  std::vector<std::vector<std::uint8_t>> pieces;  ///< shares of the modes, then each mode as coded
  int modes = 0;
  double error = 0;    ///< at most, of the samples of cases as sums of modes, over the largest displacement
  std::string reason;  ///< why nothing lies between; empty otherwise
};

/// Throws FileError if a field is damaged.
/// `modes`: else the weights of the cases are all that is needed, which derivatives by parameters are not
/// part of.
BetweenCasesData between_cases_data(const PublishedStudy& study, bool modes = true);

}  // namespace cleft
