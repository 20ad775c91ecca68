// Time is the length cut, mm.
#include "explorer/session/actions.h"
#include "explorer/session/commands.h"

namespace cleft {

namespace {

void time(Session& session, CommandWords& words) {
  set_time(session, words.number_in("the length cut", 0, 1e6));
}
void end(Session& session, CommandWords&) { set_time(session, session.duration()); }
void step(Session& session, CommandWords& words) {
  set_time(session, session.state().time + (words.empty() ? 1 : words.number("the step")));
}

void play(Session& session, CommandWords&) {
  if (session.state().time >= session.duration()) set_time(session, 0);
  session.edit().playing = true;
  session.changes().playing = true;
}
void pause(Session& session, CommandWords&) {
  session.edit().playing = false;
  session.changes().playing = true;
}
void loop(Session& session, CommandWords& words) {
  session.edit().loop = words.on_or_off();
  session.changes().playing = true;
}
void speed(Session& session, CommandWords& words) {
  session.edit().speed = words.number_in("the speed", 0.1, 1000);
  session.changes().playing = true;
}
void wait(Session& session, CommandWords& words) {
  const double seconds = words.number_in("the time to wait", 0, 3600);
  if (session.state().playing) advance_time(session, seconds);
}

}  // namespace

std::span<const Command> time_commands() {
  static const std::vector<Command> commands{
      {"time", "MM", "show the wound when this length is cut", time, Command::latest, true},
      {"step", "[MM]", "go on by a length, back where it is negative [1]", step, Command::all, true},
      {"end", "", "show the whole cut", end, Command::all, true},
      {"play", "", "let the blade go on; from the start where it is at the end", play, Command::all, true},
      {"pause", "", "stop there", pause, Command::all, true},
      {"loop", "on|off", "begin again at the end", loop, Command::all, true},
      {"speed", "MM_PER_S", "of playing [10]", speed, Command::all, true},
      {"wait", "S", "in scripts: what playing does in that time", wait, Command::all, true},
  };
  return commands;
}

}  // namespace cleft
