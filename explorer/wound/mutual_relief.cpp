#include "explorer/wound/mutual_relief.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "base/stations.h"
#include "explorer/wound/corner_lean.h"
#include "explorer/wound/membrane_relief.h"
#include "explorer/wound/room.h"

namespace cleft {

namespace {

/// How far a cut is taken to open at most, over what it would alone, where others add to the tension. Beyond,
/// cuts nearly meet end to end.
constexpr double most = 3;
/// Of a cut's path, in which the relief is taken as linear: a fiftieth of it turns amplitudes by little.
/// Steps also end where the cut meets others: corners of a crossing part when the blade has passed it, and
/// not before. As parts of the path, steps that are closer than that are one.
constexpr int steps = 48;
constexpr double least_step = 1e-9;

/// How far lips lean in all, over how far the other cut shears the tissue above the bottom: of simulated
/// parallel cuts 10 to 60 mm long, 3 and 5 mm deep and 4 to 20 mm apart, in tissue of 0.008 to 0.05 MPa.
constexpr double leaning = 1.2;
/// Next to a shallow cut lips lean more, by so many times what the skin's thickness over the cut's depth is
/// above the least one. That counts in full up to so many depths from the cut, and falls to nothing at so
/// many. Of simulated parallel cuts 4 mm apart, and cuts that cross, 2, 3 and 5 mm deep.
constexpr double more_leaning = 0.95, least_thickness = 0.3, leans_more_to = 4. / 3,
                 leans_as_others_from = 2.5;
/// Depths of the cut: what lips lean falls to nothing over so much before an end, and by e so far from them.
constexpr double leans_fully = 0.6, leaning_reach = 2. / 3;
/// The shear is summed over parts of the cut's depth, each taken in its middle, and is the mean at two Gauss
/// points of a part of the depth to either side. Nearer to the other cut than its depth it is as so far from
/// it: next to a wall the tissue is free of shear, but the strip between the walls sinks as a whole. Along
/// the other cut it is a difference over that part: next to its front, derivatives of a field jump.
constexpr int layers = 6;
constexpr double reach = 0.5;
const double gauss = 1 / std::numbers::sqrt3;
/// Parts of the other cut's depth from it over which leaning lips change sides where cuts cross. Of that, so
/// far from the crossing along a cut its corners are, and ends what keeps them from parting.
constexpr double lean_fades = 0.1, corner_part = 0.5, parts_within = 2;
/// Depths to either side of where another cut opens into this one, over which what its field does not move of
/// the lips is linear: the lip beyond is whole there.
constexpr double mouth_reach = 0.5;
/// The part of a path's normal that lies in the other cut's skin: with less the surface has turned away.
constexpr double turned_away = 0.1;

/// By how much further than the bottom of a cut there another cut's field moves the skin along `n`, mm: as
/// the shear of the tissue tells it, with which the sides of the cut turn up and down.
double shear_across(const Wound& other, const ActiveVertex& at, const Vec3& n, double blade) {
  const CanonicalCut& cut = other.field.shape().cut();
  const double t = at.time_at(blade, cut.length);
  double a = dot(n, at.along), b = dot(n, normalized(at.across));
  const double length = std::hypot(a, b);
  if (length < turned_away) return 0;
  a /= length, b /= length;
  const auto shear = [&](double v, double w) {
    const Derivatives d = other.field.derivatives({at.uvw.x, v, w}, at.side, t, at.s);
    const double from = at.uvw.x - reach * cut.depth, to = at.uvw.x + reach * cut.depth;
    const double rises = (other.field.displacement({to, v, w}, at.side, t, at.s).z -
                          other.field.displacement({from, v, w}, at.side, t, at.s).z) /
                         (to - from);
    return at.weight * (a * (d.by_w.x + rises) + b * (d.by_w.y + d.by_v.z));
  };
  const double beside = std::max(std::abs(at.uvw.y), cut.depth);
  double sum = 0;
  for (const double distance : {beside - gauss * reach * cut.depth, beside + gauss * reach * cut.depth}) {
    const double v = std::copysign(distance, at.side == Side::left    ? -1.
                                             : at.side == Side::right ? 1.
                                                                      : at.uvw.y);
    for (int i = 0; i < layers; ++i)
      sum += cut.depth / layers * shear(v, -cut.depth * (i + 0.5) / layers) / 2;
  }
  return sum * std::min(1., std::abs(at.uvw.y) / (lean_fades * cut.depth));
}

/// How far a complete cut alone opens across, mm.
double opening_at(double s, const Wound& wound) {
  const double length = wound.complete();
  const auto [u, time_offset] = wound.volume.canonical(s, length);
  const double t =
      std::clamp(wound.volume.opened_to()(length) + time_offset, 0., wound.field.shape().cut().length);
  return wound.field.displacement({u, 0, 0}, Side::right, t, s).y -
         wound.field.displacement({u, 0, 0}, Side::left, t, s).y;
}

/// What lips lean for each mm of shear, over that. What leans is held by what is next to it, and so falls
/// toward the ends of a cut over its depth alone.
double leaning_at(double s, const Wound& wound, double opening) {
  const CanonicalCut& cut = wound.field.shape().cut();
  if (!(opening > 0)) return 0;
  double from_end = std::numeric_limits<double>::infinity();
  if (!wound.volume.mouth(false)) from_end = s;
  if (!wound.volume.mouth(true)) from_end = std::min(from_end, wound.complete() - s);
  return leaning / opening * std::sqrt(std::clamp(from_end / (leans_fully * cut.depth), 0., 1.));
}

/// How many times as far lips lean at a place beside another cut as further away from it.
double more_beside(const Wound& other, const ActiveVertex& at) {
  const double depth = other.depth(at.s), depths = std::abs(at.uvw.y) / depth;
  const double more = std::max(0., more_leaning * (other.skin_thickness() / depth - least_thickness));
  return 1 +
         more * std::clamp((leans_as_others_from - depths) / (leans_as_others_from - leans_more_to), 0., 1.);
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

std::vector<Crossing> crossings_of(const std::vector<const Wound*>& cuts) {
  std::vector<Crossing> found;
  for (std::size_t i = 0; i < cuts.size(); ++i)
    for (std::size_t j = 0; j < cuts.size(); ++j) {
      if (i == j) continue;
      const Wound &cut = *cuts[i], &other = *cuts[j];
      const double depth = other.field.shape().cut().depth;
      for (const double s : touched_at(cut, other)) {
        const Vec3 place = cut.scale() / other.scale() * cut.incision->path().at(s / cut.scale()).position;
        const double other_s = other.scale() * other.incision->path().coordinates(place).s;
        const double sine = dot(cut.volume.skin_frame(s / cut.scale()).along,
                                other.volume.skin_frame(other_s / other.scale()).across);
        if (std::abs(sine) < turned_away) continue;
        const double fades = lean_fades * depth / std::abs(sine);
        const auto inside = [fades](double at, double length) { return fades < at && at < length - fades; };
        if (inside(s, cut.complete()) && inside(other_s, other.complete()))
          found.push_back({i, j, s, other_s, fades, sine > 0 ? 1. : -1.});
      }
    }
  return found;
}

void BesideCut::keep_with_own_piece(const ActiveVertex& vertex, std::size_t cut,
                                    const std::vector<const Wound*>& cuts,
                                    std::span<const Crossing> crossings) {
  for (const Crossing& crossing : crossings) {
    if (crossing.cut != cut) continue;
    const double from = vertex.s - crossing.s, away = std::hypot(from, vertex.uvw.y) / crossing.fades;
    if (away >= 1) continue;
    const std::optional<ActiveVertex> in_other = cuts[crossing.other]->volume.locate(vertex.vertex);
    if (!in_other) continue;
    const double side = in_other->side == Side::left    ? -1
                        : in_other->side == Side::right ? 1
                        : in_other->uvw.y < 0           ? -1
                                                        : 1;
    // Both cuts part the corners: half of how far these are apart is due to each. Along a lip the part of the
    // other cut falls as that of its own grows.
    s += (1 - away) * corner_part * crossing.toward * side * crossing.fades;
  }
}

Relief::At Relief::at(double part) const {
  At result;
  if (parts_.empty()) return result;
  const auto [before, after, beyond] = between(parts_, part);
  result.cuts_ = cuts();
  result.before_ = &amplitudes_[before * result.cuts_];
  result.after_ = &amplitudes_[after * result.cuts_];
  result.beyond_ = beyond;
  return result;
}

namespace {

/// How lips lean and, between stations of its chain, what a cut takes from its amplitudes in the membrane, at
/// any place of the last cut's blade: what complete cuts do to each other is found once.
class AtStations {
 public:
  explicit AtStations(const std::vector<const Wound*>& cuts)
      : cuts_(cuts), crossings_(crossings_of(cuts)), alone_(cuts.size()) {
    for (std::size_t i = 0; i < cuts.size(); ++i) {
      const Wound& cut = *cuts[i];
      Amplitude& own = alone_[i];
      for (const auto& [s, lips] : stations_of(i)) {
        if (!own.stations.empty() && s <= own.stations.back()) continue;
        const std::size_t station = own.stations.size();
        const double opening = opening_at(s, cut);
        own.stations.push_back(s);
        if (!lips) {
          between_.emplace_back(i, station);
          continue;
        }
        const double leans = leaning_at(s, cut, opening);
        const Vec3 normal = cut.volume.skin_frame(s / cut.scale()).across;
        for (std::size_t j = 0; j < cuts.size(); ++j) {
          if (j == i) continue;
          const auto add = [&](const std::optional<ActiveVertex>& at, double part) {
            if (!at || part == 0) return;
            const bool complete = j + 1 < cuts.size();
            places_.push_back({i, j, station, at->s, part * leans * more_beside(*cuts[j], *at),
                               complete ? shear_across(*cuts[j], *at, normal, cuts[j]->complete()) : 0, *at,
                               normal});
          };
          const std::optional<ActiveVertex> left = cuts[j]->volume.locate(lips->first);
          const IncisionVolume::Mouth* mouth = mouth_between(*cuts[j], cut);
          if (!mouth) {
            add(left, 1);
            continue;
          }
          const std::optional<ActiveVertex> right = cuts[j]->volume.locate(lips->second);
          if (left && right && opening > 0)
            parted_.push_back({i, j, station, left->s, opening, *left, *right});
          const double beside = beside_branch(cut, s, *cuts[j]);
          add(mouth->right ? right : left, beside);
          add(mouth->right ? left : right, 1 - beside);
        }
      }
      for (std::size_t j = 0; j < cuts.size(); ++j)
        for (const bool at_end : {false, true}) {
          const std::optional<double> mouth = cut.mouth_of(*cuts[j], at_end);
          if (!mouth) continue;
          const double beside = beside_mouth(cut, *mouth);
          const auto first = std::ranges::lower_bound(own.stations, *mouth - beside),
                     last = std::ranges::upper_bound(own.stations, *mouth + beside);
          if (first != own.stations.begin() && last != own.stations.end())
            mouths_.push_back({i, j, at_end, *mouth,
                               static_cast<std::size_t>(first - own.stations.begin()) - 1,
                               static_cast<std::size_t>(last - own.stations.begin())});
        }
      own.values.assign(own.stations.size(), 1);
      own.leans = own.shifts = std::vector<double>(own.stations.size(), 0);
    }
  }

  std::vector<Amplitude> with_blade_at(double blade, const std::vector<Amplitude>& in_membrane) const {
    std::vector<Amplitude> result = alone_;
    lean_by_shear(blade, in_membrane, result);
    std::vector<Amplitude> by_branches = moved_by_branches(blade, in_membrane);
    fill_between(result, by_branches);
    std::vector<double> parted;
    for (const Crossing& crossing : crossings_) {
      const CornerLean corners = lean_at_crossing(crossing, cuts_, blade, in_membrane);
      lean_by_corners(crossing, corners, result[crossing.cut]);
      parted.push_back(corners.share);
    }
    for (const Mouth& mouth : mouths_)
      lean_beside(mouth, lean_at_mouth(mouth.cut, mouth.s, mouth.by, mouth.at_end, cuts_, blade, in_membrane),
                  result[mouth.cut]);
    for (std::size_t i = 0; i < result.size(); ++i)
      for (std::size_t k = 0; k < result[i].stations.size(); ++k) {
        const Amplitude& other = by_branches[i];
        const Amplitude::At there = in_membrane[i](result[i].stations[k]);
        result[i].leans[k] = std::clamp(result[i].leans[k] - other.leans[k], -most_lean, most_lean);
        result[i].values[k] = std::min(most, std::max(0., there.value - other.values[k]));
        result[i].shifts[k] = std::clamp(there.shift - other.shifts[k], -most_shift, most_shift);
      }
    for (const Mouth& mouth : mouths_) join_over_mouth(mouth, result[mouth.cut]);
    for (std::size_t i = 0; i < crossings_.size(); ++i)
      part_corners(crossings_[i], parted[i], result[crossings_[i].cut]);
    return result;
  }

 private:
  /// A station of a cut in the volume of another one.
  struct Place {
    std::size_t cut, by, station;
    double s;        // mm, along the other's path
    double leaning;  // for each mm of shear
    double shear;    // mm, of the other one where it is complete
    ActiveVertex at;
    Vec3 normal;  // across the own path
  };

  /// Lips of a cut in the volume of another one that opens into it, and moves them differently.
  struct Parted {
    std::size_t cut, by, station;
    double s;        // mm, along the other's path
    double opening;  // mm, of the cut alone
    ActiveVertex left, right;
  };

  /// Stations of a cut, between which another one opens into it.
  struct Mouth {
    std::size_t cut, by;
    bool at_end;  // of the other one
    double s;     // mm
    std::size_t first, last;
  };

  /// Null unless the later cut begins or ends in the other one.
  static const IncisionVolume::Mouth* mouth_between(const Wound& later, const Wound& cut) {
    for (const bool at_end : {false, true})
      if (const auto& mouth = later.volume.mouth(at_end); mouth && mouth->earlier == cut.incision)
        return &*mouth;
    return nullptr;
  }

  /// mm of a cut to either side of where another one opens into it.
  static double beside_mouth(const Wound& cut, double s) {
    return std::min({mouth_reach * cut.field.shape().cut().depth, s / 2, (cut.complete() - s) / 2});
  }

  using Lips = std::pair<int, int>;
  /// The lips of a cut's chain, and places without: where lips change the side to which they lean, and where
  /// another cut opens into it.
  std::vector<std::pair<double, std::optional<Lips>>> stations_of(std::size_t cut) const {
    std::vector<std::pair<double, std::optional<Lips>>> result;
    std::vector<double> mouths;
    for (const Wound* later : cuts_)
      for (const bool at_end : {false, true})
        if (const auto at = cuts_[cut]->mouth_of(*later, at_end)) mouths.push_back(*at);
    for (const Incision::ChainVertex& c : cuts_[cut]->incision->chain()) {
      const double s = c.s * cuts_[cut]->scale();
      const bool at_mouth = std::ranges::any_of(
          mouths, [&](double mouth) { return std::abs(s - mouth) < beside_mouth(*cuts_[cut], mouth); });
      result.emplace_back(s, at_mouth ? std::nullopt : std::optional<Lips>({c.left, c.right}));
    }
    // Its ends have lips.
    for (const std::size_t end : {std::size_t{0}, result.empty() ? 0 : result.size() - 1})
      if (end < result.size()) {
        const Incision::ChainVertex& c = cuts_[cut]->incision->chain()[end];
        result[end].second = Lips{c.left, c.right};
      }
    const double first = result.empty() ? 0 : result.front().first,
                 last = result.empty() ? 0 : result.back().first;
    for (const Crossing& crossing : crossings_)
      if (crossing.cut == cut)
        for (const double fades : {-parts_within, -1., 0., 1., parts_within})
          if (const double s = crossing.s + fades * crossing.fades; first < s && s < last)
            result.emplace_back(s, std::nullopt);
    std::stable_sort(result.begin(), result.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    return result;
  }

  /// The first station behind one without lips that has some.
  std::size_t next_vertex(std::size_t cut, std::size_t station) const {
    do ++station;
    while (std::ranges::binary_search(between_, std::pair(cut, station)));
    return station;
  }

  void lean_by_shear(double blade, const std::vector<Amplitude>& in_membrane,
                     std::vector<Amplitude>& result) const {
    for (const Place& place : places_) {
      const double shear = place.by + 1 < cuts_.size()
                               ? place.shear
                               : shear_across(*cuts_[place.by], place.at, place.normal, blade);
      double& lean = result[place.cut].leans[place.station];
      lean += place.leaning * shear * std::min(most, in_membrane[place.by].at(place.s));
      lean = std::clamp(lean, -most_lean, most_lean);
    }
  }

  /// How far those that open into a cut part its lips themselves, as parts of its own displacement across.
  std::vector<Amplitude> moved_by_branches(double blade, const std::vector<Amplitude>& in_membrane) const {
    std::vector<Amplitude> result = alone_;
    for (Amplitude& one : result) std::ranges::fill(one.values, 0);
    for (const Parted& lips : parted_) {
      const double at = lips.by + 1 < cuts_.size() ? cuts_[lips.by]->complete() : blade;
      const auto moved = [&](const ActiveVertex& lip) {
        const VaryingField& field = cuts_[lips.by]->field;
        const double t = lip.time_at(at, field.shape().cut().length);
        return lip.in_mesh(field.displacement(lip.uvw, lip.side_at(at), t, lip.s));
      };
      const Wound& cut = *cuts_[lips.cut];
      const PathFrame frame = cut.volume.skin_frame(alone_[lips.cut].stations[lips.station] / cut.scale());
      const Vec3 apart =
          in_membrane[lips.by].at(lips.s) / lips.opening * (moved(lips.right) - moved(lips.left));
      result[lips.cut].values[lips.station] += dot(apart, frame.across);
      result[lips.cut].shifts[lips.station] += dot(apart, frame.along);
      result[lips.cut].leans[lips.station] += dot(apart, frame.outward);
    }
    return result;
  }

  /// Linear at stations without lips.
  void fill_between(std::vector<Amplitude>& result, std::vector<Amplitude>& by_branches) const {
    for (const auto& [cut, station] : between_) {
      const std::vector<double>& s = result[cut].stations;
      const std::size_t next = next_vertex(cut, station);
      const double part = (s[station] - s[station - 1]) / (s[next] - s[station - 1]);
      for (std::vector<double>* list :
           {&result[cut].leans, &by_branches[cut].values, &by_branches[cut].shifts, &by_branches[cut].leans})
        (*list)[station] = std::lerp((*list)[station - 1], (*list)[next], part);
    }
  }

  /// What leans by `lean`, so far `from` corners along the cut, mm, with them.
  static double leaning_as(const CornerLean& corners, double from, double lean) {
    return std::lerp(lean, from < 0 ? corners.before : corners.after, corners.at(std::abs(from)));
  }

  static void lean_beside(const Mouth& mouth, const CornerLean& corners, Amplitude& cut) {
    for (std::size_t k = 0; k < cut.stations.size(); ++k)
      cut.leans[k] = leaning_as(corners, cut.stations[k] - mouth.s, cut.leans[k]);
  }

  /// Linear from one side of the mouth to the other.
  static void join_over_mouth(const Mouth& mouth, Amplitude& cut) {
    const std::size_t first = mouth.first, last = mouth.last;
    for (std::size_t k = first + 1; k < last; ++k) {
      const double part =
          (cut.stations[k] - cut.stations[first]) / (cut.stations[last] - cut.stations[first]);
      for (std::vector<double>* list : {&cut.values, &cut.shifts, &cut.leans})
        (*list)[k] = std::lerp((*list)[first], (*list)[last], part);
    }
  }

  /// Next to a crossing lips lean as its corners do.
  static void lean_by_corners(const Crossing& crossing, const CornerLean& corners, Amplitude& cut) {
    for (std::size_t k = 0; k < cut.stations.size(); ++k) {
      const double from = cut.stations[k] - crossing.s;
      cut.leans[k] = std::clamp(leaning_as(corners, from, cut.leans[k]), -most_lean, most_lean) *
                     std::lerp(1., std::min(1., std::abs(from) / crossing.fades), corners.share);
    }
  }

  /// Corners of a crossing are at different places of a cut (BesideCut::keep_with_own_piece), which must not
  /// part them before the blade has passed. `parted`: 0 then, where the amplitude is the same for them all,
  /// and 1 where they are free.
  static void part_corners(const Crossing& crossing, double parted, Amplitude& cut) {
    const Amplitude::At middle = cut(crossing.s);
    for (std::size_t k = 0; k < cut.stations.size(); ++k) {
      const double away = std::abs(cut.stations[k] - crossing.s) / crossing.fades;
      if (away > parts_within) continue;
      const double kept = std::lerp(std::max(0., (away - 1) / (parts_within - 1)), 1., parted);
      cut.values[k] = std::lerp(middle.value, cut.values[k], kept);
      cut.leans[k] = std::lerp(middle.lean, cut.leans[k], kept);
      cut.shifts[k] = std::lerp(middle.shift, cut.shifts[k], kept);
    }
  }

  const std::vector<const Wound*>& cuts_;
  std::vector<Crossing> crossings_;
  std::vector<Amplitude> alone_;  // stations, with 1 at all of them
  std::vector<Place> places_;
  std::vector<Parted> parted_;
  std::vector<Mouth> mouths_;
  std::vector<std::pair<std::size_t, std::size_t>> between_;  // a cut, and a station of it without lips
};

}  // namespace

std::vector<std::vector<Amplitude>> mutual_relief(const std::vector<const Wound*>& cuts,
                                                  const std::vector<double>& blades) {
  const std::vector<std::vector<Amplitude>> in_membrane = membrane_relief(cuts, blades);
  const AtStations stations(cuts);
  std::vector<std::vector<Amplitude>> result;
  for (std::size_t i = 0; i < blades.size(); ++i)
    result.push_back(stations.with_blade_at(blades[i], in_membrane[i]));
  return result;
}

Relief relief_while_cut(const std::vector<const Wound*>& cuts) {
  const double end = cuts.back()->felt();
  std::vector<double> parts;
  for (int i = 0; i <= steps; ++i) parts.push_back(static_cast<double>(i) / steps);
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k)
    for (const double s : touched_at(*cuts.back(), *cuts[k]))
      if (s < end) parts.push_back(s / end);
  // Where it runs on into another one.
  const OpenedTo opened_to = cuts.back()->volume.opened_to();
  if (const double arrives = opened_to.begins(); 0 < arrives && arrives < end) parts.push_back(arrives / end);
  std::ranges::sort(parts);
  const auto same = [](double a, double b) { return b - a < least_step; };
  parts.erase(std::unique(parts.begin(), parts.end(), same), parts.end());
  std::vector<double> blades;
  blades.reserve(parts.size());
  for (const double part : parts) blades.push_back(part * end);
  return Relief(std::move(parts), mutual_relief(cuts, blades));
}

}  // namespace cleft
