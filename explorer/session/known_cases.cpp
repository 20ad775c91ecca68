#include "explorer/session/known_cases.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "params/run/study_index.h"

namespace cleft {

const CaseFigures& KnownCases::figures(int i) {
  const auto found = figures_.find(i);
  return found != figures_.end() ? found->second
                                 : figures_.emplace(i, case_figures(study_.read(i))).first->second;
}

const std::optional<Finding>& KnownCases::finding(const std::string& condition, int i) {
  auto& findings = findings_[condition];
  const auto found = findings.find(i);
  if (found != findings.end()) return found->second;
  return findings.emplace(i, Condition(condition).find(study_.read(i))).first->second;
}

std::shared_ptr<const RawCase> KnownCases::raw(int i) {
  constexpr std::size_t most_kept = 4;  // views
  if (const auto found = raws_.find(i); found != raws_.end()) return found->second;
  if (raws_.size() >= most_kept) raws_.clear();
  return raws_[i] = std::make_shared<const RawCase>(study_.snapshot(i), study_.field(i));
}

std::vector<std::string> KnownCases::column_names() const {
  std::vector<std::string> names = study_.varying();
  for (const FigureText& f : figure_texts()) names.push_back(f.name);
  return names;
}

double KnownCases::column_value(int i, const std::string& name) {
  for (const FigureText& f : figure_texts())
    if (f.name == name) return f.value(figures(i));
  return study_.parameters(i).number(name).value_or(std::nan(""));
}

std::map<std::string, double> KnownCases::varying_parameters(int i) const {
  std::map<std::string, double> varying;
  for (const std::string& name : study_.varying())
    if (const auto value = study_.parameters(i).number(name)) varying[name] = *value;
  return varying;
}

std::map<std::string, std::pair<double, double>> KnownCases::parameter_ranges() const {
  std::map<std::string, std::pair<double, double>> ranges;
  for (int i = 0; i < study_.size(); ++i)
    for (const std::string& name : study_.varying())
      if (const auto value = study_.parameters(i).number(name)) {
        auto& range = ranges.try_emplace(name, *value, *value).first->second;
        range = {std::min(range.first, *value), std::max(range.second, *value)};
      }
  return ranges;
}

int KnownCases::nearest(const std::map<std::string, double>& parameters) const {
  int nearest = 0;
  double least = HUGE_VAL;
  const auto ranges = parameter_ranges();
  for (int i = 0; i < study_.size(); ++i) {
    double distance = 0;
    for (const auto& [name, value] : parameters) {
      const auto own = study_.parameters(i).number(name);
      const auto range = ranges.find(name);
      const double spread = range == ranges.end() ? 0 : range->second.second - range->second.first;
      if (own && spread > 0) distance += std::pow((*own - value) / spread, 2);
    }
    if (distance < least) least = distance, nearest = i;
  }
  return nearest;
}

std::shared_ptr<const FamilyFields> KnownCases::family() {
  if (!family_ && Family::describes(study_.varying()))
    family_ = std::make_shared<const FamilyFields>(std::make_shared<const Family>(study_.path()));
  return family_;
}

const StudyAnalysis& KnownCases::analysis(const std::string& figure, const LookMeanwhile& look) {
  const auto found = analyses_.find(figure);
  return found != analyses_.end()
             ? found->second
             : analyses_.emplace(figure, analyze_study(study_.path(), figure, look)).first->second;
}

const StudyAnalysis* KnownCases::known_analysis(const std::string& figure) const {
  const auto found = analyses_.find(figure);
  return found == analyses_.end() ? nullptr : &found->second;
}

const StudyFit& KnownCases::fit(const std::string& measurements, double deviation,
                                const LookMeanwhile& look) {
  fit_ = fit_study(study_.path(), measurements, deviation, look);
  return *fit_;
}

std::shared_ptr<const PrestressFields> KnownCases::prestress_fields(int i) {
  const std::vector<std::string>& varying = study_.varying();
  const auto is_prestress = [](const std::string& name) { return name.starts_with("skin.prestress_"); };
  if (std::none_of(varying.begin(), varying.end(), is_prestress)) return nullptr;
  const auto found = prestress_fields_.find(i);
  if (found != prestress_fields_.end()) return found->second;
  std::shared_ptr<const PrestressFields> fields;
  try {
    fields = std::make_shared<const PrestressFields>(study_, i);
  } catch (const InputError&) {  // no three cases, which nobody has asked for
  }
  return prestress_fields_[i] = fields;
}

std::vector<std::string> KnownCases::notices() const {
  std::vector<std::string> notices = study_.left_out();
  int gone = 0;
  if (study_.is_folder())
    for (const auto& [hash, one] : study_index(study_.path())) gone += !one.snapshot;
  if (gone > 0)
    notices.push_back(study_.path() + ": the raw data of " + std::to_string(gone) +
                      " cases are gone (keep_snapshots = \"none\"): their fields are all there");
  return notices;
}

}  // namespace cleft
