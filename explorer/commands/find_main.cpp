// cleft find: cases of a study, lengths cut and places where a condition holds; the parameters between the
// cases at which a figure is least or greatest; the cases that none surpasses in several figures.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>

#include "base/command/command.h"
#include "base/error.h"
#include "base/text.h"
#include "explorer/analysis/wanted.h"
#include "explorer/commands/analysis_options.h"
#include "explorer/study/find.h"

using namespace cleft;

namespace {

struct Options {
  std::string study, where;
  std::vector<std::string> minimize, maximize;
  bool certain = false, json = false;
};

Json to_json(const PublishedStudy& study, int i, const Finding& f) {
  return {{"case", i + 1},
          {"hash", study.hash(i)},
          {"name", study.name(i)},
          {"length_cut_mm", {f.first_t, f.last_t}},
          {"place_mm", {f.least_u, f.greatest_u}},
          {"widest_gape_mm", f.gape},
          {"at_length_cut_mm", f.best_t},
          {"at_place_mm", f.best_u},
          {"confirmed", f.confirmed ? Json(*f.confirmed) : Json()}};
}

std::string to_text(const PublishedStudy& study, int i, const Finding& f) {
  char figures[200];
  std::snprintf(figures, sizeof figures, "  %.1f to %.1f mm cut, u %.1f to %.1f mm, gape up to %.2f mm",
                f.first_t, f.last_t, f.least_u, f.greatest_u, f.gape);
  return "case " + std::to_string(i + 1) + study.hash_behind(i) + ": " + study.name(i) + "\n" + figures +
         (!f.confirmed   ? " (the simulation is not kept)"
          : *f.confirmed ? " (confirmed by the simulation)"
                         : " (NOT confirmed by the simulation)");
}

void find(const Options& o) {
  const Condition condition(o.where);
  const PublishedStudy study(o.study);
  warn_of_left_out(study, "find");
  Json cases = Json::array();
  std::string lines;
  {
    Progress progress("finding");
    for (int i = 0; i < study.size(); ++i) {
      progress("case " + std::to_string(i + 1) + " of " + std::to_string(study.size()));
      const std::optional<Finding> found = find_in_case(condition, study, i);
      if (!found) continue;
      cases.push_back(to_json(study, i, *found));
      lines += to_text(study, i, *found) + "\n";
    }
  }
  if (o.json)
    print_figures({{"where", o.where}, {"cases_searched", study.size()}, {"found", cases}}, true);
  else
    std::cout << lines << cases.size() << " of " << study.size() << " cases\n";
}

Json figures_of_case(const FigureModel& model, const Wanted& wanted, int i) {
  Json json;
  for (const Aim& aim : wanted.aims()) {
    const std::optional<int> figure = wanted.figure_of(aim);
    json[aim.name] = figure ? model.figures_of(i)[*figure] : model.parameters_of(i).number(aim.name).value();
  }
  return json;
}

Json case_of(const PublishedStudy& study, const FigureModel& model, const Wanted& wanted, int i) {
  const int number = model.number_of(i);
  return {{"case", number + 1},
          {"hash", study.hash(number)},
          {"name", study.name(number)},
          {"values", figures_of_case(model, wanted, i)}};
}

Json values_of(const FigureModel& model, const Eigen::VectorXd& point) {
  Json values;
  for (std::size_t k = 0; k < model.varying().size(); ++k)
    values[model.varying()[k].name] = point[static_cast<Eigen::Index>(k)];
  return values;
}

Json optimum_of(const FigureModel& model, const Wanted& wanted) {
  const BestParameters best = best_parameters(model, wanted);
  Json json = {{"holds", best.holds},
               {"holds_within_errors", best.holds && best.certain},
               {"values", values_of(model, best.point)}};
  for (Eigen::Index f = 0; f < best.figures.size(); ++f) {
    const double fit = model.fit_error(static_cast<int>(f));
    json["figures"].push_back({{"figure", model.figures()[static_cast<std::size_t>(f)].text()},
                               {"value", best.figures[f]},
                               {"interpolation_error", best.errors[f]},
                               {"fit_error", std::isfinite(fit) ? Json(fit) : Json()}});
  }
  json["outside"] = model.outside(best.point);
  json["evaluations"] = best.evaluations;
  return json;
}

std::string aim_text(const Aim& aim) { return (aim.greatest ? "greatest " : "least ") + aim.name; }

/// "--set a=1,b=2".
std::string settings_of(const Json& values) {
  std::string text;
  for (const auto& [name, value] : values.items())
    text += (text.empty() ? "--set " : ",") + name + "=" + shortest(value.get<double>());
  return text;
}

std::string line_of_case(const Json& one) {
  std::string line = "case " + std::to_string(one["case"].get<int>()) + ": ";
  for (const auto& [name, value] : one["values"].items())
    line += name + " " + rounded(value.get<double>()) + ", ";
  const std::string hash = one["hash"].get<std::string>();
  return line + one["name"].get<std::string>() + (hash.empty() ? "" : " (" + hash + ")") + "\n";
}

void print_optimum(const Options& o, const Wanted& wanted, const Json& found) {
  const Json& optimum = found["optimum"];
  if (!optimum["holds"].get<bool>())
    std::cout << "nowhere between the cases does '" << o.where << "' hold"
              << (o.certain ? " wherever its figures are within their errors" : "")
              << "; it nearly does at\n";
  else
    std::cout << aim_text(wanted.aims().front()) << " between the cases, at\n";
  for (const auto& [name, value] : optimum["values"].items())
    std::cout << "  " << name << " = " << rounded(value.get<double>()) << "\n";
  for (const Json& one : optimum["figures"]) {
    std::cout << one["figure"].get<std::string>() << " there: " << rounded(one["value"].get<double>())
              << " mm +- " << rounded(one["interpolation_error"].get<double>()) << " (95 %)";
    if (!one["fit_error"].is_null())
      std::cout << "; error of the cases' own fields: " << rounded(one["fit_error"].get<double>());
    std::cout << "\n";
  }
  if (optimum["holds"].get<bool>() && !optimum["holds_within_errors"].get<bool>())
    std::cout << "the condition may fail by these errors; --certain keeps their distance\n";
  if (!found["cases"].empty())
    std::cout << "best of the simulated cases: " << line_of_case(found["cases"][0]);
  std::cout << "its field: cleft interpolate " << o.study << " " << settings_of(optimum["values"])
            << " --out between.dffd\n";
}

/// By the order in which the aims are named: of each kind as they were given.
std::vector<Aim> aims_of(const Options& o) {
  std::vector<Aim> aims;
  for (const std::string& name : o.minimize) aims.push_back({name, false});
  for (const std::string& name : o.maximize) {
    if (std::find(o.minimize.begin(), o.minimize.end(), name) != o.minimize.end())
      throw InputError("--maximize " + name + ": is to be least as well; give one of both");
    aims.push_back({name, true});
  }
  return aims;
}

void find_best(const Options& o) {
  const Wanted wanted(aims_of(o), o.where, o.certain);
  const PublishedStudy study(o.study);
  warn_of_left_out(study, "find");
  Progress progress("finding");
  const FigureModel model(study, wanted.figures(), report_cases(progress, study.size()));
  Json found = {{"minimize", o.minimize},
                {"maximize", o.maximize},
                {"where", o.where},
                {"cases_searched", study.size()},
                {"method", model.method()}};
  if (wanted.aims().size() == 1) {
    progress("searching between the cases");
    found["optimum"] = optimum_of(model, wanted);
  }
  found["cases"] = Json::array();
  for (const int i : best_cases(model, wanted)) found["cases"].push_back(case_of(study, model, wanted, i));
  if (o.json) return print_figures(found, true);
  if (found.contains("optimum")) return print_optimum(o, wanted, found);
  std::string lines, aims;
  for (const Json& one : found["cases"]) lines += line_of_case(one);
  for (const Aim& aim : wanted.aims()) aims += (aims.empty() ? "" : " and ") + aim_text(aim);
  std::cout << lines << found["cases"].size() << " of " << study.size()
            << " cases, which no other one surpasses in " << aims << "\n";
}

}  // namespace

int main(int argc, char** argv) {
  CommandLine app(
      "Finds cases of a study, lengths cut and places where a condition holds; or, with one aim, the "
      "parameters between the cases that reach it best; or, with several, the cases that no other one "
      "surpasses in all of them (Pareto).",
      "cleft find");
  Options o;
  app.add_option("STUDY", o.study, "a study folder, a study.dffd or a case.dffd")->required();
  app.add_option(
      "--where", o.where,
      "like 'gape > 3 and tissue.young_modulus < 0.01': gape (of the lips at a place, mm), t (length "
      "cut, mm), u (place along the cut, mm), error (of the field as it is drawn, %), displacement "
      "(largest, mm), and parameters; "
      "and or not, < <= > >= = !=, + - * / and brackets. With an aim all is cut, gape is the widest one, and "
      "figures as gape(12) have places; there is no t, u and error");
  app.add_option(
         "--minimize", o.minimize,
         "the figure that is to be least: gape, gape(u), gape(u, t), displacement, displacement(u, v, "
         "w), u, v or w in place of displacement for a component, mm; or a parameter (repeatable)")
      ->allow_extra_args(false);
  app.add_option("--maximize", o.maximize, "that is to be greatest (repeatable)")->allow_extra_args(false);
  app.add_flag("--certain", o.certain,
               "with one aim: the condition holds wherever its figures are within their errors");
  app.add_flag("--json", o.json, "as JSON");
  return run_command(app, argc, argv, [&] {
    const std::size_t aims = o.minimize.size() + o.maximize.size();
    if (aims == 0 && o.where.empty())
      throw InputError("--where is missing; give a condition, or an aim with --minimize or --maximize");
    if (o.certain && (aims != 1 || o.where.empty()))
      throw InputError("--certain: is for one --minimize or --maximize with a --where");
    if (aims == 0)
      find(o);
    else
      find_best(o);
  });
}
