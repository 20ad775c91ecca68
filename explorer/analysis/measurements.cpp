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

struct Reading {
  std::vector<Figure> figures;
  std::vector<SkinForce> forces;
  std::vector<double> values, deviations, of_forces, deviations_of_forces;
};

/// A file as it is read, and where in it.
struct Row {
  const std::string& file;
  const NumberTable& table;
  std::size_t number;

  bool has(const char* name) const { return table.column(name) >= 0; }
  double at(const char* name) const {
    return table.rows[number][static_cast<std::size_t>(table.column(name))];
  }
  std::string place() const { return file + ", row " + std::to_string(number + 1); }
  double finite(const char* name) const {
    if (!std::isfinite(at(name))) throw InputError(place() + ": " + name + " is not a finite number");
    return at(name);
  }
  double above_zero(const char* name) const {
    if (!(at(name) > 0 && std::isfinite(at(name))))
      throw InputError(place() + ": " + name + " is " + shortest(at(name)) + "; it must be above 0");
    return at(name);
  }
};

void check_columns(const std::string& file, const NumberTable& table, const std::vector<std::string>& known,
                   const std::string& expected) {
  const auto unknown = std::find_if(table.columns.begin(), table.columns.end(), [&](const std::string& name) {
    return std::find(known.begin(), known.end(), name) == known.end();
  });
  if (unknown != table.columns.end())
    throw InputError(file + ": unknown column '" + *unknown + "'" + did_you_mean(*unknown, known) +
                     "; expected " + expected);
}

void read_lengths(const Row& row, double deviation, Reading& all) {
  const std::string& file = row.file;
  for (const auto& [name, figure, of_point] : measured) {
    if (!row.has(name)) continue;
    if (of_point && !(row.has("u") && row.has("v") && row.has("w")))
      throw InputError(file + ": column " + name + " needs the columns u, v and w: the point that moves");
    std::string place;
    if (of_point)
      place = shortest(row.at("u")) + ", " + shortest(row.at("v")) + ", " + shortest(row.at("w"));
    else if (row.has("u"))
      place = shortest(row.at("u"));
    else if (row.has("t"))
      throw InputError(file + ": column t needs the column u: the place of the gape");
    if (row.has("t")) place += ", " + shortest(row.at("t"));
    all.figures.emplace_back(place.empty() ? figure : figure + ("(" + place + ")"));
    all.values.push_back(row.finite(name));
    all.deviations.push_back(row.has("deviation") ? row.at("deviation") : deviation);
    if (!(all.deviations.back() > 0 && std::isfinite(all.deviations.back())))
      throw InputError(row.place() +
                       ": the deviation must be above 0 mm; add a column deviation, or give --deviation");
  }
}

/// `name`: force or tension.
void check_force_columns(const std::string& file, const NumberTable& table, const std::string& name) {
  const bool punch = name == "force";
  const std::vector<std::string> known =
      punch ? std::vector<std::string>{"force", "dent", "radius", "deviation"}
            : std::vector<std::string>{"tension", "deviation"};
  const auto other = std::find_if(table.columns.begin(), table.columns.end(), [&](const std::string& column) {
    return std::find(known.begin(), known.end(), column) == known.end();
  });
  if (other != table.columns.end())
    throw InputError(
        file + ": column " + *other + " cannot stand beside " + name + ", which has the columns " +
        (punch ? "force, dent, radius" : "tension") +
        " and deviation; put other measurements into a file of their own, and give --to for each");
  for (const std::string& column : known) {
    if (table.column(column) >= 0) continue;
    std::string message = file;
    message.append(": column ").append(name).append(" needs the column ").append(column).append(": ");
    message += column == "dent"     ? "how deep the punch is pressed in, mm"
               : column == "radius" ? "of the punch, mm"
               : punch
                   ? "the standard deviation of the force's errors, N (--deviation is that of lengths)"
                   : "the standard deviation of the tension's errors, N/mm (--deviation is that of lengths)";
    throw InputError(message);
  }
}

void read_force(const Row& row, bool punch, Reading& all) {
  SkinForce force;
  if (punch) force = {SkinForce::Kind::punch, row.above_zero("dent"), row.above_zero("radius")};
  all.forces.push_back(force);
  all.of_forces.push_back(row.finite(punch ? "force" : "tension"));
  all.deviations_of_forces.push_back(row.above_zero("deviation"));
}

void read_file(const std::string& file, double deviation, Reading& all) {
  const NumberTable table = read_csv(file);
  const bool punch = table.column("force") >= 0, of_force = punch || table.column("tension") >= 0;
  if (of_force)
    check_force_columns(file, table, punch ? "force" : "tension");
  else
    check_columns(file, table,
                  {"u", "v", "w", "t", "gape", "displacement", "du", "dv", "dw", "deviation", "force", "dent",
                   "radius", "tension"},
                  "u, v, w, t, deviation and gape, displacement, du, dv or dw; or force, dent, radius and "
                  "deviation; or tension and deviation");
  const std::size_t before = all.values.size() + all.of_forces.size();
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const Row row{file, table, i};
    if (of_force)
      read_force(row, punch, all);
    else
      read_lengths(row, deviation, all);
  }
  if (all.values.size() + all.of_forces.size() == before)
    throw InputError(file +
                     ": holds no measurement; expected columns gape, displacement, du, dv or dw, force or "
                     "tension, and rows of numbers");
}

Eigen::VectorXd joined(std::vector<double> first, const std::vector<double>& then) {
  first.insert(first.end(), then.begin(), then.end());
  return Eigen::Map<Eigen::VectorXd>(first.data(), std::ssize(first));
}

}  // namespace

std::string Measurements::text(Eigen::Index i) const {
  const auto k = static_cast<std::size_t>(i);
  return k < figures.size() ? figures[k].text() : forces[k - figures.size()].text();
}

std::string Measurements::unit(Eigen::Index i) const {
  const auto k = static_cast<std::size_t>(i);
  return k < figures.size() ? figures[k].unit() : forces[k - figures.size()].unit();
}

Measurements read_measurements(const std::vector<std::string>& files, double deviation) {
  Reading all;
  for (const std::string& file : files) read_file(file, deviation, all);
  return {all.figures, all.forces, joined(all.values, all.of_forces),
          joined(all.deviations, all.deviations_of_forces)};
}

}  // namespace cleft
