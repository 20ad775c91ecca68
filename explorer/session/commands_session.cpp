// Pictures, saved sessions, recordings, help.
#include <cmath>
#include <cstdio>

#include "base/output_file.h"
#include "base/text.h"
#include "explorer/session/actions.h"
#include "explorer/session/commands.h"

namespace cleft {

namespace {

void screenshot(Session& session, CommandWords& words) {
  const std::string file = words.text("a file .png");
  const int width = words.empty() ? 1280 : words.whole("the width", 16, 8192);
  const int height = words.empty() ? width * 9 / 16 : words.whole("the height", 16, 8192);
  const bool transparent = !words.empty();
  if (transparent && words.text("transparent") != "transparent") words.wrong("only 'transparent' can follow");
  words.expect_end();
  session.scene();  // says what is missing
  finish_preparing(session);
  session.services().draw(session, file, width, height, transparent);
}

void movie(Session& session, CommandWords& words) {
  const std::string file = words.text("a file .ogv or a folder");
  MovieFormat format;
  if (!words.empty()) {
    format.width = words.whole("the width", 16, 8192);
    format.height = words.empty() ? format.width * 9 / 16 : words.whole("the height", 16, 8192);
  }
  if (!words.empty()) format.rate = words.number_in("the pictures a second", 1, 120);
  words.expect_end();
  session.scene();  // says what is missing
  finish_preparing(session);
  if (!session.services().film) throw InputError("there is nobody to make a movie");
  session.services().film(session, file, format);
}

void save(Session& session, CommandWords& words) {
  const std::string file = words.text("a file .json");
  words.expect_end();
  write_text_file(file, state_to_json(session.state()));
}

void load(Session& session, CommandWords& words) {
  const std::string file = words.text("a file .json or .png");
  told_of_file(file, [&] {
    restore(session, state_from_json(file.ends_with(".png") ? session.services().state_in_picture(file)
                                                            : read_text_file(file)));
  });
}

void record(Session& session, CommandWords& words) {
  const std::string file = words.text("a file");
  words.expect_end();
  std::string text;
  for (const std::string& line : session.said()) text += line + "\n";
  write_text_file(file, text);
}

std::string told(const LeftOut& out) {
  char text[160];
  std::snprintf(text, sizeof text,
                "%zu of %zu vertices that the cuts move are left at rest, off by at most %.3g mm",
                out.vertices, out.of, out.error);
  return text;
}

std::string pixels_of(const DetailSeen& seen) {
  char text[40];
  std::snprintf(text, sizeof text, "%.3g pixels", seen.pixels);
  return text;
}

/// In pixels there is something to tell once there is a picture.
std::string told_detail(const Session& session, const WoundScene& scene) {
  const Detail& detail = *session.state().detail;
  const std::string text = "detail " + text_of(detail) + ": ";
  if (const auto& seen = session.seen()) return text + told(seen->left_out) + ", " + pixels_of(*seen);
  if (detail.pixels) return text + "no picture has been drawn with it";
  const auto some = scene.with_detail(1e-3 * detail.amount);
  return text + (some ? told(*some->left_out()) : "no vertices are moved by cuts in a mesh");
}

/// To what matters of a figure.
std::string rounded(double value) { return formatted("%.3g", value); }

void info(Session& session, CommandWords&) {
  const SessionState& s = session.state();
  const auto scene = session.scene();
  if (const auto field = session.field()) {
    session.answer(session.between()
                       ? session.title_of(s.shown) + ", " + session.note_of(s.shown)
                       : "case " + std::to_string(s.shown + 1) + " of " +
                             std::to_string(session.study()->size()) + ": " + session.study()->name(s.shown) +
                             session.study()->hash_behind(s.shown));
    if (!session.why_nearest().empty()) session.answer("the nearest case: " + session.why_nearest());
    session.answer((session.between() ? std::string("estimated") : std::string("largest")) +
                   " error of what is drawn: " + rounded(100 * field->report.spline_error) +
                   " % of the largest displacement, " + rounded(field->report.largest_displacement) + " mm");
    const std::optional<double> error = error_of_gape(*field);
    const std::string when = session.is_imported() ? "t = " + shortest(s.time) : shortest(s.time) + " mm cut";
    session.answer("widest gape at " + when + ": " +
                   rounded(widest_gape(*field, std::min(s.time, field->duration()))) + " mm" +
                   (error ? ", off by at most " + rounded(*error) + " mm" : ""));
  }
  if (!s.mesh.empty()) session.answer("mesh: " + s.mesh + ", cuts: " + std::to_string(s.cuts.size()));
  session.answer(session.is_imported()
                     ? session.progress_text(s.time, scene->duration())
                     : "length cut: " + shortest(s.time) + " of " + shortest(scene->duration()) + " mm");
  if (const std::string& note = session.simulation_note(); !note.empty()) session.answer(note);
  if (s.detail) session.answer(told_detail(session, *scene));
  for (const std::string& warning : session.warnings()) session.answer("warning: " + warning);
}

void help(Session& session, CommandWords& words) {
  if (words.empty()) return session.answer(help_sheet());
  const Command& command = find_command(words.text("a command"));
  session.answer(command.name + " " + command.arguments + ": " + command.help);
}

}  // namespace

std::span<const Command> session_commands() {
  static const std::vector<Command> commands{
      {"screenshot", "FILE [WIDTH [HEIGHT [transparent]]]",
       "write a PNG, which holds the saved session too; transparent: without background", screenshot,
       Command::none},
      {"movie", "FILE.ogv|FOLDER [WIDTH [HEIGHT [RATE]]]",
       "of the growing cut at the playing speed: Ogg Theora, or a folder of PNG files", movie, Command::none},
      {"save", "FILE.json", "save the session", save, Command::none},
      {"load", "FILE.json|FILE.png", "go on with a saved session", load},
      {"record", "FILE", "write the commands said so far, as a script", record, Command::none},
      {"info", "", "what is shown, with its figures", info, Command::none},
      {"help", "[COMMAND]", "this sheet, or a line of it", help, Command::none},
  };
  return commands;
}

}  // namespace cleft
