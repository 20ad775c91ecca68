#include "explorer/wound/mutual_relief.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "base/stations.h"
#include "explorer/wound/corner_lean.h"
#include "explorer/wound/membrane_relief.h"
#include "explorer/wound/shear_lean.h"
#include "explorer/wound/touched_at.h"

namespace cleft {

namespace {

/// Of a cut's path, in which the relief is taken as linear: a fiftieth of it turns amplitudes by little.
/// Steps also end where the cut meets others: corners of a crossing part when the blade has passed it, and
/// not before. As parts of the path, steps that are closer than that are one.
constexpr int steps = 48;
constexpr double least_step = 1e-9;

/// Of what lips change sides over where cuts cross, so far ends what keeps their corners from parting.
constexpr double parts_within = 2;
/// Depths to either side of where another cut opens into this one, over which what its field does not move of
/// the lips is linear: the lip beyond is whole there.
constexpr double mouth_reach = 0.5;
/// Depths from an end of a cut, within which its opening is too small to tell how far branches move its lips.
constexpr double beside_end = 0.2;
/// Of how far beside it corners part: lips so near are its corners themselves. Of the blade's way until they
/// part, that until they are free.
constexpr double at_corners = 1e-2, parted_over = 0.5;

/// How far a complete cut alone opens along, across and upward, mm.
Vec3 opening_at(double s, const Wound& wound) {
  const double length = wound.complete();
  const auto [u, time_offset] = wound.volume.canonical(s, length);
  const double t =
      std::clamp(wound.volume.opened_to()(length) + time_offset, 0., wound.field.shape().cut().length);
  return wound.field.displacement({u, 0, 0}, Side::right, t, s) -
         wound.field.displacement({u, 0, 0}, Side::left, t, s);
}

}  // namespace

Amplitude::At Amplitude::operator()(double s) const {
  const auto [before, after, part] = between(stations, s);
  const auto in = [&, &a = before, &b = after, &of_b = part](const std::vector<double>& list) {
    return list.empty() ? 0 : a == b ? list[a] : (1 - of_b) * list[a] + of_b * list[b];
  };
  return {in(values), in(leans), in(shifts)};
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
      : cuts_(cuts),
        crossings_(crossings_of(cuts)),
        alone_(cuts.size()),
        without_ends_(cuts.size()),
        by_shear_(cuts) {
    for (std::size_t i = 0; i < cuts.size(); ++i) {
      const Wound& cut = *cuts[i];
      Amplitude& own = alone_[i];
      for (const auto& [s, lips] : stations_of(i)) {
        if (!own.stations.empty() && s <= own.stations.back()) continue;
        const std::size_t station = own.stations.size();
        const Vec3 alone = opening_at(s, cut);
        const double opening = alone.y;
        own.stations.push_back(s);
        // Where it opens into another one it has no end, beside which lips lean in skin that is sheared.
        const bool at_end = s > cut.complete() / 2;
        without_ends_[i].push_back(cut.volume.mouth(at_end) && opening > 0 ? -alone.z / opening : 0);
        if (!lips) {
          between_.emplace_back(i, station);
          continue;
        }
        by_shear_.add({i, station, s, opening, lips->first, lips->second});
        for (std::size_t j = 0; j < cuts.size(); ++j) {
          if (j == i || !cuts[j]->mouth_in(cut) || !(opening > 0)) continue;
          const std::optional<ActiveVertex> left = cuts[j]->volume.locate(lips->first),
                                            right = cuts[j]->volume.locate(lips->second);
          if (left && right) parted_.push_back({i, j, station, left->s, opening, *left, *right});
        }
      }
      own.values.assign(own.stations.size(), 1);
      own.leans = own.shifts = std::vector<double>(own.stations.size(), 0);
    }
    std::vector<std::size_t> numbers(cuts.size(), 0);
    for (const Crossing& mouth : crossings_) {
      if (mouth.branch == 0) continue;
      const std::size_t number = numbers[mouth.cut]++;
      const std::vector<double>& s = alone_[mouth.cut].stations;
      const double beside = beside_mouth(mouth);
      const auto first = std::ranges::lower_bound(s, mouth.s - beside),
                 last = std::ranges::upper_bound(s, mouth.s + beside);
      if (first == s.begin() || last == s.end()) continue;
      mouths_.push_back(
          {mouth, static_cast<std::size_t>(first - s.begin()) - 1, static_cast<std::size_t>(last - s.begin()),
           static_cast<std::size_t>(std::ranges::lower_bound(s, mouth.s) - s.begin()), number, std::nullopt});
    }
    find_across();
  }

  std::vector<Amplitude> with_blade_at(double blade, const std::vector<Amplitude>& in_membrane) const {
    std::vector<Amplitude> result = alone_;
    ShearLean::Leans leans = by_shear_.leans(blade, in_membrane);
    for (std::size_t i = 0; i < leans.size(); ++i)
      for (std::size_t k = 0; k < without_ends_[i].size(); ++k)
        leans[i][i].push_back(in_membrane[i].at(alone_[i].stations[k]) * without_ends_[i][k]);
    for (std::size_t i = 0; i < result.size(); ++i) result[i].leans = total(leans[i], result[i].leans.size());
    std::vector<Amplitude> by_branches = moved_by_branches(blade, in_membrane, result);
    fill_between(leans, by_branches);
    std::vector<double> parted;
    for (const Crossing& crossing : crossings_) {
      const CornerLean corners = lean_at(crossing, cuts_, blade, in_membrane);
      if (crossing.branch == 0)
        lean_by_corners(crossing, corners, alone_[crossing.cut].stations,
                        leans[crossing.cut][crossing.other]);
      else
        lean_beside(crossing, corners, alone_[crossing.cut].stations, leans[crossing.cut][crossing.other]);
      parted.push_back(corners.share);
    }
    for (std::size_t i = 0; i < result.size(); ++i) {
      result[i].leans = total(leans[i], result[i].leans.size());
      for (std::size_t k = 0; k < result[i].stations.size(); ++k) {
        const Amplitude& other = by_branches[i];
        const Amplitude::At there = in_membrane[i](result[i].stations[k]);
        result[i].leans[k] = std::clamp(result[i].leans[k] - other.leans[k], -most_lean, most_lean);
        result[i].values[k] = std::min(most_opening, std::max(0., there.value - other.values[k]));
        result[i].shifts[k] = std::clamp(there.shift - other.shifts[k], -most_shift, most_shift);
      }
    }
    for (const Mouth& mouth : mouths_) keep_opening(mouth, result[mouth.at.cut]);
    const std::vector<Amplitude> wanted = result;
    for (const Mouth& mouth : mouths_) join_over_mouth(mouth, result[mouth.at.cut]);
    for (const Crossing& mouth : crossings_)
      if (mouth.branch != 0) result[mouth.cut].free.push_back(free_corners(mouth, blade));
    for (const Mouth& mouth : mouths_) part_lip(mouth, wanted[mouth.at.cut], result[mouth.at.cut]);
    for (std::size_t i = 0; i < crossings_.size(); ++i) {
      if (crossings_[i].branch != 0) continue;
      Amplitude& cut = result[crossings_[i].cut];
      part_corners(crossings_[i], parted[i], cut);
      for (Amplitude& corners : cut.of_corners) part_corners(crossings_[i], parted[i], corners);
    }
    return result;
  }

 private:
  static std::array<std::vector<double>*, 3> lists_of(Amplitude& cut) {
    return {&cut.values, &cut.shifts, &cut.leans};
  }

  /// Lips of a cut in the volume of another one that opens into it, and moves them differently.
  struct Parted {
    std::size_t cut, by, station;
    double s;        // mm, along the other's path
    double opening;  // mm, of the cut alone
    ActiveVertex left, right;
  };

  /// Where another cut opens into one, the stations between which its other lip is joined.
  struct Mouth {
    Crossing at;
    std::size_t first, last, behind;  // and that of the corner behind it, after that of the other one
    std::size_t number;               // in Amplitude::free
    std::optional<std::size_t>
        across;  // the number in mouths_ of one in the other lip, between these stations
  };

  /// Pairs of mouths in opposite lips whose stations overlap: both lips are joined over the stations of both.
  void find_across() {
    for (std::size_t i = 0; i < mouths_.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        Mouth &one = mouths_[i], &other = mouths_[j];
        if (one.at.cut != other.at.cut || one.at.branch == other.at.branch || one.across || other.across ||
            one.first >= other.last || other.first >= one.last)
          continue;
        one.across = j, other.across = i;
        one.first = other.first = std::min(one.first, other.first);
        one.last = other.last = std::max(one.last, other.last);
      }
  }

  /// The share of what parts the lips at s mm that the lip with this mouth takes: all of it or, where another
  /// cut opens into the lip across, less the nearer to that one's mouth.
  double own_part(const Mouth& mouth, double s, const std::vector<double>& free) const {
    if (!mouth.across) return 1;
    const Mouth& other = mouths_[*mouth.across];
    const double way = other.at.s - mouth.at.s;
    const double nearer = std::abs(way) > Crossing::corners_apart ? (s - mouth.at.s) / way : 0.5;
    return 1 - free[other.number] * std::clamp(nearer, 0., 1.);
  }

  /// mm of a cut to either side of where another one opens into it.
  double beside_mouth(const Crossing& mouth) const {
    const Wound& cut = *cuts_[mouth.cut];
    return std::min(
        {mouth_reach * cut.field.shape().cut().depth, mouth.s / 2, (cut.complete() - mouth.s) / 2});
  }

  using Lips = std::pair<int, int>;
  using Station = std::pair<double, std::optional<Lips>>;
  /// The lips of a cut's chain, and places without: where lips change the side to which they lean, and where
  /// another cut opens into it.
  std::vector<Station> stations_of(std::size_t cut) const {
    std::vector<Station> result;
    for (const Incision::ChainVertex& c : cuts_[cut]->incision->chain()) {
      const double s = c.s * cuts_[cut]->scale();
      const bool at_corner = std::ranges::any_of(crossings_, [&](const Crossing& mouth) {
        return mouth.cut == cut && mouth.branch != 0 && std::abs(s - mouth.s) < at_corners * mouth.fades;
      });
      result.emplace_back(s, at_corner ? std::nullopt : std::optional<Lips>({c.left, c.right}));
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
      if (crossing.cut == cut && crossing.branch == 0)
        for (const double fades : {-parts_within, -1., -corner_part, 0., corner_part, 1., parts_within})
          if (const double s = crossing.s + fades * crossing.fades; first < s && s < last)
            result.emplace_back(s, std::nullopt);
    const auto earlier = [](const auto& a, const auto& b) { return a.first < b.first; };
    std::stable_sort(result.begin(), result.end(), earlier);
    for (const Crossing& mouth : crossings_) {
      if (mouth.cut != cut || mouth.branch == 0 || !(first < mouth.before() && mouth.behind() < last))
        continue;
      std::erase_if(result, [&](const Station& station) {
        return !station.second && std::abs(station.first - mouth.s) < at_corners * mouth.fades;
      });
      const Station corners[] = {{mouth.before(), lips_at(mouth, -1)}, {mouth.behind(), lips_at(mouth, 1)}};
      result.insert(std::ranges::upper_bound(result, mouth.s, {}, &Station::first), std::begin(corners),
                    std::end(corners));
    }
    return result;
  }

  /// At the corner before (-1) or behind (1) one that opens into a cut: the end of its lip, and the lip
  /// across.
  std::optional<Lips> lips_at(const Crossing& mouth, double side) const {
    const auto &across = cuts_[mouth.cut]->incision->chain(), &lips = cuts_[mouth.other]->incision->chain();
    const auto nearest = std::ranges::min_element(across, {}, [&](const Incision::ChainVertex& c) {
      return std::abs(c.s * cuts_[mouth.cut]->scale() - mouth.s);
    });
    // It may have been led on to the other side of the cut.
    const auto is_beside = [&](int vertex) {
      const std::optional<ActiveVertex> at = cuts_[mouth.cut]->volume.locate(vertex);
      return at && at->side == (mouth.branch > 0 ? Side::right : Side::left);
    };
    const auto is_end = [&](const Incision::ChainVertex& c) {
      return c.left != c.right && is_beside(c.left) && is_beside(c.right);
    };
    const auto first = std::ranges::find_if(lips, is_end);
    if (nearest == across.end() || first == lips.end()) return std::nullopt;
    const Incision::ChainVertex& end =
        mouth.at_end ? *std::find_if(lips.rbegin(), lips.rend(), is_end) : *first;
    const int corner = side * mouth.toward > 0 ? end.right : end.left;
    return mouth.branch > 0 ? Lips{nearest->left, corner} : Lips{corner, nearest->right};
  }

  /// The first station behind one without lips that has some.
  std::size_t next_vertex(std::size_t cut, std::size_t station) const {
    do ++station;
    while (std::ranges::binary_search(between_, std::pair(cut, station)));
    return station;
  }

  /// The station itself; of a corner beside a mouth that of the lip next to it.
  std::size_t next_to(std::size_t cut, std::size_t station) const {
    for (const Mouth& mouth : mouths_)
      if (mouth.at.cut == cut && (station == mouth.behind || station + 1 == mouth.behind))
        return station == mouth.behind ? station + 1 : station - 1;
    return station;
  }

  /// How far those that open into a cut part its lips themselves, as parts of its own displacement across.
  std::vector<Amplitude> moved_by_branches(double blade, const std::vector<Amplitude>& in_membrane,
                                           const std::vector<Amplitude>& leaning) const {
    std::vector<Amplitude> result = alone_;
    for (Amplitude& one : result) std::ranges::fill(one.values, 0);
    for (const Parted& lips : parted_) {
      const double at = lips.by + 1 < cuts_.size() ? cuts_[lips.by]->complete() : blade;
      const Wound& branch = *cuts_[lips.by];
      Amplitude::At there = in_membrane[lips.by](lips.s);
      there.lean = leaning[lips.by](lips.s).lean;
      there.shift = std::clamp(there.shift, -most_shift, most_shift);
      const auto moved = [&](const ActiveVertex& lip) {
        const double t = lip.time_at(at, branch.field.shape().cut().length);
        const Vec3 alone = lip.in_mesh(branch.field.displacement(lip.uvw, lip.side_at(at), t, lip.s));
        const BesideCut beside(lip, branch);
        return there.value * alone + dot(alone, beside.across) * there.added(beside);
      };
      const Wound& cut = *cuts_[lips.cut];
      const PathFrame frame = cut.volume.skin_frame(alone_[lips.cut].stations[lips.station] / cut.scale());
      const Vec3 apart = 1 / lips.opening * (moved(lips.right) - moved(lips.left));
      result[lips.cut].values[lips.station] += dot(apart, frame.across);
      result[lips.cut].shifts[lips.station] += dot(apart, frame.along);
      result[lips.cut].leans[lips.station] += dot(apart, frame.outward);
    }
    for (std::size_t i = 0; i < result.size(); ++i) as_beside_ends(i, result[i]);
    return result;
  }

  /// Next to an end that is closed, where a cut opens by nothing, it is moved as further away from it.
  void as_beside_ends(std::size_t cut, Amplitude& moved) const {
    const Wound& wound = *cuts_[cut];
    const std::vector<double>& s = moved.stations;
    const double beside = beside_end * wound.field.shape().cut().depth;
    const auto first = static_cast<std::size_t>(std::ranges::lower_bound(s, s.front() + beside) - s.begin()),
               last = static_cast<std::size_t>(std::ranges::upper_bound(s, s.back() - beside) - s.begin());
    if (first >= last) return;
    for (std::vector<double>* list : lists_of(moved)) {
      if (!wound.volume.mouth(false)) std::fill_n(list->begin(), first, (*list)[first]);
      if (!wound.volume.mouth(true))
        std::fill(list->begin() + static_cast<std::ptrdiff_t>(last), list->end(), (*list)[last - 1]);
    }
  }

  /// What lips lean in all, at the stations of a cut.
  static std::vector<double> total(const std::vector<std::vector<double>>& by_others, std::size_t stations) {
    std::vector<double> sum(stations, 0);
    for (const std::vector<double>& one : by_others)
      for (std::size_t k = 0; k < one.size(); ++k)
        sum[k] = std::clamp(sum[k] + one[k], -most_lean, most_lean);
    return sum;
  }

  /// Linear at stations without lips.
  void fill_between(ShearLean::Leans& leans, std::vector<Amplitude>& by_branches) const {
    for (const auto& [cut, station] : between_) {
      const std::vector<double>& s = alone_[cut].stations;
      const std::size_t next = next_vertex(cut, station), lip = next_to(cut, station);
      const double part = (s[station] - s[station - 1]) / (s[next] - s[station - 1]);
      const auto fill = [&, k = station](std::vector<double>& list) {
        list[k] = lip != k ? list[lip] : std::lerp(list[k - 1], list[next], part);
      };
      for (std::vector<double>* list : lists_of(by_branches[cut])) fill(*list);
      for (std::vector<double>& by_other : leans[cut])
        if (!by_other.empty()) fill(by_other);
    }
  }

  /// What leans by `lean`, so far `from` corners along the cut, mm, with them.
  static double leaning_as(const CornerLean& corners, double from, double lean) {
    return std::lerp(lean, from < 0 ? corners.before : corners.after, corners.at(from));
  }

  static void lean_beside(const Crossing& mouth, const CornerLean& corners,
                          const std::vector<double>& stations, std::vector<double>& leans) {
    for (std::size_t k = 0; k < stations.size(); ++k)
      leans[k] = leaning_as(corners, stations[k] - mouth.s, leans[k]);
  }

  /// Linear from one side of the mouth to the other.
  static void join_over_mouth(const Mouth& mouth, Amplitude& cut) {
    const std::size_t first = mouth.first, last = mouth.last;
    for (std::size_t k = first + 1; k < last; ++k) {
      const double part =
          (cut.stations[k] - cut.stations[first]) / (cut.stations[last] - cut.stations[first]);
      for (std::vector<double>* list : lists_of(cut))
        (*list)[k] = std::lerp((*list)[first], (*list)[last], part);
    }
  }

  /// How far the corners beside one that opens into it are free, with the blade of the last cut there: 0
  /// until all skin that moves with them is cut, then up to 1. One that ends there has opened half-way on
  /// then.
  double free_corners(const Crossing& mouth, double blade) const {
    const Wound& later = *cuts_[mouth.other];
    if (mouth.other + 1 < cuts_.size()) blade = later.complete();
    if (!mouth.at_end) return std::clamp((blade - mouth.way) / (parted_over * mouth.way), 0., 1.);
    const OpenedTo opened_to = later.volume.opened_to();
    return opened_to.runs_on > 0 ? std::max(0., 2 * opened_to.beyond(blade) / opened_to.runs_on - 1) : 0;
  }

  /// What parts the corners in the skin's plane is the cut between them alone: toward the mouth what is to
  /// either side of it goes to their mean.
  static void keep_opening(const Mouth& mouth, Amplitude& cut) {
    const std::vector<double>& s = cut.stations;
    const std::size_t before = mouth.behind - 1, behind = mouth.behind;
    for (std::vector<double>* list : {&cut.values, &cut.shifts}) {
      const double half = ((*list)[behind] - (*list)[before]) / 2;
      const auto shift = [&](std::size_t k, std::size_t corner, std::size_t end, double by) {
        (*list)[k] += by * (s[k] - s[end]) / (s[corner] - s[end]);
      };
      for (std::size_t k = mouth.first + 1; k <= before; ++k) shift(k, before, mouth.first, half);
      for (std::size_t k = behind; k < mouth.last; ++k) shift(k, behind, mouth.last, -half);
    }
  }

  /// The lip into which another cut opens parts from the other one, which stays whole, by what is wanted.
  void part_lip(const Mouth& mouth, const Amplitude& wanted, Amplitude& cut) const {
    if (cut.of_corners.empty()) cut.of_corners = std::vector<Amplitude>(2, cut);
    Amplitude& corners = cut.of_corners[mouth.at.side()];
    for (std::size_t k = mouth.first + 1; k < mouth.last; ++k) {
      const double own = 2 * own_part(mouth, cut.stations[k], cut.free);
      const auto part = [&, k](std::vector<double>& corner, const std::vector<double>& all,
                               const std::vector<double>& joined, double least, double most_there) {
        corner[k] = std::clamp(joined[k] + own * (all[k] - joined[k]), least, most_there);
      };
      part(corners.values, wanted.values, cut.values, 0, most_opening);
      part(corners.leans, wanted.leans, cut.leans, -2 * most_lean, 2 * most_lean);
      part(corners.shifts, wanted.shifts, cut.shifts, -2 * most_shift, 2 * most_shift);
    }
  }

  /// Next to a crossing lips lean as its corners do.
  static void lean_by_corners(const Crossing& crossing, const CornerLean& corners,
                              const std::vector<double>& stations, std::vector<double>& leans) {
    for (std::size_t k = 0; k < stations.size(); ++k) {
      // What is at the crossing counts as `corner_part` of `fades` further along, what is at `fades` as there
      // (BesideCut::keep_with_own_piece): `way` is how far from the crossing it is.
      const double from = stations[k] - crossing.s, away = std::abs(from) / crossing.fades,
                   part = std::max(0., away - corner_part) / (1 - corner_part),
                   way = std::max(least_step, crossing.fades * std::min(away, part));
      leans[k] = std::clamp(leaning_as(corners, std::copysign(way, from), leans[k]), -most_lean, most_lean) *
                 std::lerp(1., std::min(1., away), corners.share);
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
  std::vector<Amplitude> alone_;                   // stations, with 1 at all of them
  std::vector<std::vector<double>> without_ends_;  // of each cut: what it leans less at its stations
  ShearLean by_shear_;
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
