#include "explorer/study/find.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "explorer/study/case_figures.h"
#include "params/parameters/table.h"
#include "solver/snapshot/snapshot.h"

namespace cleft {

namespace {

enum Name : std::size_t { gape_name, t_name, u_name, error_name, displacement_name };

const std::vector<std::string>& names() {
  static const std::vector<std::string> all = [] {
    std::vector<std::string> list{"gape", "t", "u", "error", "displacement"};
    for (const Parameter& p : parameter_table())
      if (!p.is_text()) list.push_back(p.name);
    return list;
  }();
  return all;
}

std::vector<double> values_of(const Field& field) {
  std::vector<double> values(names().size(), std::nan(""));
  values[error_name] = 100 * field.report.spline_error;
  values[displacement_name] = field.report.largest_displacement;
  for (std::size_t i = displacement_name + 1; i < values.size(); ++i)
    values[i] = field.parameters.number(names()[i]).value_or(std::nan(""));
  return values;
}

}  // namespace

Condition::Condition(const std::string& text) : expression_(text, names()) {}

bool Condition::holds(std::vector<double>& values, double t, double u, double opening) const {
  values[t_name] = t, values[u_name] = u, values[gape_name] = opening;
  return expression_.holds(values);
}

std::optional<Finding> Condition::find(const Field& field) const {
  constexpr int times = 60, places = 80;
  std::vector<double> values = values_of(field);
  const CanonicalCut& cut = field.cut();
  std::optional<Finding> found;
  const bool uses_gape = expression_.uses(gape_name);
  for (int j = 0; j <= times; ++j)
    for (int i = 0; i <= places; ++i) {
      const double t = field.duration() * j / times, u = cut.start + cut.length * i / places;
      const double opening = uses_gape || found ? gape(field, u, t) : 0;
      if (!holds(values, t, u, opening)) continue;
      if (!found) found = Finding{t, t, u, u, t, u, gape(field, u, t), {}};
      found->last_t = t;
      found->least_u = std::min(found->least_u, u), found->greatest_u = std::max(found->greatest_u, u);
      if (opening > found->gape) found->best_t = t, found->best_u = u, found->gape = opening;
    }
  return found;
}

std::optional<Finding> Condition::find(const Field& field, const std::string& file) const {
  std::optional<Finding> found = find(field);
  if (!found || !std::filesystem::exists(file)) return found;
  const SnapshotReader reader(file);
  const Snapshot& s = reader.snapshot();
  std::size_t frame = 0;
  for (std::size_t j = 0; j < s.frames(); ++j)
    if (std::abs(s.times[j] - found->best_t) < std::abs(s.times[frame] - found->best_t)) frame = j;
  const std::vector<Vec3> displacement = reader.displacement(frame), places = reader.coordinates();
  std::vector<double> values = values_of(field);
  found->confirmed = std::any_of(s.pairs.begin(), s.pairs.end(), [&](const auto& pair) {
    const auto left = static_cast<std::size_t>(pair[0]), right = static_cast<std::size_t>(pair[1]);
    return std::abs(places[left].z) < 1e-9 &&
           holds(values, found->best_t, places[left].x, norm(displacement[right] - displacement[left]));
  });
  return found;
}

std::optional<Finding> find_in_case(const Condition& condition, const PublishedStudy& study, int i) {
  const Field field = study.read(i);
  return condition.find(field, study.snapshot(i));
}

}  // namespace cleft
