#include "explorer/scene/session/session.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/error.h"
#include "base/text.h"
#include "explorer/scene/mesh_scene.h"
#include "explorer/scene/patch_scene.h"
#include "explorer/scene/session/command_table.h"

namespace cleft {

std::string Session::absolute_path(const std::string& path) {
  return std::filesystem::absolute(path).lexically_normal().string();
}

Session::Session(SessionServices services) : services_(std::move(services)) {}

void Session::say(const std::string& line) {
  const std::vector<std::string> words = split_line(line);
  if (words.empty()) return;
  const Command& command = find_command(words.front());
  const SessionState state = state_;
  const auto study = study_;
  const auto mesh = mesh_;
  const auto known = known_;
  const auto cut_surfaces = cut_surfaces_;
  const auto scenes = scenes_;
  changes_ = {};
  try {
    CommandWords rest(command.name, command.arguments, {words.begin() + 1, words.end()});
    command.run(*this, rest);
    rest.expect_end();
  } catch (...) {  // as it was
    state_ = state, study_ = study, mesh_ = mesh, known_ = known;
    cut_surfaces_ = cut_surfaces, scenes_ = scenes;
    throw;
  }
  if (command.recorded != Command::none) {
    const bool again = !said_.empty() && split_line(said_.back()).front() == command.name;
    if (again && command.recorded == Command::latest) said_.pop_back();
    said_.push_back(line);
  }
  warn();
  notify();
}

void Session::run_script(const std::string& file) {
  const std::string text = read_text_file(file);
  std::size_t begin = 0;
  for (int number = 1; begin < text.size(); ++number) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    try {
      say(text.substr(begin, end - begin));
    } catch (const InputError& e) {
      throw InputError(file + ":" + std::to_string(number) + ": " + e.what());
    }
    begin = end + 1;
  }
}

void Session::notify() {
  const Changes changes = changes_;
  for (const Listener& listener : listeners_) listener(changes);
}

void Session::answer(const std::string& text) const {
  if (services_.answer) services_.answer(text);
}

PublishedStudy& Session::open_study() const {
  if (!study_) throw InputError("no study is open (say: open DIR)");
  return *study_;
}

std::vector<int> Session::views() const {
  return state_.compared.empty() ? std::vector<int>{state_.shown} : state_.compared;
}

std::shared_ptr<const Field> Session::field() { return study_ ? study_->field(state_.shown) : nullptr; }

std::shared_ptr<const Field> Session::reference() {
  return study_ && state_.reference >= 0 ? study_->field(state_.reference) : nullptr;
}

double Session::depth_of_case(int i) {
  constexpr double depth_without_study = 3;
  return study_ ? study_->field(i)->cut().depth : depth_without_study;
}

std::vector<ScalpelPath> Session::cut_paths(double depth) const {
  std::vector<ScalpelPath> paths;
  for (CutState cut : state_.cuts) {
    for (ScalpelPath::Point& p : cut.points)
      if (p.depth <= 0) p.depth = depth;
    paths.emplace_back(cut.points);
  }
  return paths;
}

std::shared_ptr<const CutSurface> Session::cut_surface(double depth) {
  auto& found = cut_surfaces_[depth];
  if (found) return found;
  return found = std::make_shared<CutSurface>(*mesh_, cut_paths(depth));
}

std::shared_ptr<const WoundScene> Session::scene_of(int i) {
  if (!has_scene()) throw InputError("nothing is open (say: open DIR, or mesh FILE)");
  const std::vector<int> shown = views();
  std::erase_if(scenes_,
                [&](const auto& s) { return std::find(shown.begin(), shown.end(), s.first) == shown.end(); });
  auto& found = scenes_[i];
  if (found) return found;
  if (mesh_)
    found = std::make_shared<MeshScene>(cut_surface(depth_of_case(i)), cut_fields(i));
  else
    found = std::make_shared<PatchScene>(study_->field(i));
  return found;
}

std::optional<CutFields> Session::cut_fields(int i) {
  if (!study_) return std::nullopt;
  if (!state_.tension) return CutFields(study_->field(i));
  return CutFields(std::make_shared<const PrestressFields>(*study_, i), state_.tension);
}

double Session::duration() {
  double longest = 0;
  for (const int i : views()) longest = std::max(longest, scene_of(i)->duration());
  return longest;
}

void Session::warn() {
  if (!changes_.cuts && !changes_.shown && !changes_.study) return;
  const auto before = std::move(warnings_);
  warnings_ = has_scene() ? scene()->warnings() : std::vector<std::string>{};
  for (const std::string& warning : warnings_)
    if (std::find(before.begin(), before.end(), warning) == before.end()) answer("warning: " + warning);
}

void Session::load_study(const std::string& path) {
  study_ = std::make_shared<PublishedStudy>(path);
  state_.study = absolute_path(path);
  scenes_.clear();
  cut_surfaces_.clear();
  known_ = std::make_shared<Known>();
}

void Session::open(const std::string& path) {
  load_study(path);
  state_.compared.clear();
  state_.brushes.clear();
  state_.where.clear();
  state_.reference = -1;
  if (state_.coloring == Coloring::difference) state_.coloring = Coloring::displacement;
  state_.shown = 0;
  take_parameters();
  state_.playing = false;
  state_.time = duration();
  changes_.all();
}

void Session::close() {
  study_.reset(), mesh_.reset();
  state_ = {};
  scenes_.clear(), cut_surfaces_.clear();
  changes_.all();
}

void Session::take_parameters() {
  state_.parameters.clear();
  for (const std::string& name : study_->varying()) {
    const auto& values = study_->parameters(state_.shown);
    if (const auto found = values.find(name); found != values.end()) state_.parameters[name] = found->second;
  }
}

void Session::show_case(int i) {
  open_study();
  state_.shown = i;
  take_parameters();
  set_time(state_.time);
  changes_.shown = true;
}

void Session::ask_for(const std::string& parameter, double value) {
  state_.parameters[parameter] = value;
  state_.shown = nearest_case();
  set_time(state_.time);
  changes_.shown = true;
}

int Session::nearest_case() const {
  int nearest = 0;
  double least = HUGE_VAL;
  std::map<std::string, std::pair<double, double>> ranges;
  for (int i = 0; i < study_->size(); ++i)
    for (const std::string& name : study_->varying())
      if (const auto found = study_->parameters(i).find(name); found != study_->parameters(i).end()) {
        auto& range = ranges.try_emplace(name, found->second, found->second).first->second;
        range = {std::min(range.first, found->second), std::max(range.second, found->second)};
      }
  for (int i = 0; i < study_->size(); ++i) {
    double distance = 0;
    for (const auto& [name, value] : state_.parameters) {
      const auto found = study_->parameters(i).find(name);
      const double spread = ranges[name].second - ranges[name].first;
      if (found != study_->parameters(i).end() && spread > 0)
        distance += std::pow((found->second - value) / spread, 2);
    }
    if (distance < least) least = distance, nearest = i;
  }
  return nearest;
}

bool Session::shows_exactly() const {
  if (!study_) return true;
  const auto& values = study_->parameters(state_.shown);
  return std::all_of(state_.parameters.begin(), state_.parameters.end(), [&](const auto& asked) {
    const auto found = values.find(asked.first);
    return found == values.end() || found->second == asked.second;
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
  const auto& values = open_study().parameters(i);
  const auto found = values.find(name);
  return found == values.end() ? std::nan("") : found->second;
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

void Session::set_time(double t) {
  state_.time = std::clamp(t, 0., duration());
  changes_.time = true;
}

void Session::tick(double seconds) {
  if (!state_.playing) return;
  changes_ = {};
  advance(seconds);
  notify();
}

void Session::advance(double seconds) {
  if (!has_scene()) return;
  const double end = duration();
  double t = state_.time + state_.speed * seconds;
  if (t >= end && state_.loop && end > 0) {
    t = std::fmod(t, end);
  } else if (t >= end) {
    t = end;
    if (state_.playing) state_.playing = false, changes_.playing = true;
  }
  state_.time = t;
  changes_.time = true;
}

void Session::restore(const SessionState& state) {
  state_ = state;
  state_.playing = false;
  study_.reset(), mesh_.reset();
  scenes_.clear(), cut_surfaces_.clear();
  if (!state.study.empty()) load_study(state.study);
  const int cases = study_ ? study_->size() : 1;
  const auto check = [&](int i, const char* what) {
    if (i < 0 || i >= cases)
      throw InputError(std::string(what) + " " + std::to_string(i + 1) + ": there are the cases 1 to " +
                       std::to_string(cases));
  };
  check(state.shown, "case");
  for (const int i : state.compared) check(i, "compared case");
  if (state.reference >= 0) check(state.reference, "reference case");
  if (!state.mesh.empty()) read_mesh_in_mm();
  if (has_scene()) set_time(state.time);
  changes_.all();
}

}  // namespace cleft
