#include "explorer/wound/membrane_relief.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>

#include "explorer/wound/path_opening.h"

namespace cleft {

namespace {

/// Pieces of a cut as long as the canonical one, and of a cut: the ratio of two openings needs fewer than
/// they do. With shorter ones corners of a crossing part so steeply that the guard holds cuts back.
constexpr int own_pieces = 30, most_pieces = 90, fewest_pieces = 8;
/// In reaches of the membrane: displacements beside a cut are as good as 0 there.
constexpr double farthest = 4;
/// Of the cosine between two normals: with less, the skin has turned away.
constexpr double turned_away = 0.1;
/// The reach in which cuts that do not touch feel each other, over that with which one opens: so openings of
/// simulated parallel cuts, 4 to 10 mm apart, are off by 0.01, with the same reach by 0.02.
constexpr double reach_apart = 0.85;
/// In pieces: cuts that are nearer to each other touch, and pieces end there. And pieces are longer.
constexpr double touching = 0.25, shortest_piece = 0.3;
/// How far a cut that touches another is taken to open at most, over what it opens alone: next to its ends,
/// where it opens little alone, the field cannot open it otherwise.
constexpr double most_of_touching = 1.1;
/// Of a piece: so near to where another cut opens into it, it opens as in the piece's middle.
constexpr double next_to_mouth = 0.01;
/// What is less of a cut's own opening, over the largest, is no measure of it.
constexpr double least_opening = 1e-6;

double canonical_piece(const Wound& wound) { return wound.field.shape().cut().length / own_pieces; }

}  // namespace

std::vector<double> touched_at(const Wound& cut, const Wound& other) {
  constexpr int samples_a_piece = 2, rounds = 20;
  const ScalpelPath &path = cut.incision->path(), &other_path = other.incision->path();
  const double length = cut.complete(), other_end = other.complete() / other.scale();
  const int samples = std::max(2, static_cast<int>(samples_a_piece * length / canonical_piece(cut)));
  const auto distance = [&](double s) {
    const Vec3 there = cut.scale() / other.scale() * path.at(s / cut.scale()).position;
    const double other_s = std::clamp(other_path.coordinates(there, 0, other_end).s, 0., other_end);
    return other.scale() * norm(other_path.at(other_s).position - there);
  };
  std::vector<double> found, distances;
  for (int i = 0; i <= samples; ++i) distances.push_back(distance(length * i / samples));
  for (int i = 0; i <= samples; ++i) {
    const bool nearest =
        (i == 0 || distances[i - 1] >= distances[i]) && (i == samples || distances[i + 1] > distances[i]);
    // Between samples it is nearer by no more than the way to them.
    if (!nearest || distances[i] > touching * canonical_piece(cut) + length / samples) continue;
    double from = length * std::max(0, i - 1) / samples, to = length * std::min(samples, i + 1) / samples;
    for (int round = 0; round < rounds; ++round) {
      const double third = (to - from) / 3;
      if (distance(from + third) < distance(to - third))
        to -= third;
      else
        from += third;
    }
    if (distance((from + to) / 2) < touching * canonical_piece(cut)) found.push_back((from + to) / 2);
  }
  return found;
}

namespace {

/// A cut in straight pieces.
struct Cut {
  struct Piece {
    Vec3 begin, middle, end;  // mm
    PathFrame frame;          // in the middle
  };
  std::vector<Piece> pieces;
  std::vector<double> corners;  // mm along the path
  std::vector<double> mouths;   // likewise, of cuts that open into it

  /// `touched`: where pieces end.
  Cut(const Wound& wound, std::vector<double> touched) {
    const double length = wound.complete(), scale = wound.scale();
    const double piece = std::clamp(canonical_piece(wound), length / most_pieces, length / fewest_pieces);
    const auto place = [&](double s) { return scale * wound.incision->path().at(s / scale).position; };
    std::sort(touched.begin(), touched.end());
    touched.push_back(length);
    // What is beyond cuts that it begins and ends in opens nothing.
    const bool begins = wound.volume.mouth(false) && touched.front() < shortest_piece * piece;
    corners.push_back(begins ? touched.front() : 0);
    if (wound.volume.mouth(true) && touched.size() > 1 &&
        length - touched[touched.size() - 2] < shortest_piece * piece)
      touched.pop_back();
    for (const double to : touched) {
      const double from = corners.back();
      const bool last = to == touched.back();
      if (to - from < shortest_piece * piece || (!last && length - to < shortest_piece * piece)) continue;
      const int count = std::max(1, static_cast<int>(std::lround((to - from) / piece)));
      for (int i = 1; i <= count; ++i) corners.push_back(std::lerp(from, to, double(i) / count));
    }
    for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
      const double middle = (corners[i] + corners[i + 1]) / 2;
      pieces.push_back(
          {place(corners[i]), place(middle), place(corners[i + 1]), wound.volume.skin_frame(middle / scale)});
    }
  }

  /// The same, begun `count` pieces before its start, straight.
  Cut begun_before(int count) const {
    Cut result = *this;
    const double piece = corners[1] - corners[0];
    for (int i = 0; i < count; ++i) {
      const Piece& next = result.pieces.front();
      const Vec3 back = -piece * next.frame.along;
      result.pieces.insert(result.pieces.begin(),
                           {next.begin + back, next.begin + 0.5 * back, next.begin, next.frame});
      result.corners.insert(result.corners.begin(), result.corners.front() - piece);
    }
    return result;
  }

  /// The same, run on by `way` mm beyond its end, straight, in `count` pieces.
  Cut run_on(int count, double way) const {
    Cut result = *this;
    for (int i = 0; i < count; ++i) {
      const Piece& last = result.pieces.back();
      const Vec3 on = way / count * last.frame.along;
      result.pieces.push_back({last.end, last.end + 0.5 * on, last.end + on, last.frame});
      result.corners.push_back(result.corners.back() + way / count);
    }
    return result;
  }

  Eigen::Index rows() const { return 2 * static_cast<Eigen::Index>(pieces.size()); }
  std::vector<double> stations() const {
    std::vector<double> result;
    for (std::size_t i = 0; i + 1 < corners.size(); ++i) result.push_back((corners[i] + corners[i + 1]) / 2);
    return result;
  }
};

/// What openings of one cut take from the tractions on another, whose skin is unrolled around each piece.
Eigen::MatrixXd taken(const CutMembrane& membrane, const Cut& to, const Cut& from) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(to.rows(), from.rows());
  for (std::size_t i = 0; i < to.pieces.size(); ++i) {
    const auto& [begin, middle, end, frame] = to.pieces[i];
    const auto seen = [&, &at = middle, &axes = frame](const Vec3& place) -> Eigen::Vector2d {
      const Vec3 way = place - at;
      const Eigen::Vector2d in_skin(dot(way, axes.along), dot(way, axes.across));
      const double length = in_skin.norm();
      return length > 0 ? Eigen::Vector2d(norm(way) / length * in_skin) : in_skin;
    };
    for (std::size_t j = 0; j < from.pieces.size(); ++j) {
      const Cut::Piece& other = from.pieces[j];
      if (norm(other.middle - middle) > farthest * membrane.reach() ||
          dot(other.frame.outward, frame.outward) < turned_away)
        continue;
      result.block<2, 2>(2 * Eigen::Index(i), 2 * Eigen::Index(j)) =
          membrane.relief(seen(other.begin), seen(other.end));
    }
  }
  return result;
}

/// The shear, where the field tells one, and the tension across each piece before it is cut, MPa.
Eigen::VectorXd tractions_on(const Wound& wound, const Cut& cut) {
  const bool tells_shear = wound.field.shape().parameters.number("skin.prestress_uv").has_value();
  Eigen::VectorXd result(cut.rows());
  Eigen::Index row = 0;
  for (const double s : cut.stations()) {
    result(row++) = tells_shear ? wound.field.prestress(&Prestress::uv, s) : 0;
    result(row++) = wound.field.prestress(&Prestress::vv, s);
  }
  return result;
}

/// How a cut that begins or ends in another one opens alone, as its field shows it: next to its start, as so
/// far from the start of one that has begun before; and as one that has run on beyond its end.
class ShownAlone {
 public:
  ShownAlone(const CutMembrane& membrane, const Wound& wound, const Cut& cut)
      : opens_on_(wound.volume.opens_on(false)) {
    const double runs_on = wound.volume.opens_on(true);
    if (!(std::max(opens_on_, runs_on) > 0)) return;
    piece_ = cut.corners[1] - cut.corners[0];
    const double last_piece = cut.corners.back() - cut.corners[cut.corners.size() - 2];
    if (opens_on_ > 0) before_ = std::max(1, static_cast<int>(std::lround(opens_on_ / piece_ - 0.5)));
    if (runs_on > 0) after_ = std::max(1, static_cast<int>(std::lround(runs_on / last_piece)));
    const Cut longer = cut.begun_before(before_).run_on(after_, runs_on);
    taken_ = taken(membrane, longer, longer);
    const Eigen::VectorXd tractions = tractions_on(wound, cut);
    tractions_.resize(longer.rows());
    for (int i = 0; i < before_; ++i) tractions_.segment<2>(2 * i) = tractions.head<2>();
    tractions_.segment(2 * before_, tractions.size()) = tractions;
    for (int i = 0; i < after_; ++i) tractions_.tail(2 * (after_ - i)).head<2>() = tractions.tail<2>();
  }

  /// Of the pieces that are open.
  void in(Eigen::VectorXd& alone, bool has_run_on) const {
    const auto open = static_cast<int>(alone.size() / 2);
    const int after = has_run_on ? after_ : 0;
    if (after > 0) alone = opened(before_, open + after).head(alone.size());
    for (int i = 0; i < open && i < before_; ++i) {
      const int pieces = before_ - i + open + after;
      const double length = pieces * piece_, middle = (before_ + 0.5) * piece_,
                   there = std::min(opens_on_, length - piece_ / 2);
      alone.segment<2>(2 * i) = std::sqrt(there * (length - there) / (middle * (length - middle))) *
                                opened(i, pieces).segment<2>(2 * before_);
    }
  }

 private:
  Eigen::VectorXd opened(int first, int pieces) const {
    return taken_.block(2 * first, 2 * first, 2 * pieces, 2 * pieces)
        .partialPivLu()
        .solve(tractions_.segment(2 * first, 2 * pieces));
  }

  double opens_on_ = 0, piece_ = 0;  // mm
  int before_ = 0, after_ = 0;       // pieces
  Eigen::MatrixXd taken_;
  Eigen::VectorXd tractions_;
};

/// What is opened over what opens across the cut alone. `ahead`: where nothing is open yet.
Amplitude over_alone(const Cut& cut, const Eigen::VectorXd& opened, const Eigen::VectorXd& alone,
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
  result.values.resize(cut.pieces.size(), result.values.empty() ? ahead : result.values.back());
  result.shifts.resize(cut.pieces.size(), result.shifts.empty() ? 0 : result.shifts.back());
  for (const double mouth : cut.mouths) {
    const auto next = std::ranges::upper_bound(result.stations, mouth);
    if (next == result.stations.begin() || next == result.stations.end()) continue;
    const auto at = next - result.stations.begin();
    const double to_both = next_to_mouth * (next[0] - next[-1]);
    result.stations.insert(next, {mouth - to_both, mouth + to_both});
    for (std::vector<double>* list : {&result.values, &result.shifts})
      list->insert(list->begin() + at, {(*list)[at - 1], (*list)[at]});
  }
  return result;
}

/// All cuts in one membrane. With the last one cut in part, its first pieces alone are open: their equations
/// are what the elimination of the complete cuts leaves.
class Together {
 public:
  Together(const std::vector<const Wound*>& wounds, const CutMembrane& membrane) {
    std::vector<Eigen::Index> first = {0};
    const std::size_t count = wounds.size();
    std::vector<std::vector<bool>> touch(count, std::vector<bool>(count, false));
    for (std::size_t i = 0; i < count; ++i) {
      std::vector<double> touched;
      for (std::size_t j = 0; j < count; ++j) {
        if (i == j) continue;
        const std::vector<double> at = touched_at(*wounds[i], *wounds[j]);
        touched.insert(touched.end(), at.begin(), at.end());
        if (!at.empty()) touch[i][i] = touch[i][j] = touch[j][i] = true;
      }
      touch_.push_back(touch[i][i]);
      begins_.push_back(wounds[i]->volume.mouth(false).has_value());
      ends_.push_back(wounds[i]->volume.mouth(true).has_value());
      cuts_.emplace_back(*wounds[i], std::move(touched));
      for (std::size_t j = i + 1; j < count; ++j)
        for (const bool at_end : {false, true})
          if (const auto at = wounds[i]->mouth_of(*wounds[j], at_end)) cuts_.back().mouths.push_back(*at);
      first.push_back(first.back() + cuts_.back().rows());
    }
    const auto between = [&](bool in_contact) {
      return in_contact ? membrane : membrane.with_reach(reach_apart * membrane.reach());
    };
    const Eigen::Index complete = first[cuts_.size() - 1], last = cuts_.back().rows();
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(first.back(), first.back());
    Eigen::VectorXd tractions(first.back());
    for (std::size_t i = 0; i < cuts_.size(); ++i) {
      tractions.segment(first[i], cuts_[i].rows()) = tractions_on(*wounds[i], cuts_[i]);
      for (std::size_t j = 0; j < cuts_.size(); ++j)
        all.block(first[i], first[j], cuts_[i].rows(), cuts_[j].rows()) =
            taken(between(touch[i][j]), cuts_[i], cuts_[j]);
      shown_.emplace_back(between(touch[i][i]), *wounds[i], cuts_[i]);
      if (i + 1 < cuts_.size()) {
        alone_.push_back(all.block(first[i], first[i], cuts_[i].rows(), cuts_[i].rows())
                             .partialPivLu()
                             .solve(tractions.segment(first[i], cuts_[i].rows())));
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
    const auto before = std::max<Eigen::Index>(0, next - corners.begin() - 1);
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

  /// With so many pieces of the last cut open, which has run on in part.
  std::vector<Amplitude> when_cut(Eigen::Index pieces, double part_on) const {
    std::vector<Amplitude> result = with_pieces(pieces, part_on > 0);
    if (0 < part_on && part_on < 1) {
      std::vector<Amplitude> before = with_pieces(pieces, false);
      go_to(result, part_on, before);
      return before;
    }
    return result;
  }

  /// The same, which has run on or not.
  std::vector<Amplitude> with_pieces(Eigen::Index pieces, bool has_run_on) const {
    const Eigen::Index rows = 2 * pieces;
    const Eigen::VectorXd opened =
        left_.topLeftCorner(rows, rows).partialPivLu().solve(left_tractions_.head(rows));
    const Eigen::VectorXd of_complete = by_tractions_ - by_last_.leftCols(rows) * opened;
    std::vector<Amplitude> result;
    Eigen::Index row = 0;
    for (std::size_t k = 0; k + 1 < cuts_.size(); ++k) {
      result.push_back(over_alone(cuts_[k], of_complete.segment(row, alone_[k].size()), alone_[k]));
      row += alone_[k].size();
    }
    Eigen::VectorXd alone =
        last_alone_.topLeftCorner(rows, rows).partialPivLu().solve(last_tractions_.head(rows));
    shown_.back().in(alone, has_run_on);
    result.push_back(over_alone(cuts_.back(), opened, alone, begins_.back() ? 0 : 1));
    for (std::size_t k = 0; k < result.size(); ++k) {
      if (!touch_[k]) continue;
      // Where a cut opens into another one it has no end.
      const double length = cuts_[k].corners.back(), from = begins_[k] ? length / 2 : 0,
                   to = ends_[k] && (k + 1 < result.size() || has_run_on) ? length / 2 : length;
      for (std::size_t i = 0; i < result[k].values.size(); ++i)
        if (from <= result[k].stations[i] && result[k].stations[i] <= to)
          result[k].values[i] = std::min(result[k].values[i], most_of_touching);
    }
    return result;
  }

  std::vector<Cut> cuts_;
  std::vector<bool> touch_, begins_, ends_;  // others, and in others
  OpenedTo opened_to_;                       // of the last one
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
  const Together together(cuts, *membrane);
  for (std::size_t i = 0; i < blades.size(); ++i) result[i] = together.with_blade_at(blades[i]);
  return result;
}

}  // namespace cleft
