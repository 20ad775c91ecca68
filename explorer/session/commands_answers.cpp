// Questions to the study as a whole.
#include <cstdio>

#include "base/output_file.h"
#include "base/text.h"
#include "explorer/session/actions.h"
#include "explorer/session/commands.h"

namespace cleft {

namespace {

LookMeanwhile shown_progress(const Session& session, const std::string& what) {
  return [&session, what] { session.progress(what, 0.5); };
}

void analyze(Session& session, CommandWords& words) {
  session.open_study();
  const std::string figure = words.empty() ? "gape" : words.rest();
  const StudyAnalysis& found =
      session.cases().analysis(figure, shown_progress(session, "analyzing " + figure));
  session.edit().analyzed = figure;
  session.changes().answers = true;
  session.answer(formatted(
      "%s: mean %.4g %s, standard deviation %.3g; between the cases it is off by %.2g %s", figure.c_str(),
      found.mean, found.unit.c_str(), found.deviation, found.error, found.unit.c_str()));
  for (const StudyAnalysis::Effect& e : found.effects)
    session.answer(formatted("%s: %.1f +- %.1f %% of the variance alone, %.1f +- %.1f %% with others",
                             e.name.c_str(), 100 * e.first, 100 * e.first_error, 100 * e.total,
                             100 * e.total_error) +
                   (e.partner ? formatted(", most with %s (%.1f +- %.1f %%)", e.partner->name.c_str(),
                                          100 * e.partner->share, 100 * e.partner->error)
                              : ""));
}

/// And shows the wound of the most likely parameters.
void fit(Session& session, CommandWords& words) {
  session.open_study();
  const std::string file = words.text("a file of measurements .csv");
  const double deviation = words.empty() ? 0 : words.number_in("the deviation, mm", 1e-9, 1e6);
  words.expect_end();
  const StudyFit& found = session.cases().fit(file, deviation, shown_progress(session, "fitting"));
  session.changes().answers = true;
  for (const StudyFit::Value& v : found.values) {
    request_parameter(session, v.name, v.most_likely);
    session.answer(
        formatted("%s: %.4g, 90 %% from %.4g to %.4g", v.name.c_str(), v.most_likely, v.low, v.high));
  }
  session.answer(formatted("residuals are %.3g of their expected size", found.misfit) +
                 (found.misfit_probability < 0.01 ? ": no case of the study's ranges fits" : "") +
                 "; to tell more, measure " + found.next);
  for (const std::string& sentence : found.open) session.answer(sentence);
}

void propose(Session& session, CommandWords& words) {
  const PublishedStudy& study = session.open_study();
  const int count = words.empty() ? 8 : words.whole("the number of cases", 1, 1000);
  const std::string file = words.empty() ? "" : words.text("a study file .toml");
  words.expect_end();
  const StudyProposal found =
      propose_cases(study.path(), count, shown_progress(session, "comparing candidates"));
  session.answer(formatted("the estimated error is %.2g %% of the largest value; most would be learned from",
                           100 * found.error));
  for (const auto& values : found.cases) {
    std::string line;
    for (const auto& [name, value] : values) line += (line.empty() ? "" : " ") + name + "=" + shortest(value);
    session.answer(line);
  }
  if (file.empty()) return;
  write_text_file(file, study_of(study.path() + "/study.toml", found));
  session.answer(file + " has these cases (cleft run " + file + " --out " + study.path() + ")");
}

/// And shows the wound of the parameters that are found.
void find_optimum(Session& session, CommandWords& words, bool greatest) {
  const PublishedStudy& study = session.open_study();
  const std::string all = words.rest(), mark = " where ";
  const std::size_t at = all.find(mark);
  const std::string figure = all.substr(0, at),
                    where = at == std::string::npos ? "" : all.substr(at + mark.size()),
                    what = (greatest ? "greatest " : "least ") + figure;
  const StudyOptimum found =
      best_in_study(study.path(), greatest, figure, where, shown_progress(session, "searching the " + what));
  if (!found.holds) {
    session.answer("nowhere between the cases does '" + where + "' hold; it nearly does at");
  } else {
    session.answer("the " + what + " between the cases is at");
  }
  for (const auto& [name, value] : found.values) {
    request_parameter(session, name, value);
    session.answer(formatted("%s = %.4g", name.c_str(), value));
  }
  for (const StudyOptimum::Figure& one : found.figures)
    session.answer(formatted("%s: %.4g +- %.2g mm", one.name.c_str(), one.value, one.error));
  if (found.holds && !found.holds_within_errors)
    session.answer("within these errors the condition may fail (cleft find --certain keeps their distance)");
}

void minimize(Session& session, CommandWords& words) { find_optimum(session, words, false); }
void maximize(Session& session, CommandWords& words) { find_optimum(session, words, true); }

}  // namespace

std::span<const Command> answer_commands() {
  static const std::vector<Command> commands{
      {"analyze", "[FIGURE]",
       "what a figure depends on, and how surely: gape, gape(u), displacement, ... (cleft analyze) [gape]",
       analyze, Command::latest},
      {"fit", "MEASURED.csv [DEVIATION]",
       "the parameters that explain measurements, mm (cleft fit), and their wound", fit},
      {"minimize", "FIGURE [where CONDITION]",
       "the parameters between the cases at which a figure is least (cleft find --minimize), and their wound",
       minimize},
      {"maximize", "FIGURE [where CONDITION]", "the same for the greatest figure", maximize},
      {"propose", "[COUNT [FILE.toml]]",
       "the cases that the study needs most (cleft propose) [8]; FILE: a study file with them", propose,
       Command::none},
  };
  return commands;
}

}  // namespace cleft
