#include "explorer/wound/mutual_relief.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/stations.h"
#include "explorer/wound/membrane_relief.h"
#include "explorer/wound/room.h"
#include "params/material/isotropic.h"

namespace cleft {

namespace {

/// Parts of the cut's depth, each taken in its middle: where strains fall to nothing from the skin to the
/// bottom as a parabola does, the sum is off by less than a hundredth.
constexpr int layers = 6;
/// The force is the mean over a part of the cut's depth on either side, at two Gauss points, and never across
/// the other cut: on its lip the strain of a spline that was fitted to nodes is not determined. Along the
/// other cut the mean is exact, a difference: next to its front, derivatives of a field jump.
constexpr double reach = 0.5;
const double gauss = 1 / std::numbers::sqrt3;
/// Of the fixed point, and which part of the way a round goes. Halfway: parallel cuts close together relieve
/// each other nearly wholly, r = -1, and whole ways would swing to and fro for ever. A deviation shrinks by
/// (1 + r) / 2 a round: where r = 0.5, by 3e-8 in all.
constexpr int rounds = 60;
constexpr double way = 0.5;
/// How far a cut is taken to open at most, over what it would alone, where others add to the tension. Beyond,
/// cuts nearly meet end to end, and the strains of their fields do not add.
constexpr double most = 3;
/// The part of a path's normal that lies in the other cut's skin: with less the surface has turned away.
constexpr double turned_away = 0.1;

/// A cut opens as far as the tension next to each place lets it, which is the mean over so many depths to
/// each side, with weights that fall to 0 there, at so many places.
constexpr double mean_over = 2;
constexpr int mean_of = 201;
/// Of a cut's path, in which the relief is taken as linear: a fiftieth of it turns amplitudes by little.
constexpr int steps = 48;
/// Of the displacement across: lips shift along the cut by no more.
constexpr double most_shift = 0.5;
/// Parts of the other cut's depth from it over which leaning lips change sides where cuts cross.
constexpr double lean_fades = 1. / 3;
/// How far lips lean, for all of the tension across the cut that another takes: as simulated parallel cuts of
/// 30 mm do, 4 to 20 mm apart. And over which part of its depth that falls by e.
constexpr double leaning = 0.25, leaning_reach = 2. / 3;

/// The tension across `cut` at one of its stations: as it is given, and what another cut's field adds.
struct Influence {
  std::size_t cut, by;
  std::size_t station;
  double s;       // of the other's path
  double ratio;   // of its change to the tension
  double toward;  // 1: the other is at v > 0, -1: at v < 0; in between where they cross
  bool meet;
};

/// Skin and tissue as a field's case has them.
struct Stiffness {
  double thickness;     // of the skin
  IsotropicSheet skin;  // N/mm
  Isotropic tissue;     // MPa

  explicit Stiffness(const Field& field)
      : thickness(parameter_of(field, field.parameters->skin.thickness)),
        skin(thickness * parameter_of(field, field.parameters->skin.young_modulus),
             parameter_of(field, field.parameters->skin.poisson_ratio)),
        tissue(parameter_of(field, field.parameters->tissue.young_modulus),
               parameter_of(field, field.parameters->tissue.poisson_ratio)) {}
};

/// What another cut's field changes of the force across a line with normal `n`, N for each mm of it: in the
/// skin (plane stress), and in the tissue as deep as the cut (the tissue has no prestress, but it presses on
/// the walls where the skin draws it together).
double change_across(const Wound& other, const Stiffness& is, const ActiveVertex& at, const Vec3& n,
                     double blade) {
  const CanonicalCut& cut = other.field.shape().cut();
  const double t = std::clamp(blade + at.time_offset, 0., cut.length);
  double a = dot(n, at.along), b = dot(n, normalized(at.across));
  const double length = std::hypot(a, b);
  if (length < turned_away) return 0;
  a /= length, b /= length;
  const auto strains = [&](double v, double w) {
    Derivatives d = other.field.derivatives({at.uvw.x, v, w}, at.side, t, at.s);
    const double from = at.uvw.x - reach * cut.depth, to = at.uvw.x + reach * cut.depth;
    d.by_u = 1 / (to - from) *
             (other.field.displacement({to, v, w}, at.side, t, at.s) -
              other.field.displacement({from, v, w}, at.side, t, at.s));
    const double uu = at.weight * d.by_u.x, vv = at.weight * d.by_v.y,
                 uv = at.weight * (d.by_u.y + d.by_v.x) / 2, ww = at.weight * d.by_w.z;
    return std::array{uu * a * a + 2 * uv * a * b + vv * b * b, uu + vv,
                      ww};  // across the line, in plane, upright
  };
  const double beside = std::max(std::abs(at.uvw.y), reach * cut.depth);
  double force = 0;
  for (const double distance : {beside - gauss * reach * cut.depth, beside + gauss * reach * cut.depth}) {
    const double v = std::copysign(distance, at.side == Side::left    ? -1.
                                             : at.side == Side::right ? 1.
                                                                      : at.uvw.y);
    const auto [across, in_plane, upright] = strains(v, 0);
    force += is.skin.normal_stress(across, in_plane) / 2;
    for (int i = 0; i < layers; ++i) {
      const auto [nn, plane, up] = strains(v, -cut.depth * (i + 0.5) / layers);
      force += cut.depth / layers * is.tissue.normal_stress(nn, plane + up) / 2;
    }
  }
  return force;
}

/// Where along the cut a place is: -1 at the start, 1 at the end, 0 in what is longer than the canonical cut.
/// A path that is found as the blade moves is as long as that.
double way_from_middle(double s, const Wound& wound) {
  const CanonicalCut& cut = wound.field.shape().cut();
  const double length = wound.complete(), half = std::min(length, cut.length) / 2;
  if (wound.incision->extended_to() > 0) {
    const double known = wound.incision->path().length() * wound.scale();
    return std::clamp((canonical_place(s, known, cut).u - cut.start) / (cut.length / 2) - 1, -1., 1.);
  }
  return s < length / 2 ? std::clamp(s / half - 1, -1., 0.) : std::clamp(1 - (length - s) / half, 0., 1.);
}

/// The means of an amplitude, over `width` mm to each side as far as the path goes.
std::vector<double> means_of(const Amplitude& amplitude, double width) {
  std::vector<double> means;
  for (const double s : amplitude.stations) {
    double sum = 0, weights = 0;
    for (int k = 0; k < mean_of; ++k) {
      const double part = (2 * k + 1.) / mean_of - 1, there = s + part * width, weight = 1 - std::abs(part);
      if (there < amplitude.stations.front() || there > amplitude.stations.back()) continue;
      sum += weight * amplitude.at(there), weights += weight;
    }
    means.push_back(sum / weights);
  }
  return means;
}

}  // namespace

Amplitude::At Amplitude::operator()(double s) const {
  const auto [before, after, part] = between(stations, s);
  const auto in = [&, &a = before, &b = after, &of_b = part](const std::vector<double>& list) {
    return list.empty() ? 0 : a == b ? list[a] : (1 - of_b) * list[a] + of_b * list[b];
  };
  return {in(values), in(leans), in(shifts)};
}

BesideCut::BesideCut(const ActiveVertex& vertex, const Wound& wound)
    : s(vertex.s), along(vertex.along), outward(vertex.outward) {
  const CanonicalCut& cut = wound.field.shape().cut();
  across = std::exp(-std::abs(vertex.uvw.y) / (leaning_reach * cut.depth)) * vertex.across;
}

Relief::At Relief::at(double part) const {
  At result;
  if (steps_ == 0) return result;
  const double at = part * static_cast<double>(steps_ - 1);
  const auto step = steps_ == 1 ? 0 : std::min(static_cast<std::size_t>(at), steps_ - 2);
  result.cuts_ = cuts();
  result.before_ = &amplitudes_[step * result.cuts_];
  result.after_ = steps_ == 1 ? result.before_ : result.before_ + result.cuts_;
  result.beyond_ = at - static_cast<double>(step);
  return result;
}

namespace {

Meetings all_meet(std::size_t cuts) { return Meetings(cuts, std::vector<Meeting>(cuts, Meeting::close)); }

/// The amplitudes by the strains of the fields, at any place of the last cut's blade: what complete cuts do
/// to each other is found once.
class ByStrains {
 public:
  ByStrains(const std::vector<const Wound*>& cuts, const Meetings& meets)
      : cuts_(cuts), closed_(cuts.size()) {
    for (std::size_t i = 0; i < cuts.size(); ++i) {
      const Wound& cut = *cuts[i];
      Amplitude& own = closed_[i];
      for (const Incision::ChainVertex& c : cut.incision->chain()) {
        const double s = c.s * cut.scale();
        if (!own.stations.empty() && s <= own.stations.back()) continue;
        own.stations.push_back(s);
        const Vec3 normal = cut.volume.skin_frame(c.s).across;
        for (std::size_t j = 0; j < cuts.size(); ++j) {
          if (j == i) continue;
          const std::optional<ActiveVertex> at = cuts[j]->volume.locate(c.left);
          if (!at) continue;
          const double tension = cut.field.prestress(&Prestress::vv, s);
          if (!(tension > 0)) continue;
          const double lean_over = lean_fades * cuts[j]->field.shape().cut().depth;
          const double toward = -std::clamp(at->uvw.y / lean_over, -1., 1.) * dot(at->across, normal);
          places_.push_back({{i, j, own.stations.size() - 1, at->s, 0, toward, meets[i][j] == Meeting::close},
                             *at,
                             normal,
                             tension});
          if (j + 1 < cuts.size())
            places_.back().influence.ratio = ratio(places_.back(), cuts[j]->complete());
        }
      }
      own.values.assign(own.stations.size(), 1);
      own.leans = own.shifts = std::vector<double>(own.stations.size(), 0);
    }
  }

  /// `of_membrane`: of cuts that are apart, where there are some.
  std::vector<Amplitude> with_blade_at(double blade, const std::vector<Amplitude>& of_membrane) const {
    std::vector<Influence> influences;
    for (const Place& place : places_) {
      influences.push_back(place.influence);
      if (place.influence.by + 1 == cuts_.size()) influences.back().ratio = ratio(place, blade);
    }
    std::vector<Amplitude> result = closed_;
    for (int round = 0; round < rounds; ++round) {
      std::vector<std::vector<double>> next;
      next.reserve(result.size());
      for (const Amplitude& amplitude : result) next.emplace_back(amplitude.values.size(), 1);
      for (const Influence& x : influences)
        if (x.meet) next[x.cut][x.station] += x.ratio * result[x.by].at(x.s);
      for (std::size_t i = 0; i < result.size(); ++i)
        for (std::size_t k = 0; k < next[i].size(); ++k)
          result[i].values[k] += way * (std::clamp(next[i][k], 0., most) - result[i].values[k]);
    }
    for (std::size_t i = 0; i < result.size(); ++i) {
      result[i].values = means_of(result[i], mean_over * cuts_[i]->field.shape().cut().depth);
      if (of_membrane.empty() || of_membrane[i].values.empty()) continue;
      for (std::size_t k = 0; k < result[i].stations.size(); ++k) {
        const Amplitude::At there = of_membrane[i](result[i].stations[k]);
        result[i].values[k] *= std::min(most, there.value);
        result[i].shifts[k] = std::clamp(there.shift, -most_shift, most_shift);
      }
    }
    for (const Influence& x : influences) {
      const double lean = leaning * std::min(0., x.ratio * result[x.by].at(x.s)) * x.toward;
      result[x.cut].leans[x.station] += lean;
      if (x.meet)
        result[x.cut].shifts[x.station] -=
            lean * way_from_middle(result[x.cut].stations[x.station], *cuts_[x.cut]);
    }
    return result;
  }

 private:
  struct Place {
    Influence influence;  // its ratio: of complete cuts
    ActiveVertex at;      // in the volume of the other cut
    Vec3 normal;          // across the own path
    double tension;       // MPa, across it
  };
  /// What the other cut changes of the tension, with its blade at some place, over the tension.
  double ratio(const Place& place, double blade) const {
    const Wound& other = *cuts_[place.influence.by];
    const Stiffness stiffness(other.field.shape());
    return change_across(other, stiffness, place.at, place.normal, blade) /
           (stiffness.thickness * place.tension);
  }

  const std::vector<const Wound*>& cuts_;
  std::vector<Amplitude> closed_;  // stations, with 1 at all of them
  std::vector<Place> places_;
};

}  // namespace

std::vector<std::vector<Amplitude>> mutual_relief(const std::vector<const Wound*>& cuts,
                                                  const std::vector<double>& blades) {
  const Meetings meets = meetings(cuts);
  const std::vector<std::vector<Amplitude>> of_membrane = membrane_relief(cuts, meets, blades);
  const ByStrains by_strains(cuts, of_membrane.empty() ? all_meet(cuts.size()) : meets);
  std::vector<std::vector<Amplitude>> result;
  for (std::size_t i = 0; i < blades.size(); ++i)
    result.push_back(
        by_strains.with_blade_at(blades[i], of_membrane.empty() ? std::vector<Amplitude>() : of_membrane[i]));
  return result;
}

std::vector<Amplitude> relief_of_meeting_cuts(const std::vector<const Wound*>& cuts, double blade) {
  return ByStrains(cuts, all_meet(cuts.size())).with_blade_at(blade, {});
}

Relief relief_while_cut(const std::vector<const Wound*>& cuts, double length) {
  std::vector<double> blades;
  for (int i = 0; i <= steps; ++i) blades.push_back(length * i / steps);
  return Relief(mutual_relief(cuts, blades));
}

}  // namespace cleft
