#include "explorer/session/session.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/error.h"
#include "base/text.h"
#include "explorer/scene/mesh_scene.h"
#include "explorer/scene/patch_scene.h"
#include "explorer/session/command_table.h"
#include "params/run/study_index.h"

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
  const auto between_cases = between_cases_;
  const auto between = between_;
  const std::string why_nearest = why_nearest_;
  const bool preparing = preparing_;
  changes_ = {};
  try {
    CommandWords rest(command.name, command.arguments, {words.begin() + 1, words.end()});
    busy_ = true;
    command.run(*this, rest);
    rest.expect_end();
    busy_ = false;
  } catch (...) {  // as it was
    busy_ = false;
    state_ = state, study_ = study, mesh_ = mesh, known_ = known;
    cut_surfaces_ = cut_surfaces, scenes_ = scenes;
    between_cases_ = between_cases, between_ = between;
    why_nearest_ = why_nearest, preparing_ = preparing;
    throw;
  }
  if (command.recorded != Command::none) {
    const bool again = !said_.empty() && split_line(said_.back()).front() == command.name;
    if (again && command.recorded == Command::latest) said_.pop_back();
    said_.push_back(line);
    seen_.reset();
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

std::shared_ptr<const Field> Session::field() { return study_ ? field_of(state_.shown) : nullptr; }

std::shared_ptr<const Field> Session::field_of(int i) {
  return between_ && i == state_.shown ? between_ : open_study().field(i);
}

std::shared_ptr<const Field> Session::reference() {
  return study_ && state_.reference >= 0 ? study_->field(state_.reference) : nullptr;
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
    found = std::make_shared<PatchScene>(
        field_of(i), state_.coloring == Coloring::error && why_no_raw(i).empty() ? raw_of(i) : nullptr);
  return found;
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
  between_cases_.reset(), between_.reset();
  raws_.clear();
  why_nearest_.clear();
  preparing_ = false;
}

void Session::open(const std::string& path) {
  load_study(path);
  state_.compared.clear();
  state_.brushes.clear();
  state_.where.clear();
  state_.reference = -1;
  state_.probe.reset(), state_.zoom.reset(), state_.figure.clear();
  if (state_.coloring == Coloring::difference || state_.coloring == Coloring::error)
    state_.coloring = Coloring::displacement;
  state_.shown = 0;
  take_parameters();
  state_.playing = false;
  state_.time = duration();
  changes_.all();
  for (const std::string& notice : notices()) answer(notice);
}

std::vector<std::string> Session::notices() const {
  std::vector<std::string> notices;
  if (!study_) return notices;
  if (!study_->older().empty())
    notices.push_back(study_->path() + ": " + note_of_older(study_->path(), study_->older()));
  int gone = 0;
  if (study_->is_folder())
    for (const auto& [hash, one] : study_index(study_->path())) gone += !one.snapshot;
  if (gone > 0)
    notices.push_back(study_->path() + ": the raw data of " + std::to_string(gone) +
                      " cases are gone (keep_snapshots = \"none\"): their fields are all there");
  return notices;
}

void Session::close() {
  study_.reset(), mesh_.reset();
  between_cases_.reset(), between_.reset();
  state_ = {};
  scenes_.clear(), cut_surfaces_.clear();
  changes_.all();
}

void Session::set_time(double t) {
  state_.time = std::clamp(t, 0., duration());
  changes_.time = true;
}

void Session::tick(double seconds) {
  if (!state_.playing || busy_) return;
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
  between_cases_.reset(), between_.reset();
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
  follow_parameters();
  if (has_scene()) set_time(state.time);
  changes_.all();
}

}  // namespace cleft
