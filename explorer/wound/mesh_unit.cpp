#include "explorer/wound/mesh_unit.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/error.h"
#include "base/text.h"

namespace cleft {

namespace {

/// Lengths of the field's cut that a mesh is long: a piece of skin just longer than the cut, to a whole body.
constexpr double least_lengths = 1.2, most_lengths = 60;
constexpr double usual_lengths = 8;     // a head
constexpr double absurd_lengths = 1e5;  // kilometres

std::string rounded(double value) { return formatted("%.3g", value); }

}  // namespace

const std::vector<LengthUnit>& length_units() {
  static const std::vector<LengthUnit> all{{"mm", 1}, {"cm", 10}, {"dm", 100}, {"m", 1000}, {"in", 25.4}};
  return all;
}

double mm_of_unit(const std::string& word) {
  std::vector<std::string> names;
  for (const LengthUnit& unit : length_units()) {
    if (unit.name == word) return unit.mm;
    names.push_back(unit.name);
  }
  double mm = 0;
  try {
    mm = parse_number(word, "the unit");
  } catch (const InputError&) {
    throw InputError("the unit '" + word + "' is neither mm, cm, dm, m, in, nor a number of mm");
  }
  constexpr double least = 1e-6, most = 1e6;
  if (!(mm >= least && mm <= most))
    throw InputError("mm per unit " + shortest(mm) + ": must be from " + shortest(least) + " to " +
                     shortest(most));
  return mm;
}

std::string name_of_unit(double mm) {
  for (const LengthUnit& unit : length_units())
    if (unit.mm == mm) return unit.name;
  return shortest(mm) + " mm";
}

double extent_of(const SurfaceMesh& mesh) {
  if (mesh.points.empty()) return 0;
  Vec3 low = mesh.points.front(), high = low;
  for (const Vec3& p : mesh.points)
    for (int k = 0; k < 3; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
  const Vec3 size = high - low;
  return std::max({size.x, size.y, size.z});
}

bool is_sensible_extent(double extent, double cut_length) {
  return extent >= least_lengths * cut_length && extent <= most_lengths * cut_length;
}

double guessed_unit(double extent, double cut_length) {
  if (is_sensible_extent(extent, cut_length)) return 1;
  const auto off = [&](const LengthUnit& unit) {
    return std::abs(std::log(extent * unit.mm / (usual_lengths * cut_length)));
  };
  const auto metric = length_units().end() - 1;  // an inch must be said
  return std::min_element(length_units().begin(), metric,
                          [&](const LengthUnit& a, const LengthUnit& b) { return off(a) < off(b); })
      ->mm;
}

std::string doubt_of_size(double extent, double scale, double cut_length) {
  const double mm = extent * scale;
  if (!(mm > 0) || is_sensible_extent(mm, cut_length)) return "";
  const std::string told = "at " + shortest(scale) + " mm a unit the mesh is " + rounded(mm) +
                           " mm long, and the field's cut " + rounded(cut_length) + " mm";
  const double guess = guessed_unit(extent, cut_length);
  const std::string remedy = guess != scale && is_sensible_extent(extent * guess, cut_length)
                                 ? "; in " + name_of_unit(guess) + " it would be " + rounded(extent * guess) +
                                       " mm: give " + shortest(guess) + " mm a unit"
                                 : "; give the mm in a unit of the mesh";
  if (mm > absurd_lengths * cut_length) throw InputError(told + remedy);
  return told + remedy + " if that is not so";
}

}  // namespace cleft
