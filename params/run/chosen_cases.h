// Cases of adaptive sampling: chosen while a study is run, by what the cases before them tell.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "params/run/study_folder.h"

namespace cleft {

/// A batch of cases, and what was known when it was chosen. The last one may have no cases: nothing more is
/// wanted.
struct ChosenBatch {
  int cases = 0;                            ///< that were published then
  double error = 0;                         ///< estimated, over the figure's largest value
  std::vector<std::vector<double>> values;  ///< of each case, in the order of names
};

/// DIR/chosen.json. Batches of another figure, or of other parameters, are those of an earlier study file.
struct ChosenCases {
  std::string figure;
  std::vector<std::string> names;
  std::vector<std::string> sensitivities;  ///< of the cases, where the study file names none
  std::vector<ChosenBatch> batches;
};

/// What the folder records for this study; empty without adaptive sampling. Throws FileError if the record is
/// damaged.
ChosenCases chosen_cases(const StudyFolder& folder, const Study& study);

/// The cases of the study file, and those chosen in the folder that lie in its ranges.
std::vector<Case> cases_of(const Study& file, const StudyFolder& folder);

/// Asks `cleft propose` for a further batch and records it. What was decided: cases were added; the error is
/// below the one asked for; there are as many cases as the study may have; no place is left at which a
/// further one would tell anything; or every case of the last batch failed.
enum class Choice { added, reached, most, exhausted, failed };
struct Decision {
  Choice choice;
  double error;  ///< estimated from the published cases; NaN where it was not estimated
};
Decision choose_more(const StudyFolder& folder, const Study& study);

/// The number of cases at which the error will be below `error`, by the power law of the batches so far; none
/// where they do not tell.
std::optional<int> cases_for(const ChosenCases& chosen, double error);

}  // namespace cleft
