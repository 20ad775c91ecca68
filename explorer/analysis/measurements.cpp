#include "explorer/analysis/measurements.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"
#include "base/text.h"

namespace cleft {

namespace {

struct Column {
  const char *name, *figure;
  bool of_point;
};
constexpr std::array<Column, 5> measured = {{{"gape", "gape", false},
                                             {"displacement", "displacement", true},
                                             {"du", "u", true},
                                             {"dv", "v", true},
                                             {"dw", "w", true}}};

}  // namespace

Measurements read_measurements(const std::string& file, double deviation) {
  const NumberTable table = read_csv(file);
  static const std::vector<std::string> known = {"u",  "v",  "w",  "t",        "gape", "displacement",
                                                 "du", "dv", "dw", "deviation"};
  const auto unknown = std::find_if(table.columns.begin(), table.columns.end(), [](const std::string& name) {
    return std::find(known.begin(), known.end(), name) == known.end();
  });
  if (unknown != table.columns.end())
    throw InputError(file + ": unknown column '" + *unknown + "'" + did_you_mean(*unknown, known) +
                     "; expected u, v, w, t, deviation and gape, displacement, du, dv or dw");
  Measurements all;
  std::vector<double> values, deviations;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const auto at = [&](const char* name) {
      return table.rows[i][static_cast<std::size_t>(table.column(name))];
    };
    const auto has = [&](const char* name) { return table.column(name) >= 0; };
    const std::string row = file + ", row " + std::to_string(i + 1);
    for (const auto& [name, figure, of_point] : measured) {
      if (!has(name)) continue;
      if (of_point && !(has("u") && has("v") && has("w")))
        throw InputError(file + ": column " + name + " needs the columns u, v and w: the point that moves");
      std::string place;
      if (of_point)
        place = shortest(at("u")) + ", " + shortest(at("v")) + ", " + shortest(at("w"));
      else if (has("u"))
        place = shortest(at("u"));
      else if (has("t"))
        throw InputError(file + ": column t needs the column u: the place of the gape");
      if (has("t")) place += ", " + shortest(at("t"));
      all.figures.emplace_back(place.empty() ? figure : figure + ("(" + place + ")"));
      values.push_back(at(name)), deviations.push_back(has("deviation") ? at("deviation") : deviation);
      if (!std::isfinite(values.back())) throw InputError(row + ": " + name + " is not a finite number");
      if (!(deviations.back() > 0 && std::isfinite(deviations.back())))
        throw InputError(row +
                         ": the deviation must be above 0 mm; add a column deviation, or give --deviation");
    }
  }
  if (values.empty())
    throw InputError(file + ": holds no measurement; expected columns gape, displacement, du, dv or dw");
  all.values = Eigen::Map<Eigen::VectorXd>(values.data(), std::ssize(values));
  all.deviations = Eigen::Map<Eigen::VectorXd>(deviations.data(), std::ssize(deviations));
  return all;
}

}  // namespace cleft
