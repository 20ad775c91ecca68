#include "explorer/wound/family_fields.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "base/stations.h"
#include "explorer/wound/path_opening.h"
#include "explorer/wound/plane_tensor.h"
#include "explorer/wound/room.h"

namespace cleft {

namespace {

/// In depths of the cut: the skin is smoothed at the scale of what a cut moves.
constexpr double smoothing_in_depths = 8. / 3;
/// In lengths of the canonical cut, to each side. The tension that a cut releases anywhere opens it over much
/// of its length, so that a hand's tremor matters little; and what a path does within that is known from its
/// curvature and how that changes.
constexpr double smoothing_in_lengths = 0.25;
/// Of the smoothing: the distance of stations while a path is found, and how far behind the tip its curvature
/// is taken to be known: at the tip itself it is the hand's tremor.
constexpr double station_in_smoothing = 0.25, behind_tip_in_smoothing = 0.5;
/// Of the family's ranges: shapes at stations differ from straight lines between others by no more, and from
/// station to station.
constexpr double straight_enough = 0.005, near_enough = 0.1;
/// Likewise of shapes of which only how far they open is asked: the openings are linear in between.
constexpr double straight_to_open = 0.03, near_to_open = 0.25;
/// Of the path's length: its start and its end are apart by more, or it is a loop.
constexpr double least_chord = 1e-3;

/// The shape and the prestress of the case that stands for a place.
struct CaseShape {
  std::map<std::string, double> shapes;
  Prestress prestress;
};

/// The greatest part of the rate with which the case's curvature and its rate are within the diamond of their
/// ranges: beyond it there are no cases. `x` is the way from the middle of the cut.
double part_of_rate(const LocalShape& local, double x, double most_curvature, double most_rate) {
  const auto is_within = [&](double part) {
    const double rate = part * local.curvature_rate;
    return std::abs(local.curvature - rate * x) / most_curvature + std::abs(rate) / most_rate <= 1;
  };
  if (is_within(1)) return 1;
  double least = 0, most = 1;
  for (int round = 0; round < 20; ++round) {
    const double middle = (least + most) / 2;
    (is_within(middle) ? least : most) = middle;
  }
  return least;
}

/// `own` is what the family opens the place with.
CaseShape case_of(const LocalShape& local, const OwnCut& own, const Prestress& prestress,
                  double u_from_middle) {
  const double at_middle = local.curvature - local.curvature_rate * u_from_middle;
  const double angle = own.turned(u_from_middle);
  const auto skin = turned({local.skin_u, local.skin_v, local.skin_uv}, angle);
  const auto tension = turned({prestress.uu, prestress.vv, prestress.uv}, angle);
  return {{{"cut.curvature", at_middle},
           {"cut.curvature_rate", local.curvature_rate},
           {"cut.tilt", local.tilt},
           {"cut.depth", local.depth * std::cos(local.tilt * std::numbers::pi / 180)},
           {"skin.curvature_u", skin[0]},
           {"skin.curvature_v", skin[1]},
           {"skin.curvature_uv", skin[2]},
           {"patch.height", local.tissue}},
          {tension[0], tension[1], tension[2]}};
}

/// Linear between the stations of cuts, and as at the ends beyond them.
OwnCut between_cuts(const std::vector<double>& stations, const std::vector<OwnCut>& cuts, double s) {
  const auto [a, b, part] = between(stations, s);
  const OwnCut &x = cuts[a], &y = cuts[b];
  return {std::lerp(x.curvature, y.curvature, part), std::lerp(x.curvature_rate, y.curvature_rate, part),
          std::lerp(x.ahead, y.ahead, part)};
}

/// Of the place on the canonical cut of s mm of a path, mm.
double from_middle(double s, double length, const CanonicalCut& cut) {
  return canonical_place(s, length, cut).u - cut.start - cut.length / 2;
}

/// Numbers whose changes by 1 matter alike.
std::vector<double> normalised(const CaseShape& one, const Prestress& local, const Family& family,
                               double prestress) {
  std::vector<double> list;
  for (const auto& [name, range] : family.shapes()) {
    const double value = one.shapes.at(name), width = range.greatest - range.least;
    // No bone is as far from the deepest one as that from the one nearest to the skin.
    list.push_back(
        (std::isfinite(value) ? std::clamp(value, range.least, range.greatest) : range.greatest + width) /
        width);
  }
  for (const Prestress& tension : {one.prestress, local})
    for (const double component : {tension.uu, tension.vv, tension.uv}) list.push_back(component / prestress);
  return list;
}

/// Where the canonical place of a path that is longer than the canonical cut stops in its middle, and goes
/// on: the case that stands for a place is seen from others on the same side of these alone.
std::vector<double> corners_of(double length, const CanonicalCut& cut) {
  if (length <= cut.length) return {};
  return {cut.length / 2, length - cut.length / 2};
}

void add_stations(PathShape& shapes, const std::vector<double>& places) {
  for (const double s : places) {
    const auto next = std::lower_bound(shapes.stations.begin(), shapes.stations.end(), s);
    if (next == shapes.stations.begin() || next == shapes.stations.end() || *next == s) continue;
    const LocalShape there = shapes.at(s);
    shapes.values.insert(shapes.values.begin() + (next - shapes.stations.begin()), there);
    shapes.stations.insert(next, s);
  }
}

/// Places of a list, the first and the last and the corners among them, between which the others are on
/// straight lines that are not too long: fields are no linear functions of what is linear along the path.
std::vector<std::size_t> bends_of(const std::vector<double>& s, const std::vector<std::vector<double>>& x,
                                  double most_bent, double farthest,
                                  const std::vector<double>& corners = {}) {
  std::vector<std::size_t> kept{0};
  const auto straight = [&](std::size_t a, std::size_t b) {
    for (std::size_t k = 0; k < x[a].size(); ++k)
      if (std::abs(x[b][k] - x[a][k]) > farthest) return false;
    for (const double corner : corners)
      if (s[a] < corner && corner < s[b]) return false;
    for (std::size_t i = a + 1; i < b; ++i)
      for (std::size_t k = 0; k < x[i].size(); ++k) {
        const double line = std::lerp(x[a][k], x[b][k], (s[i] - s[a]) / (s[b] - s[a]));
        if (std::abs(x[i][k] - line) > most_bent) return false;
      }
    return true;
  };
  for (std::size_t i = 1; i < s.size(); ++i)
    if (i + 1 == s.size() || !straight(kept.back(), i + 1)) kept.push_back(i);
  return kept;
}

}  // namespace

SkinTension default_tension(const ScalpelPath& path, bool grows) {
  const Prestress own = Parameters{}.skin.prestress;
  const Vec3 chord = path.at(path.length()).position - path.at(0).position;
  const bool along_start = grows || norm(chord) < least_chord * path.length();
  return {along_start ? path.at(0).along : chord, own.uu, own.vv};
}

Followed FamilyFields::followed() const {
  const auto varies = [&](const char* name) { return family_->shapes().contains(name); };
  return {varies("cut.curvature"),     varies("cut.tilt"),
          varies("cut.depth"),         varies("skin.curvature_u") && varies("skin.curvature_v"),
          varies("skin.curvature_uv"), family_->knows_bone()};
}

Smoothing FamilyFields::smoothing() const {
  return {smoothing_in_lengths * shape().cut().length, smoothing_in_depths * shape().cut().depth};
}

/// The shape with what the family has cases of: in one without changing curvatures a path is the circle. And
/// with the bone below.
LocalShape FamilyFields::known_to_family(LocalShape local, const Incision& incision, double scale,
                                         double s) const {
  const auto& shapes = family_->shapes();
  if (!shapes.contains("cut.curvature_rate")) {
    local.curvature_rate = 0;
  } else {
    const double x = from_middle(s, incision.path().length() * scale, shape().cut());
    local.curvature_rate *=
        part_of_rate(local, x, shapes.at("cut.curvature").greatest, shapes.at("cut.curvature_rate").greatest);
  }
  if (tissue_ && family_->knows_bone())
    local.tissue = mean_tissue(tissue_, scale * incision.path().at(s / scale).position, local,
                               smoothing().skin, family_->whole_height());
  return local;
}

/// The family's cut that stands for a place, as far as it has such.
OwnCut FamilyFields::own_cut(const LocalShape& local, double u_from_middle) const {
  const auto range = family_->shapes().find("cut.curvature");
  if (range == family_->shapes().end()) return {};
  return {std::clamp(local.curvature - local.curvature_rate * u_from_middle, range->second.least,
                     range->second.greatest),
          local.curvature_rate};
}

/// Of the family's blade that stands for a place, degrees.
double FamilyFields::known_tilt(const LocalShape& local) const {
  const auto range = family_->shapes().find("cut.tilt");
  return range == family_->shapes().end()
             ? 0
             : std::clamp(local.tilt, range->second.least, range->second.greatest);
}

double FamilyFields::AlongPath::at(double s) const {
  const auto [a, b, part] = between(stations, s);
  return std::lerp(values[a], values[b], part);
}

/// How far the cuts that stand for places of a path would open if they were straight, when `t` mm are cut,
/// mm.
FamilyFields::AlongPath FamilyFields::ease(const PathShape& shapes, double t) const {
  std::vector<CaseShape> cases;
  std::vector<std::vector<double>> numbers;
  for (LocalShape local : shapes.values) {
    local.curvature = local.curvature_rate = 0;
    cases.push_back(case_of(local, {}, {0, 1, 0}, 0));
    numbers.push_back(normalised(cases.back(), {}, *family_, 1));
  }
  AlongPath result;
  for (const std::size_t i : bends_of(shapes.stations, numbers, straight_to_open, near_to_open)) {
    const auto field = family_->at(cases[i].shapes, cases[i].prestress).field;
    result.stations.push_back(shapes.stations[i]);
    result.values.push_back(middle_opening(*field, t));
  }
  return result;
}

VaryingField FamilyFields::along(const Incision& incision, const IncisionVolume& volume,
                                 const PathPrestress& prestress, double known) const {
  const double scale = volume.scale();
  const CanonicalCut& cut = shape().cut();
  const double length = incision.path().length() * scale;
  PathShape shapes = shape_along(incision, scale, smoothing());
  const std::vector<double> corners = corners_of(length, cut);
  add_stations(shapes, corners);
  for (std::size_t i = 0; i < shapes.stations.size(); ++i)
    shapes.values[i] = known_to_family(shapes.values[i], incision, scale, shapes.stations[i]);
  while (shapes.stations.size() > 1 && shapes.stations.back() > known)
    shapes.stations.pop_back(), shapes.values.pop_back();
  double largest = 0;
  for (const Prestress& one : prestress.values)
    largest = std::max({largest, std::abs(one.uu), std::abs(one.vv), std::abs(one.uv)});
  std::vector<OwnCut> own;
  for (std::size_t i = 0; i < shapes.stations.size(); ++i) {
    const double s = shapes.stations[i];
    const PathFrame frame = volume.skin_frame(s / scale);
    const Vec3& along = shapes.values[i].along;
    own.push_back(own_cut(shapes.values[i], from_middle(s, length, cut)));
    own.back().ahead = std::atan2(dot(cross(frame.along, along), frame.outward), dot(frame.along, along));
  }
  const auto membrane = length <= known ? membrane_of(family_->middle()) : std::nullopt;
  const PathPrestress added =
      membrane ? tension_of_winding(
                     *membrane, cut, volume, length, prestress,
                     [&](double s) { return between_cuts(shapes.stations, own, s); },
                     [ease = ease(shapes, std::min(length, cut.length))](double s) { return ease.at(s); })
               : PathPrestress{{0}, {{}}};
  std::vector<CaseShape> cases;
  std::vector<Prestress> local;
  std::vector<std::vector<double>> numbers;
  for (std::size_t i = 0; i < shapes.stations.size(); ++i) {
    const double s = shapes.stations[i];
    const Vec3& along = shapes.values[i].along;
    const Prestress of_path = prestress.at(s), more = added.at(s);
    const auto [uu, vv, uv] = turned({of_path.uu, of_path.vv, of_path.uv}, -own[i].ahead);
    local.push_back({uu, vv, uv});
    cases.push_back(case_of(shapes.values[i], own[i], {uu + more.uu, vv + more.vv, uv + more.uv},
                            from_middle(s, length, cut)));
    numbers.push_back(normalised(cases.back(), local.back(), *family_, largest > 0 ? largest : 1));
    for (int c = 0; c < 3; ++c) numbers.back().push_back(along[c]);
  }
  std::vector<StationField> stations;
  for (const std::size_t i : bends_of(shapes.stations, numbers, straight_enough, near_enough, corners)) {
    const double s = shapes.stations[i];
    const auto [field, outside] = family_->at(cases[i].shapes, cases[i].prestress);
    stations.push_back({s, field, local[i], shapes.values[i].along, outside, known_tilt(shapes.values[i])});
  }
  return {family_->shared_middle(), std::move(stations)};
}

std::optional<double> FamilyFields::next_station(const Incision& incision, double scale,
                                                 const VaryingField& field) const {
  const double known = incision.extended_to() * scale - behind_tip_in_smoothing * smoothing().skin;
  if (known >= field.known_to() + station_in_smoothing * smoothing().skin) return known;
  return std::nullopt;
}

void FamilyFields::extend(VaryingField& field, const Incision& incision, double scale, double s,
                          const SkinTension& tension) const {
  const double length = incision.path().length() * scale;
  const LocalShape local = known_to_family(local_shape(incision, scale, s, smoothing()), incision, scale, s);
  const Prestress prestress = prestress_in({local.along, cross(local.outward, local.along)}, tension, s,
                                           scale * incision.path().at(s / scale).position);
  const double x = from_middle(s, length, shape().cut());
  const CaseShape one = case_of(local, own_cut(local, x), prestress, x);
  const auto [there, outside] = family_->at(one.shapes, one.prestress);
  field.extend({s, there, prestress, local.along, outside, known_tilt(local)});
}

}  // namespace cleft
