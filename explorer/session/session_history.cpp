// What lines have changed, taken back and made again: a session holds all that depends on what is open as one
// value, of which the earlier ones are kept.
#include <algorithm>

#include "base/error.h"
#include "explorer/session/actions.h"
#include "explorer/session/command_table.h"
#include "explorer/session/session.h"

namespace cleft {

namespace {

constexpr std::size_t most_steps = 100;

/// Without what can be computed again, and without work that goes on beside.
Opened kept(Opened opened) {
  opened.drawn = {};
  opened.between = {};
  opened.seen.reset();
  if (opened.simulated.run) opened.simulated = {};
  return opened;
}

const std::string no_line;

}  // namespace

/// `continues`: the line takes the place of the one before it, as a slider's do.
void Session::remember(const std::string& line, const Opened& before, bool continues) {
  const auto name = [](const std::string& of) { return split_line(of).front(); };
  continues = continues && !earlier_.empty() && name(earlier_.back().line) == name(line);
  const SessionState from = continues ? earlier_.back().opened.state : before.state;
  const SessionState& to = state();
  if (!continues && state_to_json(from) == state_to_json(to)) return;  // there would be nothing to see
  const bool camera = from.camera != to.camera || from.mesh != to.mesh || from.study != to.study;
  if (!continues) earlier_.push_back({kept(before), "", false, false});
  Step& step = earlier_.back();
  step.line = line, step.camera = camera, step.time = from.time != to.time;
  if (earlier_.size() > most_steps) earlier_.erase(earlier_.begin());
  later_.clear();
}

void Session::go(std::vector<Step>& from, std::vector<Step>& to) {
  if (from.empty()) throw InputError("there is no line to take back or to make again");
  Step step = from.back();
  const Opened now = opened_;
  opened_ = step.opened;
  SessionState& s = opened_.state;
  if (!step.camera) s.camera = now.state.camera;
  if (!step.time) s.time = now.state.time;
  s.playing = false, s.loop = now.state.loop, s.speed = now.state.speed;
  if (s.study == now.state.study) opened_.between.reader = now.between.reader;
  if (has_scene()) {
    follow_parameters(*this);
    set_time(*this, s.time);
  }
  changes_.all();
  moved_ = true;
  step.opened = kept(now);
  from.pop_back();
  to.push_back(std::move(step));
}

void Session::take_back_line() { go(earlier_, later_); }
void Session::make_line_again() { go(later_, earlier_); }

const std::string& Session::line_to_take_back() const {
  return earlier_.empty() ? no_line : earlier_.back().line;
}
const std::string& Session::line_to_make_again() const {
  return later_.empty() ? no_line : later_.back().line;
}

}  // namespace cleft
