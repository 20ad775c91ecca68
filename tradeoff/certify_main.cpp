// cleft certify: rigorous bounds of the errors of fields between the cases of a study.
#include <algorithm>
#include <cmath>
#include <iostream>

#include "base/command/command.h"
#include "base/error.h"
#include "base/text.h"
#include "tradeoff/certificate.h"

using namespace cleft;

namespace {

constexpr double much = 10;  // times the error, which a bound should not be

struct Options {
  std::string study, points;
  std::vector<std::string> assignments;
  bool solve = false, json = false;
};

std::vector<ParametersByName> points_of(const Options& o) {
  std::vector<ParametersByName> points;
  if (!o.assignments.empty()) points.push_back(numbers_by_name(o.assignments, "--set"));
  if (!o.points.empty()) {
    const NumberTable table = read_csv(o.points);
    for (const std::vector<double>& row : table.rows) {
      ParametersByName& values = points.emplace_back();
      for (std::size_t c = 0; c < row.size(); ++c) values[table.columns[c]] = row[c];
    }
  }
  if (points.empty())
    throw InputError(o.points.empty() ? "--set or --points is missing: which parameters?"
                                      : o.points + ": has no rows; give a row for each point");
  return points;
}

/// Over the size of what is shown.
double share(double part, double whole) { return whole > 0 ? part / whole : 0; }

Json to_json(const Certificate& one) {
  Json json = {{"values", one.values},
               {"relative_bound", share(one.bound.back(), one.size.back())},
               {"reference", one.reference},
               {"bound_over_error_at_most", one.most_over_error},
               {"closed_pairs_moved_mm", one.moved},
               {"frames", Json::array()}};
  for (std::size_t j = 0; j < one.bound.size(); ++j) {
    Json frame = {{"length_cut_mm", one.length_cut[j]}, {"bound", one.bound[j]}, {"size", one.size[j]}};
    if (!one.error.empty()) frame["error"] = one.error[j];
    json["frames"].push_back(frame);
  }
  return json;
}

std::string percent(double part) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g %%", 100 * part);
  return text;
}

void print(const Certificate& one) {
  std::string values;
  for (const auto& [name, value] : one.values)
    values += (values.empty() ? "" : " ") + name + "=" + shortest(value);
  std::cout << values << "\n  when all is cut the error is at most "
            << percent(share(one.bound.back(), one.size.back())) << " of the field";
  if (!one.error.empty()) std::cout << "; it is " << percent(share(one.error.back(), one.size.back()));
  std::cout << "\n  the bound is at most " << std::round(100 * one.most_over_error) / 100
            << " times the error; by the stiffness of " << one.reference << "\n";
}

void warn(const Certificate& one) {
  if (one.most_over_error > much)
    std::cerr << "cleft certify: warning: a bound may be " << std::lround(one.most_over_error)
              << " times the error, because the moduli differ much from those of " << one.reference
              << "; ask for fewer points at a time\n";
}

}  // namespace

int main(int argc, char** argv) {
  CommandLine app(
      "Bounds the error of a field between the cases of a study, without solving its case: in the norm of "
      "the energy (the root of twice the elastic energy of the difference), of what is shown at the nodes of "
      "its mesh. Rigorous for small strains without contact. All points of one mesh share one factorisation, "
      "which takes about as long as one simulation.",
      "cleft certify");
  Options o;
  app.add_option("STUDY", o.study, "study folder, or its study.dffd")->required();
  app.add_option("--set", o.assignments,
                 "NAME=VALUE[,NAME=VALUE...]: every parameter in which the study's cases differ")
      ->delimiter(',');
  app.add_option("--points", o.points, "CSV whose columns are these parameters: a point in each row");
  app.add_flag("--solve", o.solve, "solve the cases too, and tell the error itself");
  app.add_flag("--json", o.json, "all frames as JSON: a list, of each point");
  return run_command(app, argc, argv, [&] {
    const std::vector<ParametersByName> points = points_of(o);
    Progress progress("certifying");
    const std::vector<Certificate> found =
        certificates(o.study, points, o.solve, [&](const std::string& state) { progress(state); });
    Json list = Json::array();
    for (const Certificate& one : found) {
      warn(one);
      list.push_back(to_json(one));
    }
    if (o.json) return print_figures(list, true);
    for (const Certificate& one : found) print(one);
  });
}
