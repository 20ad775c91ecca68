#include "explorer/wound/prestress_fields.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/error.h"
#include "base/stations.h"
#include "base/text.h"
#include "explorer/wound/path_opening.h"

namespace cleft {

namespace {

/// The part of a prestress that is no sum of the others, at least: less would make weights of a thousand, and
/// errors of the fields as much larger.
constexpr double independent_part = 1e-3;
/// In how many equal pieces of the path its prestress is sampled.
constexpr int pieces = 128;

/// The first parameter but prestresses in which two cases differ; "" where there is none.
std::string difference(const PublishedStudy& study, int i, int j) {
  RecordedParameters a = study.parameters(i);
  const RecordedParameters& b = study.parameters(j);
  const Prestress& sigma = a->skin.prestress;
  for (const double* component : {&sigma.uu, &sigma.vv, &sigma.uv}) a.erase(a.name_of(*component));
  for (const auto& [name, value] : a.numbers())
    if (b.number(name) != value) return name;
  for (const auto& [name, value] : a.texts())
    if (b.find(name) != Value(value)) return name;
  return "";
}

PublishedStudy all_alike(PublishedStudy study) {
  for (int i = 1; i < study.size(); ++i)
    if (const std::string name = difference(study, 0, i); !name.empty())
      throw InputError(study.path() + ": cases " + study.name(0) + " and " + study.name(i) + " differ in " +
                       name + "; fields superpose where cases differ in skin.prestress_u, _v and _uv alone");
  return study;
}

}  // namespace

Prestress PathPrestress::at(double s) const {
  const auto [a, b, part] = between(stations, s);
  const Prestress &x = values[a], &y = values[b];
  return {std::lerp(x.uu, y.uu, part), std::lerp(x.vv, y.vv, part), std::lerp(x.uv, y.uv, part)};
}

std::optional<SkinTension> skin_tension(const std::vector<double>& direction,
                                        const std::vector<double>& prestresses) {
  if (direction.empty()) return std::nullopt;
  const auto [smaller, larger] = std::minmax(prestresses[0], prestresses[1]);
  return SkinTension{{direction[0], direction[1], direction[2]}, larger, smaller};
}

std::vector<TensionLine> lines_of(const SkinTension& tension) {
  if (tension.lines && !tension.lines->empty()) return *tension.lines;
  return {{{}, tension.direction}};
}

Prestress prestress_of(const RecordedParameters& p) {
  const Prestress& sigma = p->skin.prestress;
  return {p.value_or(sigma.uu, 0.), p.value_or(sigma.vv, 0.), p.value_or(sigma.uv, 0.)};
}

Prestress prestress_in(const std::array<Vec3, 2>& directions, const SkinTension& tension, double s,
                       const Vec3& place) {
  const double mean = (tension.larger + tension.smaller) / 2, half = (tension.larger - tension.smaller) / 2;
  const double along = dot(tension.direction, directions[0]), across = dot(tension.direction, directions[1]);
  const bool painted = tension.lines && !tension.lines->empty();
  const std::optional<double> of_lines =
      painted ? twice_angle_of(*tension.lines, directions, place) : std::nullopt;
  if (painted ? !of_lines : std::hypot(along, across) < upright_line * norm(tension.direction))
    throw InputError((painted ? "the lines of tension are perpendicular to the skin, or cancel each other, "
                              : "the tension stands upright on the skin ") +
                     shortest(s) + " mm along the path; give its direction in the skin there");
  const double twice = of_lines.value_or(2 * std::atan2(across, along));
  return {mean + half * std::cos(twice), mean - half * std::cos(twice), half * std::sin(twice)};
}

PathPrestress prestress_along(const IncisionVolume& volume, double length, const SkinTension& tension) {
  PathPrestress result;
  for (int i = 0; i <= pieces; ++i) {
    const PathFrame frame = volume.skin_frame(length * i / pieces);
    result.stations.push_back(length * i / pieces * volume.scale());
    result.values.push_back(prestress_in({frame.along, frame.across}, tension, result.stations.back(),
                                         volume.scale() * frame.position));
  }
  return result;
}

PrestressFields::PrestressFields(const std::string& study_file)
    : PrestressFields(all_alike(PublishedStudy(study_file)), 0) {}

PrestressFields::PrestressFields(const PublishedStudy& study, int like) {
  const RecordedParameters& own = study.parameters(like);
  if (own->model == Model::finite)
    throw InputError(study.path() + ": fields do not superpose with " + own.name_of(own->model) +
                     " = finite; interpolate the tension's own field from a study (cleft interpolate)");
  if (!is_linear_in_prestress(*own))
    throw InputError(study.path() + ": fields do not superpose with " + own.name_of(own->cut.contact) + ", " +
                     own.name_of(own->skin.initial_stress_stiffness) + " or " +
                     own.name_of(own->skin.turning_stiffness));
  Vec3 p[3];
  for (int i = 0; i < study.size() && fields_.size() < 3; ++i) {
    if (!difference(study, like, i).empty()) continue;
    const std::size_t n = fields_.size();
    const auto [uu, vv, uv] = prestress_of(study.parameters(i));
    p[n] = {uu, vv, uv};
    const double size = norm(p[n]);
    const double independent = n == 0   ? size
                               : n == 1 ? norm(cross(p[0], p[1])) / norm(p[0])
                                        : std::abs(dot(cross(p[0], p[1]), p[2])) / norm(cross(p[0], p[1]));
    if (!(independent > independent_part * size)) continue;
    fields_.push_back(study.read(i));
  }
  if (fields_.size() < 3)
    throw InputError(study.path() +
                     ": a tension that turns needs three cases that differ in skin.prestress_u, _v and _uv "
                     "alone and whose prestresses are independent, such as (0.01, 0, 0), (0, 0.01, 0) and "
                     "(0.01, 0.01, 0.005) MPa");
  const double volume = dot(cross(p[0], p[1]), p[2]);
  for (int i = 0; i < 3; ++i) inverse_[i] = 1 / volume * cross(p[(i + 1) % 3], p[(i + 2) % 3]);
}

PathPrestress PrestressFields::as_the_path_opens(const PathPrestress& prestress, const IncisionVolume& volume,
                                                 double length) const {
  const auto membrane = membrane_of(along({{0}, {{0, 1, 0}}}));
  if (!membrane) return prestress;
  const PathPrestress added = tension_of_winding(
      *membrane, shape().cut(), volume, length, prestress, [](double) { return OwnCut{}; },
      [](double) { return 1.; });
  PathPrestress result = {prestress.stations, {}};
  result.stations.insert(result.stations.end(), added.stations.begin(), added.stations.end());
  std::sort(result.stations.begin(), result.stations.end());
  for (const double s : result.stations) {
    const Prestress own = prestress.at(s), more = added.at(s);
    result.values.push_back({own.uu, own.vv + more.vv, own.uv + more.uv});
  }
  return result;
}

VaryingField PrestressFields::along(const PathPrestress& prestress) const {
  std::vector<std::vector<double>> weights;
  for (const Prestress& at : prestress.values) {
    std::vector<double>& row = weights.emplace_back();
    for (const Vec3& inverse : inverse_) row.push_back(dot(inverse, {at.uu, at.vv, at.uv}));
  }
  return {{&fields_[0], &fields_[1], &fields_[2]}, prestress.stations, std::move(weights)};
}

}  // namespace cleft
