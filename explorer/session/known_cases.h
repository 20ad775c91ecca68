// The open study, and the results that have been computed from its cases so far. Results are only added,
// never changed, so all values of Opened (opened.h) with the same study share one object.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "explorer/session/study_answers.h"
#include "explorer/study/case_figures.h"
#include "explorer/study/find.h"
#include "explorer/study/raw_case.h"
#include "explorer/study/study.h"
#include "explorer/wound/family_fields.h"
#include "explorer/wound/prestress_fields.h"

namespace cleft {

class KnownCases {
 public:
  /// Throws as PublishedStudy does.
  explicit KnownCases(const std::string& path) : study_(path) {}

  PublishedStudy& study() { return study_; }

  /// Figures of case i; reads the case the first time.
  const CaseFigures& figures(int i);
  bool knows_figures(int i) const { return figures_.count(i) > 0; }
  /// The finding of the condition in case i; reads the case the first time.
  const std::optional<Finding>& finding(const std::string& condition, int i);
  /// The simulation of case i; the last few are kept. Throws as RawCase does.
  std::shared_ptr<const RawCase> raw(int i);
  /// The fields for the shape of skin and cut, where the study is a family; else null. Reads all cases the
  /// first time.
  std::shared_ptr<const FamilyFields> family();

  /// The analysis of a figure; made the first time.
  const StudyAnalysis& analysis(const std::string& figure, const LookMeanwhile& look);
  /// The same if it has been made; else null.
  const StudyAnalysis* known_analysis(const std::string& figure) const;
  /// Fits the study to measurements, anew each time, as their file may have changed.
  const StudyFit& fit(const std::string& measurements, double deviation, const LookMeanwhile& look);
  const std::optional<StudyFit>& last_fit() const { return fit_; }

  /// The fields of three cases that differ from case i in the skin's prestress alone; null where there are no
  /// three with independent ones. Reads them the first time.
  std::shared_ptr<const PrestressFields> prestress_fields(int i);

  /// The parameters in which the cases differ, then the figures.
  std::vector<std::string> column_names() const;
  /// NaN if case i has no such parameter.
  double column_value(int i, const std::string& name);
  /// Case i's values of the parameters in which the cases differ.
  std::map<std::string, double> varying_parameters(int i) const;
  /// Least and greatest value over all cases of each parameter in which they differ.
  std::map<std::string, std::pair<double, double>> parameter_ranges() const;
  /// The case nearest to these parameters; distances are relative to the ranges.
  int nearest(const std::map<std::string, double>& parameters) const;
  /// Messages about the study as a whole: cases left out, missing simulations.
  std::vector<std::string> notices() const;

 private:
  PublishedStudy study_;
  std::map<int, CaseFigures> figures_;
  std::map<std::string, std::map<int, std::optional<Finding>>> findings_;  // by condition
  std::map<int, std::shared_ptr<const RawCase>> raws_;
  std::shared_ptr<const FamilyFields> family_;
  std::map<std::string, StudyAnalysis> analyses_;
  std::optional<StudyFit> fit_;
  std::map<int, std::shared_ptr<const PrestressFields>> prestress_fields_;
};

}  // namespace cleft
