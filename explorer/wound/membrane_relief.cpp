#include "explorer/wound/membrane_relief.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>

#include "explorer/wound/cut_membrane.h"
#include "explorer/wound/membrane_cut.h"
#include "explorer/wound/path_opening.h"
#include "explorer/wound/touched_at.h"

namespace cleft {

namespace {

/// In reaches of the membrane: displacements beside a cut are as good as 0 there.
constexpr double farthest = 4;
/// Of the cosine between two normals: with less, the skin has turned away.
constexpr double turned_away = 0.1;
/// The reach in which cuts that do not touch feel each other, over that with which one opens, and the
/// springs: so openings of simulated parallel cuts, 4 to 10 mm apart, are off by 0.01. With the springs of
/// cuts that touch, the one between two others, 8 mm from both, is off by 0.1.
constexpr double reach_apart = 0.87;
constexpr CutMembrane::Springs springs_apart{-0.11, 2.19, 0.1};
/// The springs of cuts that touch, and their length in depths: openings of simulated crossings and branches
/// 2, 3 and 5 mm deep are right with them. Over the reach the length is at most a fifth.
constexpr CutMembrane::Springs springs_in_contact{-1, 1.2};
constexpr double springs_in_depths = 0.36, longest_springs = 0.2;
/// How far a cut that touches another is taken to open at most, over what it opens alone: next to its ends,
/// where it opens little alone, the field cannot open it otherwise.
constexpr double most_of_touching = 1.1;
/// What is less of a cut's own opening, over the largest, is no measure of it.
constexpr double least_opening = 1e-6;

/// What openings of one cut take from the tractions on another, whose skin is unrolled around each piece.
/// Openings are told in the middles of pieces, in which they are as linear as between those of their stretch.
/// Where they are constant in each piece, corners of 36 to 42 degrees between cuts, whatever the pieces,
/// swing without limit: how a corner turns is no step from piece to piece.
Eigen::MatrixXd taken(const CutMembrane& membrane, const MembraneCut& to, const MembraneCut& from) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(to.rows(), from.rows());
  for (std::size_t i = 0; i < to.pieces.size(); ++i) {
    const Vec3& middle = to.pieces[i].middle;
    const PathFrame& frame = to.pieces[i].frame;
    const auto seen = [&](const Vec3& place) -> Eigen::Vector2d {
      const Vec3 way = place - middle;
      const Eigen::Vector2d in_skin(dot(way, frame.along), dot(way, frame.across));
      const double length = in_skin.norm();
      return length > 0 ? Eigen::Vector2d(norm(way) / length * in_skin) : in_skin;
    };
    for (std::size_t j = 0; j < from.pieces.size(); ++j) {
      const MembraneCut::Piece& other = from.pieces[j];
      if (norm(other.middle - middle) > farthest * membrane.reach() ||
          dot(other.frame.outward, frame.outward) < turned_away)
        continue;
      const auto relief = membrane.linear_relief(seen(other.begin), seen(other.end));
      const auto of = [&](std::size_t piece) {
        return result.block<2, 2>(2 * static_cast<Eigen::Index>(i), 2 * static_cast<Eigen::Index>(piece));
      };
      of(j) += relief.leftCols<2>();
      const MembraneCut::Beside beside = from.beside(j);
      of(beside.behind) += beside.part * relief.rightCols<2>();
      of(beside.before) -= beside.part * relief.rightCols<2>();
    }
  }
  return result;
}

/// How far each piece of a cut alone opens under the same tension across everywhere, in a membrane in which
/// its openings take so much from its own tractions.
Eigen::ArrayXd opened_by_tension(const Eigen::MatrixXd& taken_by_itself) {
  const Eigen::Index pieces = taken_by_itself.rows() / 2;
  Eigen::VectorXd tension(2 * pieces);
  tension << Eigen::Vector2d(0, 1).replicate(pieces, 1);
  return taken_by_itself.partialPivLu().solve(tension)(Eigen::seqN(1, pieces, 2)).array();
}

/// The shear, where the field tells one, and the tension across each piece before it is cut, MPa.
Eigen::VectorXd tractions_on(const Wound& wound, const MembraneCut& cut) {
  const bool tells_shear = wound.field.shape().parameters.number("skin.prestress_uv").has_value();
  Eigen::VectorXd result(cut.rows());
  Eigen::Index row = 0;
  for (const MembraneCut::Piece& piece : cut.pieces) {
    result(row++) = tells_shear ? wound.field.prestress(&Prestress::uv, piece.s) : 0;
    result(row++) = wound.field.prestress(&Prestress::vv, piece.s);
  }
  return result;
}

/// How a cut that begins or ends in another one opens alone, as its field shows it: next to its start, as so
/// far from the start of one that has begun before; and as one that has run on beyond its end.
class ShownAlone {
 public:
  ShownAlone(const CutMembrane& membrane, const Wound& wound, const MembraneCut& cut)
      : opens_on_(wound.volume.opens_on(false)) {
    const double runs_on = wound.volume.opens_on(true);
    if (!(std::max(opens_on_, runs_on) > 0)) return;
    stretch_ = cut.first_stretch();
    if (opens_on_ > 0) before_ = std::max(1, static_cast<int>(std::lround(opens_on_ / stretch_ - 0.5)));
    if (runs_on > 0) after_ = std::max(1, static_cast<int>(std::lround(runs_on / cut.last_stretch())));
    longer_ = cut.begun_before(before_).run_on(after_, runs_on);
    taken_ = taken(membrane, *longer_, *longer_);
    tractions_ = tractions_on(wound, *longer_);
  }

  /// `alone`: of the stretches that are open.
  void in(Eigen::VectorXd& alone, bool has_run_on) const {
    const auto open = static_cast<int>(alone.size() / 2);
    const int after = has_run_on ? after_ : 0;
    if (after > 0) alone = opened(before_, open + after).head(alone.size());
    for (int i = 0; i < open && i < before_; ++i) {
      const int stretches = before_ - i + open + after;
      const double length = stretches * stretch_, middle = (before_ + 0.5) * stretch_,
                   there = std::min(opens_on_, length - stretch_ / 2);
      alone.segment<2>(2 * i) = std::sqrt(there * (length - there) / (middle * (length - middle))) *
                                opened(i, stretches).segment<2>(2 * before_);
    }
  }

 private:
  Eigen::VectorXd opened(int first, int stretches) const {
    const auto from = static_cast<std::size_t>(first), to = from + static_cast<std::size_t>(stretches);
    const Eigen::Index row = 2 * longer_->first_pieces[from], rows = 2 * longer_->first_pieces[to] - row;
    return longer_->means(
        taken_.block(row, row, rows, rows).partialPivLu().solve(tractions_.segment(row, rows)), from);
  }

  double opens_on_ = 0, stretch_ = 0;  // mm
  int before_ = 0, after_ = 0;         // stretches
  std::optional<MembraneCut> longer_;
  Eigen::MatrixXd taken_;
  Eigen::VectorXd tractions_;
};

/// On to a place beyond the middle of the last stretch as between the last two. Alone, a cut that opens into
/// another one closes on to its end beyond that: its mean over the last stretch is not what it opens there.
void lead_to(double s, Amplitude& amplitude) {
  const std::vector<double>& at = amplitude.stations;
  if (at.size() < 2) return;
  const double part = (s - at.end()[-2]) / (at.back() - at.end()[-2]);
  for (std::vector<double>* list : {&amplitude.values, &amplitude.shifts})
    list->push_back(std::lerp(list->end()[-2], list->back(), part));
  amplitude.stations.push_back(s);
}

/// What is opened over what opens across the cut alone. `ahead`: where nothing is open yet.
Amplitude over_alone(const MembraneCut& cut, const Eigen::VectorXd& opened, const Eigen::VectorXd& alone,
                     double ahead = 1) {
  double largest = 0;
  for (Eigen::Index i = 1; i < alone.size(); i += 2) largest = std::max(largest, alone(i));
  Amplitude result{cut.stations(), {}};
  for (Eigen::Index i = 0; i < alone.size(); i += 2) {
    const bool opens = alone(i + 1) > least_opening * largest;
    const double value = opens ? std::max(0., opened(i + 1) / alone(i + 1)) : 1;
    result.values.push_back(value);
    result.shifts.push_back(opens ? (opened(i) - value * alone(i)) / alone(i + 1) : 0);
  }
  // Ahead of the blade as at its tip. The skin between two cuts that open into it moves along it as a whole.
  result.values.resize(cut.stretches(), result.values.empty() ? ahead : result.values.back());
  result.shifts.resize(cut.stretches(), result.shifts.empty() ? 0 : result.shifts.back());
  if (cut.ends_in_another) lead_to(cut.corners.back(), result);
  // Up to where another cut opens into it, it opens as in the middle of the stretch next to there.
  for (const double mouth : cut.mouths) {
    const auto next = std::ranges::upper_bound(result.stations, mouth);
    if (next == result.stations.begin() || next == result.stations.end()) continue;
    const auto at = next - result.stations.begin();
    const double to_both = Crossing::corners_apart / 2;
    result.stations.insert(next, {mouth - to_both, mouth + to_both});
    for (std::vector<double>* list : {&result.values, &result.shifts})
      list->insert(list->begin() + at, {(*list)[at - 1], (*list)[at]});
  }
  return result;
}

/// Where a cut touches another one at s mm of its path: the place of a joint that is known, or of a new one.
Vec3 joint_at(const Wound& cut, double s, std::vector<Vec3>& places) {
  const Vec3 there = cut.scale() * cut.incision->path().at(s / cut.scale()).position;
  for (const Vec3& place : places)
    if (norm(place - there) < touching_within(cut)) return place;
  return places.emplace_back(there);
}

/// All cuts in one membrane. A cut opens more in the membrane of cuts that touch than in that of cuts apart:
/// on those that it does not touch it acts by what it would open in the latter. With the last one cut in
/// part, its first stretches alone are open: their equations are what the elimination of the complete cuts
/// leaves.
class Together {
 public:
  Together(const std::vector<const Wound*>& wounds, const CutMembrane& membrane) {
    std::vector<Eigen::Index> first = {0};
    const std::size_t count = wounds.size();
    std::vector<std::vector<bool>> touch(count, std::vector<bool>(count, false));
    std::vector<Vec3> places;  // of all of them
    for (std::size_t i = 0; i < count; ++i) {
      std::vector<MembraneCut::Joint> joints;
      for (std::size_t j = 0; j < count; ++j) {
        if (i == j) continue;
        for (const double s : touched_at(*wounds[i], *wounds[j])) {
          joints.push_back({s, joint_at(*wounds[i], s, places)});
          touch[i][i] = touch[i][j] = touch[j][i] = true;
        }
      }
      touch_.push_back(touch[i][i]);
      begins_.push_back(wounds[i]->volume.mouth(false).has_value());
      cuts_.emplace_back(*wounds[i], std::move(joints));
      for (std::size_t j = i + 1; j < count; ++j)
        for (const bool at_end : {false, true})
          if (const auto at = wounds[i]->mouth_of(*wounds[j], at_end)) cuts_.back().mouths.push_back(*at);
      first.push_back(first.back() + cuts_.back().rows());
    }
    const CutMembrane apart = membrane.with(reach_apart * membrane.reach(), springs_apart);
    const auto between = [&](bool in_contact) -> const CutMembrane& { return in_contact ? membrane : apart; };
    const Eigen::Index complete = first[cuts_.size() - 1], last = cuts_.back().rows();
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(first.back(), first.back());
    Eigen::VectorXd tractions(first.back());
    for (std::size_t i = 0; i < cuts_.size(); ++i) {
      tractions.segment(first[i], cuts_[i].rows()) = tractions_on(*wounds[i], cuts_[i]);
      const auto block = [&](std::size_t j) {
        return all.block(first[j], first[i], cuts_[j].rows(), cuts_[i].rows());
      };
      block(i) = taken(between(touch[i][i]), cuts_[i], cuts_[i]);
      std::optional<Eigen::ArrayXd> as_apart;  // of its pieces
      for (std::size_t j = 0; j < cuts_.size(); ++j) {
        if (j == i) continue;
        block(j) = taken(between(touch[i][j]), cuts_[j], cuts_[i]);
        if (!touch[i][i] || touch[i][j]) continue;
        if (!as_apart)
          as_apart = opened_by_tension(taken(apart, cuts_[i], cuts_[i])) / opened_by_tension(block(i));
        for (Eigen::Index k = 0; k < block(j).cols(); ++k) block(j).col(k) *= (*as_apart)(k / 2);
      }
      shown_.emplace_back(between(touch[i][i]), *wounds[i], cuts_[i]);
      if (i + 1 < cuts_.size()) {
        alone_.push_back(
            cuts_[i].means(block(i).partialPivLu().solve(tractions.segment(first[i], cuts_[i].rows()))));
        shown_[i].in(alone_.back(), true);
      }
    }
    opened_to_ = wounds.back()->volume.opened_to();
    last_alone_ = all.bottomRightCorner(last, last), last_tractions_ = tractions.tail(last);
    const auto factor = all.topLeftCorner(complete, complete).partialPivLu();
    by_last_ = factor.solve(all.topRightCorner(complete, last));
    by_tractions_ = factor.solve(tractions.head(complete));
    const auto of_complete = all.bottomLeftCorner(last, complete);
    left_ = last_alone_ - of_complete * by_last_;
    left_tractions_ = last_tractions_ - of_complete * by_tractions_;
  }

  std::vector<Amplitude> with_blade_at(double blade) const {
    const std::vector<double>& corners = cuts_.back().corners;
    const auto next = std::upper_bound(corners.begin(), corners.end(), blade);
    const auto before = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, next - corners.begin() - 1));
    const double on = opened_to_.beyond(blade), part_on = on > 0 ? on / opened_to_.runs_on : 0;
    std::vector<Amplitude> result = when_cut(before, part_on);
    if (next == corners.begin() || next == corners.end()) return result;
    go_to(when_cut(before + 1, part_on), (blade - next[-1]) / (next[0] - next[-1]), result);
    return result;
  }

 private:
  static void go_to(const std::vector<Amplitude>& to, double part, std::vector<Amplitude>& from) {
    for (std::size_t k = 0; k < from.size(); ++k)
      for (std::size_t i = 0; i < from[k].values.size(); ++i) {
        from[k].values[i] += part * (to[k].values[i] - from[k].values[i]);
        from[k].shifts[i] += part * (to[k].shifts[i] - from[k].shifts[i]);
      }
  }

  /// With so many stretches of the last cut open, which has run on in part.
  std::vector<Amplitude> when_cut(std::size_t stretches, double part_on) const {
    std::vector<Amplitude> result = with_stretches(stretches, part_on > 0);
    if (0 < part_on && part_on < 1) {
      std::vector<Amplitude> before = with_stretches(stretches, false);
      go_to(result, part_on, before);
      return before;
    }
    return result;
  }

  /// The same, which has run on or not.
  std::vector<Amplitude> with_stretches(std::size_t stretches, bool has_run_on) const {
    const MembraneCut& last = cuts_.back();
    const Eigen::Index rows = 2 * last.first_pieces[stretches];
    const Eigen::VectorXd opened =
        left_.topLeftCorner(rows, rows).partialPivLu().solve(left_tractions_.head(rows));
    const Eigen::VectorXd of_complete = by_tractions_ - by_last_.leftCols(rows) * opened;
    std::vector<Amplitude> result;
    Eigen::Index row = 0;
    for (std::size_t k = 0; k + 1 < cuts_.size(); ++k) {
      const Eigen::VectorXd opened_there = of_complete.segment(row, cuts_[k].rows());
      result.push_back(over_alone(cuts_[k], cuts_[k].means(opened_there), alone_[k]));
      row += cuts_[k].rows();
    }
    Eigen::VectorXd alone =
        last.means(last_alone_.topLeftCorner(rows, rows).partialPivLu().solve(last_tractions_.head(rows)));
    shown_.back().in(alone, has_run_on);
    result.push_back(over_alone(last, last.means(opened), alone, begins_.back() ? 0 : 1));
    for (std::size_t k = 0; k < result.size(); ++k) {
      if (!touch_[k]) continue;
      // Where a cut opens into another one it has no end.
      const double length = cuts_[k].corners.back(), from = begins_[k] ? length / 2 : 0,
                   to = cuts_[k].ends_in_another && (k + 1 < result.size() || has_run_on) ? length / 2
                                                                                          : length;
      for (std::size_t i = 0; i < result[k].values.size(); ++i)
        if (from <= result[k].stations[i] && result[k].stations[i] <= to)
          result[k].values[i] = std::min(result[k].values[i], most_of_touching);
    }
    return result;
  }

  std::vector<MembraneCut> cuts_;
  std::vector<bool> touch_, begins_;  // others, and in others
  OpenedTo opened_to_;                // of the last one
  std::vector<ShownAlone> shown_;
  std::vector<Eigen::VectorXd> alone_;  // of the complete ones
  Eigen::MatrixXd last_alone_, left_;   // of the last one, alone and with what the complete ones leave of it
  Eigen::MatrixXd by_last_;             // how far openings of the last one close the complete ones
  Eigen::VectorXd last_tractions_, left_tractions_, by_tractions_;
};

}  // namespace

std::vector<std::vector<Amplitude>> membrane_relief(const std::vector<const Wound*>& cuts,
                                                    const std::vector<double>& blades) {
  std::vector<std::vector<Amplitude>> result(blades.size(), std::vector<Amplitude>(cuts.size(), {{0}, {1}}));
  if (cuts.size() < 2) return result;
  std::optional<CutMembrane> membrane;
  for (const Wound* cut : cuts)
    if (!membrane) membrane = membrane_of(cut->field, cut->complete() / 2);
  if (!membrane) return result;
  double depth = 0;
  for (const Wound* cut : cuts) depth += cut->depth(cut->complete() / 2) / static_cast<double>(cuts.size());
  CutMembrane::Springs springs = springs_in_contact;
  springs.length = std::min(longest_springs, springs_in_depths * depth / membrane->reach());
  const Together together(cuts, membrane->with(membrane->reach(), springs));
  for (std::size_t i = 0; i < blades.size(); ++i) result[i] = together.with_blade_at(blades[i]);
  return result;
}

}  // namespace cleft
