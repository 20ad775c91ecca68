// A session's cases: which one is shown, what lies between them, figures, conditions and brushes.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "base/error.h"
#include "base/text.h"
#include "explorer/session/session.h"

namespace cleft {

namespace {

std::string shortest_of(double value, int digits) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

}  // namespace

std::string error_of_interpolation(const Field& field) {
  const Interpolation& made = *field.interpolation;
  return "estimated error " + shortest_of(100 * made.estimated_error, 2) + " %" +
         (made.outside > 0 ? ", a guess outside the cases" : "");
}

void Session::take_parameters() {
  state_.parameters.clear();
  for (const std::string& name : study_->varying())
    if (const auto value = study_->parameters(state_.shown).number(name)) state_.parameters[name] = *value;
}

void Session::show_case(int i) {
  open_study();
  state_.shown = i;
  take_parameters();
  follow_parameters();
  set_time(state_.time);
  changes_.shown = true;
}

void Session::ask_for(const std::string& parameter, double value) {
  state_.parameters[parameter] = value;
  state_.shown = nearest_case();
  follow_parameters();
  set_time(state_.time);
  changes_.shown = true;
}

void Session::interpolate(bool on) {
  state_.between = on;
  if (!on && preparing_) between_cases_.reset();
  follow_parameters();
  if (has_scene()) set_time(state_.time);
  changes_.shown = true;
}

std::map<std::string, std::pair<double, double>> Session::parameter_ranges() const {
  std::map<std::string, std::pair<double, double>> ranges;
  for (int i = 0; i < study_->size(); ++i)
    for (const std::string& name : study_->varying())
      if (const auto value = study_->parameters(i).number(name)) {
        auto& range = ranges.try_emplace(name, *value, *value).first->second;
        range = {std::min(range.first, *value), std::max(range.second, *value)};
      }
  return ranges;
}

int Session::nearest_case() const {
  int nearest = 0;
  double least = HUGE_VAL;
  const auto ranges = parameter_ranges();
  for (int i = 0; i < study_->size(); ++i) {
    double distance = 0;
    for (const auto& [name, value] : state_.parameters) {
      const auto own = study_->parameters(i).number(name);
      const auto range = ranges.find(name);
      const double spread = range == ranges.end() ? 0 : range->second.second - range->second.first;
      if (own && spread > 0) distance += std::pow((*own - value) / spread, 2);
    }
    if (distance < least) least = distance, nearest = i;
  }
  return nearest;
}

void Session::follow_parameters() {
  preparing_ = false;
  between_.reset();
  why_nearest_ = study_ && !shows_exactly() ? make_between() : "";
  scenes_.erase(state_.shown);
}

/// Why there is nothing between the cases to be shown; empty where there is, and then that is made.
std::string Session::make_between() {
  if (!state_.between) return "interpolation is off";
  if (!state_.compared.empty()) return "cases are compared";
  if (state_.tension) return "skin whose tension turns takes cases as they are";
  for (const auto& [name, range] : parameter_ranges())
    if (const auto asked = state_.parameters.find(name);
        asked != state_.parameters.end() && (asked->second < range.first || asked->second > range.second))
      return name + " is outside the study, " + shortest(range.first) + " to " + shortest(range.second);
  if (!between_cases_) between_cases_ = std::make_shared<BetweenCases>(study_->path());
  if (beside_ && !between_cases_->ready()) {
    preparing_ = true;
    return "the cases are being read";
  }
  try {
    between_cases_->wait([&](double part) { progress("reading the cases", part); });
    between_ = between_cases_->at(state_.parameters);
    return "";
  } catch (const InputError& e) {
    return e.what();
  }
}

double Session::prepared_part() const { return preparing_ ? between_cases_->part_done() : 1; }

bool Session::take_prepared() {
  if (!preparing_ || busy_ || !between_cases_->ready()) return preparing_;
  changes_ = {};
  finish_preparing();
  notify();
  return false;
}

void Session::finish_preparing() {
  if (!preparing_) return;
  const bool beside = std::exchange(beside_, false);
  follow_parameters();
  beside_ = beside;
  set_time(state_.time);
  changes_.shown = true;
}

std::string Session::title_of(int i) const {
  if (!study_) return "";
  if (!between_ || i != state_.shown) return "case " + std::to_string(i + 1) + ": " + study_->name(i);
  std::string title = "between cases:";
  for (const std::string& name : study_->varying())
    if (const auto found = state_.parameters.find(name); found != state_.parameters.end())
      title += " " + name + "=" + shortest_of(found->second, 4);
  return title;
}

std::string Session::note_of(int i) const {
  std::string note;
  if (between_ && i == state_.shown) note = "interpolated, " + error_of_interpolation(*between_);
  if (state_.coloring == Coloring::error && !why_no_raw(i).empty())
    note += (note.empty() ? "" : "; ") + std::string("without raw frames: no error is known");
  return note;
}

bool Session::shows_exactly() const {
  if (!study_) return true;
  const auto& values = study_->parameters(state_.shown);
  return std::all_of(state_.parameters.begin(), state_.parameters.end(), [&](const auto& asked) {
    return values.number(asked.first).value_or(asked.second) == asked.second;
  });
}

const CaseFigures& Session::figures(int i) {
  auto& figures = known_->figures;
  const auto found = figures.find(i);
  return found != figures.end() ? found->second
                                : figures.emplace(i, case_figures(open_study().read(i))).first->second;
}

std::vector<std::string> Session::column_names() const {
  std::vector<std::string> names = open_study().varying();
  for (const FigureText& f : figure_texts()) names.push_back(f.name);
  return names;
}

double Session::column_value(int i, const std::string& name) {
  for (const FigureText& f : figure_texts())
    if (f.name == name) return f.value(figures(i));
  return open_study().parameters(i).number(name).value_or(std::nan(""));
}

void Session::find(const std::string& condition) {
  open_study();
  if (!condition.empty()) Condition{condition};  // says what is wrong with it
  state_.where = condition;
  changes_.brushes = true;
}

const std::optional<Finding>& Session::finding(int i) {
  auto& findings = known_->findings[state_.where];
  const auto found = findings.find(i);
  if (found != findings.end()) return found->second;
  return findings.emplace(i, Condition(state_.where).find(open_study().read(i))).first->second;
}

bool Session::brushed(int i) {
  if (!state_.where.empty() && !finding(i)) return false;
  return std::all_of(state_.brushes.begin(), state_.brushes.end(), [&](const auto& brush) {
    const double value = column_value(i, brush.first);
    return value >= brush.second.first && value <= brush.second.second;
  });
}

}  // namespace cleft
