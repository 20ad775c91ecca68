// cleft fit: the parameters of a study that explain measurements.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <sstream>

#include "base/command/command.h"
#include "base/error.h"
#include "base/output_file.h"
#include "base/text.h"
#include "explorer/analysis/fit.h"
#include "explorer/commands/analysis_options.h"
#include "params/run/chosen_cases.h"

using namespace cleft;

namespace {

constexpr double unlikely = 0.01;  // that measurements of a case are off by as much
constexpr int candidates_along = 9;

struct Options {
  std::string study, out;
  std::vector<std::string> measured, given;
  double deviation = 0;
  std::uint64_t seed = 1;
  bool json = false;
};

void refuse_forces_of_bodies(const std::string& study) {
  if (!std::filesystem::is_directory(study)) return;
  if (!read_study(StudyFolder(study).study_file()).base.body.empty())
    throw InputError(study +
                     ": columns force and tension are known of boxes of tissue, not of a body; leave out "
                     "their files");
}

/// Openings along the cut of the first case, when half and all of it is cut.
std::vector<Figure> candidates(const PublishedStudy& study) {
  const Field field = study.read(0);
  std::vector<Figure> list;
  for (const double part : {0.5, 1.})
    for (int i = 1; i <= candidates_along; ++i) {
      const double along = 1. * i / (candidates_along + 1);
      if (along >= part) continue;
      const auto round = [](double value) { return shortest(std::round(10 * value) / 10); };
      list.emplace_back("gape(" + round(field.cut().start + along * field.cut().length) +
                        (part < 1 ? ", " + round(part * field.duration()) : "") + ")");
    }
  return list;
}

Json to_json(const ParameterFit& fit, const FigureModel& model, const Measurements& measured) {
  Json json = {{"measurements", measured.size()},
               {"cases", model.cases()},
               {"method", model.method()},
               {"misfit", fit.misfit},
               {"misfit_probability", fit.misfit_probability}};
  for (const FittedParameter& p : fit.parameters)
    json["parameters"].push_back({{"name", p.name},
                                  {"mean", p.mean},
                                  {"deviation", p.deviation},
                                  {"interval_90", {p.low, p.high}},
                                  {"most_likely", p.most_likely},
                                  {"told", p.told}});
  for (Eigen::Index a = 0; a < fit.correlation.rows(); ++a) {
    json["correlation"].push_back(Json::array());
    for (const double value : fit.correlation.row(a)) json["correlation"].back().push_back(value);
  }
  json["open"] = fit.open;
  for (Eigen::Index i = 0; i < fit.residuals.size(); ++i)
    json["residuals"].push_back({{"figure", measured.text(i)},
                                 {"unit", measured.unit(i)},
                                 {"measured", measured.values[i]},
                                 {"residual", fit.residuals[i]},
                                 {"deviation", measured.deviations[i]}});
  for (std::size_t k = 0; k < fit.parameters.size(); ++k)
    json["next_case"][fit.parameters[k].name] = fit.next_case[static_cast<Eigen::Index>(k)];
  json["draws"] = {{"effective", fit.posterior.effective}, {"evaluations", fit.posterior.evaluations}};
  return json;
}

void write_draws(const std::string& file, const ParameterFit& fit, const Eigen::MatrixXd& values) {
  std::ostringstream text;
  for (std::size_t k = 0; k < fit.parameters.size(); ++k) text << (k ? "," : "") << fit.parameters[k].name;
  text << "\n";
  for (Eigen::Index j = 0; j < values.cols(); ++j)
    for (Eigen::Index k = 0; k < values.rows(); ++k)
      text << shortest(values(k, j)) << (k + 1 < values.rows() ? "," : "\n");
  write_text_file(file, text.str());
}

void print(const Json& found) {
  std::cout << found["measurements"] << " measurements, " << found["cases"] << " cases\n\n  "
            << "parameter                  most likely   90 % of what is possible    told\n";
  for (const Json& p : found["parameters"]) {
    char line[200];
    std::snprintf(line, sizeof line, "  %-26s %-13s %-11s to %-11s %3.0f %%\n",
                  p["name"].get<std::string>().c_str(), rounded(p["most_likely"]).c_str(),
                  rounded(p["interval_90"][0]).c_str(), rounded(p["interval_90"][1]).c_str(),
                  100 * p["told"].get<double>());
    std::cout << line;
  }
  std::cout << "\n  residuals are " << rounded(found["misfit"]) << " of their expected size\n";
  for (const Json& sentence : found["open"]) std::cout << "  " << sentence.get<std::string>() << "\n";
  std::cout << "  to tell more, measure " << found["next_measurement"]["figure"].get<std::string>()
            << ", which may still be " << rounded(found["next_measurement"]["spread"])
            << " mm higher or lower, or simulate";
  bool first = true;
  for (const auto& [name, value] : found["next_case"].items())
    std::cout << (first ? " " : ", ") << name << " = " << rounded(value), first = false;
  std::cout << "\n";
}

}  // namespace

int main(int argc, char** argv) {
  CommandLine app(
      "Finds the parameters of a study whose openings, motions and forces fit measurements, and how surely.",
      "cleft fit");
  Options o;
  app.add_option("STUDY", o.study, "a study folder or a study.dffd")->required();
  app.add_option(
         "--to", o.measured,
         "CSV file of measurements, once for each file. Of lengths, mm: columns u and gape along the "
         "cut; or u, v, w and displacement, du, dv or dw of points; t, the length cut (default: all). "
         "Of a flat punch pressed into the uncut skin: force (N), dent (how deep, mm) and radius (mm). "
         "Of the pull that holds the cut closed: tension (N/mm). deviation: the standard deviation of "
         "their errors, in the unit of the values")
      ->allow_extra_args(false)
      ->required();
  app.add_option("--deviation", o.deviation,
                 "standard deviation of the errors of lengths, mm, without such a column")
      ->check(above(0));
  app.add_option("--given", o.given, help_of_given)->allow_extra_args(false);
  app.add_option("--out", o.out, "CSV file of possible values of all parameters, drawn by their probability");
  app.add_option("--seed", o.seed, "of the draws")->capture_default_str();
  app.add_flag("--json", o.json, "as JSON");
  return run_command(app, argc, argv, [&] {
    const Measurements measured = read_measurements(o.measured, o.deviation);
    std::vector<std::string> inputs = o.measured;
    inputs.push_back(o.study);
    if (!o.out.empty()) refuse_to_overwrite(o.out, inputs);
    if (!measured.forces.empty()) refuse_forces_of_bodies(o.study);
    const PublishedStudy study(o.study);
    warn_of_left_out(study, "fit");
    Json found;
    {
      Progress progress("fitting");
      const std::vector<Figure> any{Figure("gape")};
      const FigureModel model(study, measured.figures.empty() ? any : measured.figures,
                              report_cases(progress, study.size()));
      const std::vector<InputDistribution> distributions = distributions_of(model, o.given);
      progress("drawing values of the parameters");
      const MeasurementFit fit_of(model, measured, distributions);
      PosteriorSettings settings;
      settings.seed = o.seed;
      const ParameterFit fit = fit_of.find(settings);
      found = to_json(fit, model, measured);
      const Eigen::MatrixXd values = fit_of.values_at(fit.posterior.points);
      const FigureModel further(study, candidates(study));
      const NextMeasurement next = next_measurement(further, values);
      found["next_measurement"] = {
          {"figure", further.figures()[static_cast<std::size_t>(next.figure)].text()},
          {"spread", next.spread}};
      if (!o.out.empty()) write_draws(o.out, fit, values);
    }
    if (found["misfit_probability"].get<double>() < unlikely)
      std::cerr << "cleft fit: warning: no case of the study's ranges fits: the residuals are "
                << rounded(found["misfit"])
                << " of their expected size; the model lacks something, or the deviations are too small\n";
    if (o.json) return print_figures(found, true);
    print(found);
  });
}
