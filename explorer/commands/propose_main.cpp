// cleft propose: the cases that a study needs most.
#include <algorithm>
#include <boost/random/sobol.hpp>
#include <boost/random/uniform_01.hpp>
#include <cmath>
#include <iostream>

#include "base/command/command.h"
#include "base/error.h"
#include "base/text.h"
#include "explorer/analysis/next_cases.h"
#include "explorer/commands/analysis_options.h"
#include "params/consistency.h"
#include "params/run/chosen_cases.h"

using namespace cleft;

namespace {

constexpr int candidates_drawn = 1024;
constexpr double digits = 1e-6;  // values are rounded to this part of their size

struct Options {
  std::string study, figure;
  int count = 8;
  bool json = false;
};

struct Ranges {
  std::vector<Variation> list;  // in the order of the model's parameters
  Eigen::VectorXd lengths;
};

/// The ranges of the study's file, one for each parameter that varies.
Ranges ranges_of(const Study& study, const FigureModel& model) {
  Ranges ranges;
  ranges.lengths.resize(std::ssize(model.varying()));
  for (const FigureModel::Varied& one : model.varying()) {
    const auto found = std::find_if(study.vary.begin(), study.vary.end(),
                                    [&](const Variation& v) { return v.name == one.name; });
    Variation variation{one.name, {}, Range{one.least, one.greatest}};
    if (found != study.vary.end() && found->range) variation.range = found->range;
    ranges.lengths[std::ssize(ranges.list)] = std::abs(variation.range->to - variation.range->from);
    ranges.list.push_back(std::move(variation));
  }
  return ranges;
}

double rounded_value(double value, const Range& range) {
  const double unit = std::pow(10., std::floor(std::log10(std::max(std::abs(value), 1e-300)))) * digits;
  const auto [least, greatest] = std::minmax(range.from, range.to);
  return std::clamp(parse_number(shortest(std::round(value / unit) * unit), "value"), least, greatest);
}

/// Evenly in the ranges, without those that no patch could be meshed for.
Eigen::MatrixXd candidates_in(const Study& study, const Ranges& ranges) {
  const auto d = static_cast<Eigen::Index>(ranges.list.size());
  boost::random::sobol sequence(ranges.list.size());
  boost::random::uniform_01<double> unit_fraction;
  Eigen::MatrixXd all(d, candidates_drawn);
  Eigen::Index count = 0;
  for (int i = 0; i < candidates_drawn; ++i) {
    Case one = study.base;
    for (Eigen::Index k = 0; k < d; ++k) {
      const Variation& variation = ranges.list[static_cast<std::size_t>(k)];
      all(k, count) = rounded_value(variation.range->at(unit_fraction(sequence), 1), *variation.range);
      set_parameter(one.parameters, variation.name, all(k, count), study.name);
    }
    try {
      check_consistency(one.parameters, study.name);
      ++count;
    } catch (const InputError&) {  // not a case
    }
  }
  return all.leftCols(count);
}

Eigen::MatrixXd failed_cases(const StudyFolder& folder, const Study& study, const Ranges& ranges) {
  const std::vector<Case> cases = cases_of(study, folder);
  const std::vector<CaseStatus> states = folder.status(cases, folder.index());
  Eigen::MatrixXd failed(std::ssize(ranges.list), 0);
  for (std::size_t c = 0; c < cases.size(); ++c) {
    if (states[c].state != CaseState::failed) continue;
    failed.conservativeResize(Eigen::NoChange, failed.cols() + 1);
    for (std::size_t k = 0; k < ranges.list.size(); ++k)
      failed(static_cast<Eigen::Index>(k), failed.cols() - 1) = std::get<double>(
          get_parameter(cases[c].parameters, find_parameter(ranges.list[k].name, study.name)));
  }
  return failed;
}

Json propose(const Options& o) {
  const StudyFolder folder(o.study);
  const Study study = read_study(folder.study_file());
  const PublishedStudy published(o.study);
  Progress progress("choosing");
  const std::string figure = o.figure.empty() ? study.sampling.of : o.figure;
  const FigureModel model(published, {Figure(figure)}, report_cases(progress, published.size()));
  const Ranges ranges = ranges_of(study, model);
  progress("comparing candidates");
  const NextCases next = next_cases(model, candidates_in(study, ranges), ranges.lengths,
                                    failed_cases(folder, study, ranges), o.count);
  Json json = {{"figure", figure},
               {"cases", model.cases()},
               {"method", model.method()},
               {"error", next.error},
               {"proposed", Json::array()}};
  for (Eigen::Index j = 0; j < next.points.cols(); ++j) {
    Json values;
    for (Eigen::Index k = 0; k < next.points.rows(); ++k)
      values[ranges.list[static_cast<std::size_t>(k)].name] = next.points(k, j);
    json["proposed"].push_back({{"values", values}, {"error", next.errors[j]}});
  }
  return json;
}

}  // namespace

int main(int argc, char** argv) {
  CommandLine app("Tells which cases a study needs most, so that a figure is known everywhere in its ranges.",
                  "cleft propose");
  Options o;
  app.add_option("DIR", o.study, "study folder")->required();
  app.add_option("--count", o.count, "cases")->check(in_range(1, 1000))->capture_default_str();
  app.add_option("--of", o.figure,
                 "the figure: field (all of the skin), or one of cleft analyze (default: sampling.of of the "
                 "study, field)");
  app.add_flag("--json", o.json, "as JSON");
  return run_command(app, argc, argv, [&] {
    const Json found = propose(o);
    if (o.json) return print_figures(found, true);
    std::cout << found["figure"].get<std::string>() << ": estimated error " << rounded(found["error"])
              << " of its largest value, by " << found["cases"] << " cases; most would be learned from\n";
    for (const Json& one : found["proposed"]) {
      for (const auto& [name, value] : one["values"].items())
        std::cout << "  " << name << "=" << value.dump();
      std::cout << "  (error there " << rounded(one["error"]) << ")\n";
    }
  });
}
