#include "explorer/session/session.h"

#include <algorithm>
#include <filesystem>

#include "base/error.h"
#include "base/message.h"
#include "base/text.h"
#include "explorer/session/actions.h"
#include "explorer/session/command_table.h"

namespace cleft {

namespace {

/// The error that is being handled; those of the file system as InputErrors, so that scripts add the place.
[[noreturn]] void tell_as_input_error() {
  try {
    throw;
  } catch (const std::filesystem::filesystem_error& e) {
    if (is_users_mistake(e)) throw InputError(message_of(e));
    throw;
  }
}

}  // namespace

void Session::say(const std::string& line) {
  const std::vector<std::string> words = split_line(line);
  if (words.empty()) return;
  const Command& command = find_command(words.front());
  const Opened before = opened_;
  changes_ = {};
  busy_ = true, moved_ = false;
  try {
    CommandWords rest(command.name, command.arguments, {words.begin() + 1, words.end()});
    command.run(*this, rest);
    rest.expect_end();
    judge_cuts();  // cuts whose opening cannot be judged cannot be opened either
  } catch (...) {
    opened_ = before;
    busy_ = false;
    tell_as_input_error();
  }
  busy_ = false;
  if (command.recorded != Command::none) {
    const std::vector<std::string> last =
        said_.empty() ? std::vector<std::string>{""} : split_line(said_.back());
    const bool again = last.front() == command.name;
    const bool same_slider = again && command.name == "set" && last.size() > 1 && last[1] == words[1];
    if (again && command.recorded == Command::latest) said_.pop_back();
    said_.push_back(line);
    opened_.seen.reset();
    if (!command.looks && !moved_)
      remember(line, before, same_slider || (again && command.recorded == Command::latest));
  }
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

std::vector<std::string> Session::warnings() const {
  std::vector<std::string> all;
  for (const Validity& cut : validity()) all.insert(all.end(), cut.warnings.begin(), cut.warnings.end());
  return all;
}

void Session::judge_cuts() {
  if (!changes_.cuts && !changes_.shown && !changes_.study) return;
  const std::vector<std::string> before = warnings();
  opened_.validity = has_scene() ? scene()->validity() : std::vector<Validity>{};
  if (!warns_) return;
  for (const std::string& warning : warnings())
    if (std::find(before.begin(), before.end(), warning) == before.end()) answer("warning: " + warning);
}

void Session::tick(double seconds) {
  if (!state().playing || busy_) return;
  changes_ = {};
  advance_time(*this, seconds);
  notify();
}

bool Session::take_prepared() {
  const Between& between = opened_.between;
  if (!between.preparing || busy_ || !between.reader->ready()) return between.preparing;
  changes_ = {};
  finish_preparing(*this);
  try {
    judge_cuts();
  } catch (const InputError& e) {  // the nearest case stays
    opened_.between.field = nullptr;
    opened_.between.why_nearest = e.what();
    opened_.drawn.scenes.erase(state().shown);
  }
  notify();
  return false;
}

Session::SimulatedOpening Session::simulated_opening() const {
  const std::shared_ptr<BodyRun> run = opened_.simulated.ended;
  if (!run) return nullptr;
  return [run](const std::vector<const Incision*>& cuts) {
    const BodySimulation& simulation = run->result();
    const SimulatedWounds wounds(cuts, 1, simulation.body, *simulation.series);
    const auto& vertices = cuts.front()->mesh().vertices();
    std::vector<Vec3> moved(vertices.size());
    wounds.positions(wounds.duration(), moved);
    for (std::size_t v = 0; v < moved.size(); ++v) moved[v] -= vertices[v].position;
    return moved;
  };
}

bool Session::take_simulated() {
  if (!simulating() || busy_ || !opened_.simulated.run->ready()) return simulating();
  changes_ = {};
  finish_simulation(*this);
  notify();
  return false;
}

double Session::prepared_part() const {
  return opened_.between.preparing ? opened_.between.reader->part_done() : 1;
}

KnownCases& Session::cases() const {
  if (!opened_.cases) throw InputError("no study is open (say: open DIR)");
  return *opened_.cases;
}

std::vector<std::string> Session::notices() const {
  return opened_.cases ? opened_.cases->notices() : std::vector<std::string>{};
}

void Session::answer(const std::string& text) const {
  if (services_.answer) services_.answer(text);
}

void Session::progress(const std::string& what, double part) const {
  if (services_.progress && !services_.progress(what, part)) throw InputError("cancelled: " + what);
}

void Session::tell_progress_to(std::function<bool(const std::string&, double)> progress) {
  services_.progress = std::move(progress);
}

void Session::hand_devices_to(std::function<void(const std::string&, const std::string&)> device) {
  services_.device = std::move(device);
}

void Session::answer_to(std::function<void(const std::string&)> answer) {
  services_.answer = std::move(answer);
}

}  // namespace cleft
