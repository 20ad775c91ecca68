// What a study answers as a whole: the commands `cleft analyze`, `find`, `fit` and `propose`, run
// beside the explorer.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace cleft {

/// Of a figure: how much of its variance each parameter makes (Sobol's indices).
struct StudyAnalysis {
  /// Of a parameter, the one with which it makes most of the variance beyond what each makes alone.
  struct Partner {
    std::string name;
    double share = 0, error = 0;                        ///< and half of its 95 % interval
    double low = 0, high = 0;                           ///< values of the partner
    std::vector<double> at, mean_at_low, mean_at_high;  ///< of the figure at values of the parameter
  };
  struct Effect {
    std::string name;
    double first = 0, first_error = 0;  ///< share that it makes alone, and half of its 95 % interval
    double total = 0, total_error = 0;  ///< with all others
    std::vector<double> at, mean;       ///< of the figure at values of the parameter, over all others
    std::optional<Partner> partner;     ///< none: no share is larger than its error, and than a hundredth
  };
  std::string figure, unit;
  double mean = 0, deviation = 0;
  double error = 0;             ///< of the figure between the cases: the median; 95 % of new cases are within
  std::vector<Effect> effects;  ///< the greatest total first
};

/// Of measurements: the parameters that explain them.
struct StudyFit {
  struct Value {
    std::string name;
    double most_likely = 0, low = 0, high = 0;  ///< and 90 % of what is possible
  };
  std::vector<Value> values;
  double misfit = 0;              ///< of the residuals, over their expected size
  double misfit_probability = 0;  ///< that they are as large by chance
  std::vector<std::string> open;  ///< what the measurements do not tell, as sentences
  std::string next;               ///< the further measurement that would tell most
};

/// The next cases, and the error that they are for.
struct StudyProposal {
  double error = 0;  ///< over the largest value of the figure
  std::vector<std::map<std::string, double>> cases;
};

/// The parameters between the cases at which a figure is least or greatest under a condition.
struct StudyOptimum {
  std::map<std::string, double> values;
  bool holds = false;                ///< the condition; else they are the nearest to it
  bool holds_within_errors = false;  ///< wherever its figures are within their errors
  struct Figure {
    std::string name;
    double value = 0, error = 0;  ///< mm; 95 % of new cases are within
  };
  std::vector<Figure> figures;  ///< of the aim and of the condition
};

/// Called every tenth of a second while a command runs; what it throws ends the command.
using LookMeanwhile = std::function<void()>;

/// Each throws InputError with the message of the command that it runs, which is beside this program or in
/// the folder that the environment variable CLEFT_BIN names.
StudyAnalysis analyze_study(const std::string& study, const std::string& figure, const LookMeanwhile& look);
StudyFit fit_study(const std::string& study, const std::string& measurements, double deviation,
                   const LookMeanwhile& look);
StudyProposal propose_cases(const std::string& study, int count, const LookMeanwhile& look);
/// `where` may be empty.
StudyOptimum best_in_study(const std::string& study, bool greatest, const std::string& figure,
                           const std::string& where, const LookMeanwhile& look);

/// A study file with these cases in place of those of `study_file`; they hold the derivatives that adaptive
/// sampling takes by itself. Throws InputError for a file that is no study.
std::string study_of(const std::string& study_file, const StudyProposal& proposal);

}  // namespace cleft
