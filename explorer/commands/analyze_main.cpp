// cleft analyze: what a figure of a study depends on, and how it is distributed.
#include <algorithm>
#include <cmath>
#include <iostream>

#include "base/command/command.h"
#include "base/error.h"
#include "base/quantiles.h"
#include "base/text.h"
#include "explorer/analysis/figure_model.h"
#include "explorer/analysis/interactions.h"
#include "explorer/analysis/sensitivity.h"
#include "explorer/commands/analysis_options.h"

using namespace cleft;

namespace {

constexpr int parts_left_out = 8;
constexpr Eigen::Index errors_estimated = 512;  // points
constexpr double much_outside = 0.01;           // of the draws
constexpr double least_share = 0.005;           // of the variance, of a pair that is printed

struct Options {
  std::string study, figure = "gape";
  std::vector<std::string> given;
  int samples = 2048;
  bool json = false;
};

Json to_json(const Estimate& one) { return {{"value", one.value}, {"error", one.error}}; }

/// The largest distance outside of the ranges of the cases counts: the draws in which one parameter is.
double share_outside(const FigureModel& model, const Eigen::MatrixXd& points) {
  Eigen::Index outside = 0;
  for (Eigen::Index j = 0; j < points.cols(); ++j) {
    bool out = false;
    for (Eigen::Index k = 0; k < points.rows(); ++k) {
      const FigureModel::Varied& range = model.varying()[static_cast<std::size_t>(k)];
      const double slack = 1e-9 * (range.greatest - range.least);
      out = out || points(k, j) < range.least - slack || points(k, j) > range.greatest + slack;
    }
    outside += out;
  }
  return static_cast<double>(outside) / static_cast<double>(points.cols());
}

Json to_json(const Interaction& pair, const std::vector<InputDistribution>& distributions) {
  Json mean = Json::array();
  for (Eigen::Index q = 0; q < pair.mean.cols(); ++q)
    mean.push_back(std::vector<double>(pair.mean.col(q).begin(), pair.mean.col(q).end()));
  return {{"parameters", {distributions[pair.one].name(), distributions[pair.other].name()}},
          {"share", to_json(pair.share)},
          {"at", {pair.at, pair.other_at}},
          {"mean", mean}};
}

Json analyze(const Options& o) {
  const PublishedStudy study(o.study);
  warn_of_left_out(study, "analyze");
  Progress progress("analyzing");
  const FigureModel model(study, {Figure(o.figure)}, [&](double part) {
    progress("case " + std::to_string(1 + static_cast<int>(part * study.size())) + " of " +
             std::to_string(study.size()));
  });
  std::vector<RangeOfName> ranges;
  for (const FigureModel::Varied& one : model.varying())
    ranges.push_back({one.name, one.least, one.greatest});
  const std::vector<InputDistribution> distributions = distributions_of(ranges, o.given);

  const FigureFunction figure = [values = model.values()](const Eigen::MatrixXd& points) {
    return Eigen::VectorXd(values(points).row(0).transpose());
  };
  const AlternativeFigures alternatives = model.without_parts(std::min(parts_left_out, model.cases()), 0);
  progress("drawing values of the parameters");
  const Sensitivities found = sensitivities_of(distributions, figure, alternatives, o.samples);
  const Eigen::VectorXd errors =
      model.at(found.points.leftCols(std::min<Eigen::Index>(errors_estimated, found.points.cols())))
          .errors.row(0)
          .transpose();
  const double fit = model.fit_error(0);
  progress("looking at pairs of parameters");
  const std::vector<Interaction> interactions = interactions_of(distributions, figure, alternatives, found);

  Json json = {{"figure", o.figure},     {"unit", model.figures()[0].unit()},
               {"cases", model.cases()}, {"method", model.method()},
               {"mean", found.mean},     {"deviation", found.deviation}};
  for (std::size_t q = 0; q < found.parts.size(); ++q)
    json["quantiles"].push_back({{"part", found.parts[q]}, {"value", found.quantiles[q]}});
  json["interpolation_error"] = {{"median", median({errors.begin(), errors.end()})},
                                 {"largest", errors.maxCoeff()}};
  json["fit_error"] = std::isfinite(fit) ? Json(fit) : Json();
  json["share_outside"] = share_outside(model, found.points);
  json["evaluations"] = found.evaluations;
  for (std::size_t k = 0; k < distributions.size(); ++k) {
    const ParameterEffect& effect = found.parameters[k];
    json["parameters"].push_back({{"name", distributions[k].name()},
                                  {"distribution", distributions[k].text()},
                                  {"first_order", to_json(effect.first)},
                                  {"total", to_json(effect.total)},
                                  {"main_effect", {{"at", effect.at}, {"mean", effect.mean}}}});
  }
  json["interactions"] = Json::array();
  for (const Interaction& pair : interactions) json["interactions"].push_back(to_json(pair, distributions));
  return json;
}

std::string number(double value) { return formatted("%.4g", value); }

/// Those whose share is no error.
void print_interactions(const Json& pairs) {
  bool any = false;
  for (const Json& pair : pairs) {
    const double share = pair["share"]["value"], error = pair["share"]["error"];
    if (share < least_share || share < error) continue;
    if (!any) std::cout << "\n  pairs together, beyond what each makes alone\n";
    any = true;
    std::cout << formatted("  %.3f +- %.3f    ", share, error) << pair["parameters"][0].get<std::string>()
              << ", " << pair["parameters"][1].get<std::string>() << "\n";
  }
}

void print(const Json& found) {
  const std::string unit = " " + found["unit"].get<std::string>();
  const auto of = [&](const Json& value) { return number(value.get<double>()); };
  std::cout << found["figure"].get<std::string>() << " of " << found["cases"] << " cases ("
            << found["method"].get<std::string>() << ")\n  mean " << of(found["mean"]) << unit
            << ", standard deviation " << of(found["deviation"]) << unit << "\n  quantiles";
  for (const Json& q : found["quantiles"])
    std::cout << (q == found["quantiles"][0] ? " " : ", ") << 100 * q["part"].get<double>()
              << " %: " << of(q["value"]);
  std::cout << "\n  error between the cases (95 %): median " << of(found["interpolation_error"]["median"])
            << unit << ", largest " << of(found["interpolation_error"]["largest"]) << unit;
  if (!found["fit_error"].is_null())
    std::cout << "; of the cases' own fields: " << of(found["fit_error"]) << unit;
  std::cout << "\n\n  share of the variance      alone              with others        over\n";
  std::vector<Json> rows = found["parameters"];
  std::stable_sort(rows.begin(), rows.end(), [](const Json& a, const Json& b) {
    return a["total"]["value"].get<double>() > b["total"]["value"].get<double>();
  });
  for (const Json& row : rows) {
    std::cout << formatted("  %-26s %.3f +- %.3f    %.3f +- %.3f    %s\n",
                           row["name"].get<std::string>().c_str(), row["first_order"]["value"].get<double>(),
                           row["first_order"]["error"].get<double>(), row["total"]["value"].get<double>(),
                           row["total"]["error"].get<double>(),
                           row["distribution"].get<std::string>().c_str());
  }
  print_interactions(found["interactions"]);
}

}  // namespace

int main(int argc, char** argv) {
  CommandLine app(
      "Tells what a figure of a study depends on: Sobol's indices of each parameter, and how the figure is "
      "distributed, with their errors.",
      "cleft analyze");
  Options o;
  app.add_option("STUDY", o.study, "a study folder or a study.dffd")->required();
  app.add_option(
         "--of", o.figure,
         "the figure: gape, gape(u), gape(u, t), displacement, displacement(u, v, w), or u, v or w in "
         "place of displacement for a component; mm")
      ->capture_default_str();
  app.add_option("--given", o.given, help_of_given)->allow_extra_args(false);
  app.add_option("--samples", o.samples, "size of the sample from which the indices are estimated")
      ->check(in_range(64, 1 << 20))
      ->capture_default_str();
  app.add_flag("--json", o.json, "as JSON, with the curves of each parameter's effect and of pairs");
  return run_command(app, argc, argv, [&] {
    const Json found = analyze(o);
    if (const double share = found["share_outside"].get<double>(); share > much_outside)
      std::cerr
          << "cleft analyze: warning: " << std::round(1000 * share) / 10
          << " % of the values lie outside the study's cases, where the figure is a guess; run more cases, "
             "or give a narrower distribution with --given\n";
    if (o.json) return print_figures(found, true);
    print(found);
  });
}
