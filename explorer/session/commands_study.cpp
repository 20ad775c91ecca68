// Opening studies, choosing cases and parameters.
#include <algorithm>
#include <cstdio>

#include "base/text.h"
#include "explorer/session/actions.h"
#include "explorer/session/commands.h"
#include "params/parameters/table.h"

namespace cleft {

namespace {

int read_case(Session& session, CommandWords& words) {
  return words.whole("the case", 1, session.open_study().size()) - 1;
}

void open(Session& session, CommandWords& words) {
  load_study(session, words.text("a study folder or a field file"));
}
void close(Session& session, CommandWords&) { close_all(session); }
void show(Session& session, CommandWords& words) { show_case(session, read_case(session, words)); }
void next(Session& session, CommandWords&) {
  show_case(session, (session.state().shown + 1) % session.open_study().size());
}
void previous(Session& session, CommandWords&) {
  const int cases = session.open_study().size();
  show_case(session, (session.state().shown + cases - 1) % cases);
}

void set(Session& session, CommandWords& words) {
  const PublishedStudy& study = session.open_study();
  const std::string name = words.text("a parameter");
  const std::vector<std::string>& varying = study.varying();
  if (std::find(varying.begin(), varying.end(), name) == varying.end()) {
    const Parameter& row = find_parameter(name, "set");
    const auto value = study.parameters(session.state().shown).number(name);
    std::string list;
    for (const std::string& v : varying) list += (list.empty() ? "" : ", ") + v;
    words.wrong(name + " is the same in all cases of this study" +
                (value ? " (" + shortest(*value) + " " + row.unit + ")" : "") +
                (varying.empty() ? "" : "; those that differ: " + list));
  }
  request_parameter(session, name, words.number(name));
}

void between(Session& session, CommandWords& words) {
  session.open_study();
  interpolate(session, words.on_or_off());
}

void list_cases(Session& session, CommandWords&) {
  const PublishedStudy& study = session.open_study();
  for (int i = 0; i < study.size(); ++i)
    session.answer(std::to_string(i + 1) + (i == session.state().shown ? " * " : "   ") + study.name(i) +
                   study.hash_behind(i));
}

void compare(Session& session, CommandWords& words) {
  std::vector<int> cases;
  while (!words.empty()) cases.push_back(read_case(session, words));
  if (cases.size() < 2 || cases.size() > 4) words.wrong("give two to four cases");
  session.edit().compared = cases;
  interpolate(session, session.state().between);  // cases are compared as they are
  session.changes().layout = true;
}

void single(Session& session, CommandWords&) {
  session.edit().compared.clear();
  interpolate(session, session.state().between);
  session.changes().layout = true;
}

void difference(Session& session, CommandWords& words) {
  session.edit().reference = read_case(session, words);
  session.edit().coloring = Coloring::difference;
  session.changes().coloring = true;
}

/// Throws InputError with the nearest one if there is no such parameter or figure.
void check_column(const Session& session, const CommandWords& words, const std::string& name) {
  const std::vector<std::string> names = session.column_names();
  if (std::find(names.begin(), names.end(), name) == names.end())
    words.wrong("'" + name + "' is neither a parameter that differs nor a figure" +
                did_you_mean(name, names));
}

void brush(Session& session, CommandWords& words) {
  const std::string name = words.text("a parameter or figure, or 'clear'");
  if (name == "clear" && words.empty()) {
    session.edit().brushes.clear();
  } else {
    check_column(session, words, name);
    if (words.empty()) words.wrong("needs two numbers");
    const double low = words.number("the lower end"), high = words.number("the upper end");
    if (low > high) words.wrong("the lower end must not be above the upper end");
    session.edit().brushes[name] = {low, high};
  }
  session.changes().brushes = true;
}

void find(Session& session, CommandWords& words) {
  if (words.empty()) words.wrong("needs a condition, or 'clear'");
  const std::string condition = words.rest();
  find_cases(session, condition == "clear" ? "" : condition);
  if (condition == "clear") return;
  int count = 0;
  for (int i = 0; i < session.study()->size(); ++i) {
    session.progress("looking through the cases", double(i) / session.study()->size());
    const std::optional<Finding>& f = session.finding(i);
    if (!f) continue;
    ++count;
    char text[160];
    std::snprintf(text, sizeof text, "case %d: %.1f to %.1f mm cut, u %.1f to %.1f mm, gape up to %.2f mm",
                  i + 1, f->first_t, f->last_t, f->least_u, f->greatest_u, f->gape);
    session.answer(text + session.study()->hash_behind(i));
  }
  session.answer(std::to_string(count) + " of " + std::to_string(session.study()->size()) + " cases");
}

/// Where `find` has found something: the case, and the length cut at its widest gape.
void found(Session& session, CommandWords& words) {
  const int i = read_case(session, words);
  if (session.state().where.empty()) words.wrong("nothing has been looked for (say: find CONDITION)");
  const std::optional<Finding>& finding = session.finding(i);
  if (!finding) words.wrong("'" + session.state().where + "' holds nowhere in case " + std::to_string(i + 1));
  show_case(session, i);
  set_time(session, finding->best_t);
}

void filter(Session& session, CommandWords& words) {
  session.open_study();
  session.edit().filtered = words.on_or_off();
  session.changes().brushes = true;
}

void sort(Session& session, CommandWords& words) {
  const std::string name = words.text("a parameter or figure, or none");
  const std::string order = words.empty() ? "up" : words.text("up or down");
  if (order != "up" && order != "down") words.wrong("'" + order + "' is neither up nor down");
  session.open_study();
  if (name != "none") check_column(session, words, name);
  session.edit().sorted_by = name == "none" ? "" : name;
  session.edit().descending = order == "down";
  session.changes().lists = true;
}

void mark(Session& session, CommandWords& words) {
  const int count = session.open_study().size();
  const std::string first = words.text("cases, or none");
  std::vector<int> cases;
  if (first != "none") {
    CommandWords number("select", "N N ... | none", {first});
    cases.push_back(number.whole("the case", 1, count) - 1);
    while (!words.empty()) cases.push_back(read_case(session, words));
  }
  std::sort(cases.begin(), cases.end());
  cases.erase(std::unique(cases.begin(), cases.end()), cases.end());
  session.edit().selected = cases;
  session.changes().lists = true;
}

void wall(Session& session, CommandWords& words) {
  session.edit().wall = words.on_or_off();
  session.changes().lists = true;
}

}  // namespace

std::span<const Command> study_commands() {
  static const std::vector<Command> commands{
      {"open", "DIR|study.dffd|case.dffd", "open a study and show its first case", open},
      {"close", "", "close the study and the mesh", close},
      {"case", "N", "show case N, from 1, in the order of `cases`", show},
      {"next", "", "show the next case", next},
      {"previous", "", "show the case before", previous},
      {"set", "PARAMETER VALUE", "show the wound of this value, the others kept: between cases interpolated",
       set},
      {"between", "on|off", "interpolate between cases; off: show the nearest one", between},
      {"cases", "", "list the cases by the parameters in which they differ", list_cases, Command::none},
      {"brush", "NAME LOW HIGH | clear", "fade cases whose parameter or figure is outside", brush,
       Command::latest},
      {"find", "CONDITION | clear", "cases where it holds, like: gape > 3 and tissue.young_modulus < 0.01",
       find, Command::latest},
      {"found", "N", "show case N where `find` has found something, at its widest gape", found},
      {"filter", "on|off", "leave the cases that are faded out of lists", filter},
      {"sort", "NAME [up|down] | none", "sort lists by a parameter or figure; none: as cases are numbered",
       sort, Command::latest},
      {"select", "N N ... | none", "mark these cases in lists and plots", mark, Command::latest},
      {"wall", "on|off", "pictures of all cases, which are kept beside the study", wall, Command::latest},
      {"compare", "N N [N [N]]", "show two to four cases side by side", compare},
      {"single", "", "show one case again", single},
      {"difference", "N", "colour by the difference from case N", difference},
  };
  return commands;
}

}  // namespace cleft
