#include "explorer/wound/membrane_relief.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "explorer/wound/path_opening.h"

namespace cleft {

namespace {

/// Pieces of a cut as long as the canonical one, and of a cut: the ratio of two openings needs fewer than
/// they do.
constexpr int own_pieces = 24, most_pieces = 72, fewest_pieces = 6;
/// In reaches of the membrane: displacements beside a cut are as good as 0 there.
constexpr double farthest = 4;
/// Of the cosine between two normals: with less, the skin has turned away.
constexpr double turned_away = 0.1;
/// In depths of the deeper cut: cuts that are further from each other do not meet. Openings of parallel cuts
/// 3 mm deep and 3 mm apart are off by 0.11 in the membrane and by 0.07 by their strains, 4 mm apart by 0.05
/// and 0.07.
constexpr double nearly_meeting = 7. / 6;
/// Cosines between the paths of cuts that cross at a slant: from 80 to 25 degrees. And of the skin's normals
/// along them against that where they cross, at least.
constexpr double least_slant = 0.17, most_slant = 0.9, flat = 0.8;
/// How far a cut that crosses another is taken to open at most, over what it opens alone: next to its ends,
/// where it opens little alone, the field cannot open it otherwise.
constexpr double most_of_crossing = 1.1;
/// What is less of a cut's own opening, over the largest, is no measure of it.
constexpr double least_opening = 1e-6;

/// A cut in straight pieces.
struct Cut {
  struct Piece {
    Vec3 begin, middle, end;  // mm
    PathFrame frame;          // in the middle
  };
  std::vector<Piece> pieces;
  double piece;  // mm

  explicit Cut(const Wound& wound) {
    const double length = wound.complete(), canonical = wound.field.shape().cut().length,
                 scale = wound.scale();
    const int count = std::clamp(static_cast<int>(std::lround(own_pieces * length / canonical)),
                                 fewest_pieces, most_pieces);
    piece = length / count;
    const auto place = [&](double s) { return scale * wound.incision->path().at(s / scale).position; };
    for (int i = 0; i < count; ++i) {
      const double s = i * piece;
      pieces.push_back({place(s), place(s + piece / 2), place(s + piece),
                        wound.volume.skin_frame((s + piece / 2) / scale)});
    }
  }

  Eigen::Index rows() const { return 2 * static_cast<Eigen::Index>(pieces.size()); }
  std::vector<double> stations() const {
    std::vector<double> result;
    for (std::size_t i = 0; i < pieces.size(); ++i) result.push_back((double(i) + 0.5) * piece);
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

/// What is opened over what opens across the cut alone.
Amplitude over_alone(const Cut& cut, const Eigen::VectorXd& opened, const Eigen::VectorXd& alone) {
  double largest = 0;
  for (Eigen::Index i = 1; i < alone.size(); i += 2) largest = std::max(largest, alone(i));
  Amplitude result{cut.stations(), {}};
  for (Eigen::Index i = 0; i < alone.size(); i += 2) {
    const bool opens = alone(i + 1) > least_opening * largest;
    const double value = opens ? std::max(0., opened(i + 1) / alone(i + 1)) : 1;
    result.values.push_back(value);
    result.shifts.push_back(opens ? (opened(i) - value * alone(i)) / alone(i + 1) : 0);
  }
  // Ahead of the blade as at its tip.
  result.values.resize(cut.pieces.size(), result.values.empty() ? 1 : result.values.back());
  result.shifts.resize(cut.pieces.size(), result.shifts.empty() ? 0 : result.shifts.back());
  return result;
}

/// All cuts in one membrane. With the last one cut in part, its first pieces alone are open: their equations
/// are what the elimination of the complete cuts leaves.
class Together {
 public:
  Together(const std::vector<const Wound*>& wounds, const Meetings& meets, const CutMembrane& membrane)
      : feel_(wounds.size(), false), crosses_(wounds.size(), false) {
    std::vector<Eigen::Index> first = {0};
    for (const Wound* wound : wounds) {
      cuts_.emplace_back(*wound);
      first.push_back(first.back() + cuts_.back().rows());
    }
    const Eigen::Index complete = first[cuts_.size() - 1], last = cuts_.back().rows();
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(first.back(), first.back());
    Eigen::VectorXd tractions(first.back());
    for (std::size_t i = 0; i < cuts_.size(); ++i) {
      tractions.segment(first[i], cuts_[i].rows()) = tractions_on(*wounds[i], cuts_[i]);
      for (std::size_t j = 0; j < cuts_.size(); ++j) {
        if (i != j && meets[i][j] == Meeting::close) continue;
        all.block(first[i], first[j], cuts_[i].rows(), cuts_[j].rows()) = taken(membrane, cuts_[i], cuts_[j]);
        if (i != j) feel_[i] = true, crosses_[i] = crosses_[i] || meets[i][j] == Meeting::at_a_slant;
      }
      if (i + 1 < cuts_.size())
        alone_.push_back(all.block(first[i], first[i], cuts_[i].rows(), cuts_[i].rows())
                             .partialPivLu()
                             .solve(tractions.segment(first[i], cuts_[i].rows())));
    }
    last_alone_ = all.bottomRightCorner(last, last), last_tractions_ = tractions.tail(last);
    const auto factor = all.topLeftCorner(complete, complete).partialPivLu();
    by_last_ = factor.solve(all.topRightCorner(complete, last));
    by_tractions_ = factor.solve(tractions.head(complete));
    const auto of_complete = all.bottomLeftCorner(last, complete);
    left_ = last_alone_ - of_complete * by_last_;
    left_tractions_ = last_tractions_ - of_complete * by_tractions_;
  }

  std::vector<Amplitude> with_blade_at(double blade) const {
    const double at = std::clamp(blade / cuts_.back().piece, 0., double(cuts_.back().pieces.size()));
    const auto before = static_cast<Eigen::Index>(at);
    std::vector<Amplitude> result = when_cut(before);
    const double part = at - double(before);
    if (part == 0) return result;
    const std::vector<Amplitude> after = when_cut(before + 1);
    for (std::size_t k = 0; k < result.size(); ++k)
      for (std::size_t i = 0; i < result[k].values.size(); ++i) {
        result[k].values[i] += part * (after[k].values[i] - result[k].values[i]);
        result[k].shifts[i] += part * (after[k].shifts[i] - result[k].shifts[i]);
      }
    return result;
  }

 private:
  /// With so many pieces of the last cut open.
  std::vector<Amplitude> when_cut(Eigen::Index pieces) const {
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
    result.push_back(
        over_alone(cuts_.back(), opened,
                   last_alone_.topLeftCorner(rows, rows).partialPivLu().solve(last_tractions_.head(rows))));
    for (std::size_t k = 0; k < result.size(); ++k) {
      if (!feel_[k]) result[k] = {};
      if (crosses_[k])
        for (double& value : result[k].values) value = std::min(value, most_of_crossing);
    }
    return result;
  }

  std::vector<Cut> cuts_;
  std::vector<bool> feel_, crosses_;    // others; at a slant
  std::vector<Eigen::VectorXd> alone_;  // of the complete ones
  Eigen::MatrixXd last_alone_, left_;   // of the last one, alone and with what the complete ones leave of it
  Eigen::MatrixXd by_last_;             // how far openings of the last one close the complete ones
  Eigen::VectorXd last_tractions_, left_tractions_, by_tractions_;
};

}  // namespace

namespace {

/// Where a cut is nearest to another one.
struct Nearest {
  double distance = std::numeric_limits<double>::infinity();  // mm
  double s = 0, other_s = 0;                                  // along their paths, mm
};

Nearest nearest_of(const Cut& cut, const Wound& other) {
  const ScalpelPath& path = other.incision->path();
  const double scale = other.scale(), end = other.complete() / scale;
  Nearest nearest;
  for (std::size_t i = 0; i < cut.pieces.size(); ++i) {
    const Cut::Piece& piece = cut.pieces[i];
    double s = static_cast<double>(i) * cut.piece;
    for (const Vec3& place : {piece.begin, piece.middle, piece.end}) {
      const Vec3 there = 1 / scale * place;
      const double other_s = std::clamp(path.coordinates(there, 0, end).s, 0., end);
      if (const double distance = scale * norm(path.at(other_s).position - there);
          distance < nearest.distance)
        nearest = {distance, s, scale * other_s};
      s += cut.piece / 2;
    }
  }
  return nearest;
}

/// Whether cuts cross in flat skin, neither at a right angle nor nearly along each other.
bool cross_at_a_slant(const Cut& a, const Cut& b, const Nearest& nearest) {
  const auto piece_at = [](const Cut& cut, double s) -> const Cut::Piece& {
    return cut.pieces[std::min(cut.pieces.size() - 1, static_cast<std::size_t>(s / cut.piece))];
  };
  const PathFrame &of_a = piece_at(a, nearest.s).frame, &of_b = piece_at(b, nearest.other_s).frame;
  const double cosine = std::abs(dot(of_a.along, of_b.along));
  const auto is_flat = [&](const Cut& cut) {
    return std::all_of(cut.pieces.begin(), cut.pieces.end(), [&](const Cut::Piece& piece) {
      return dot(piece.frame.outward, of_a.outward) > flat;
    });
  };
  return nearest.distance < a.piece && least_slant < cosine && cosine < most_slant && is_flat(a) &&
         is_flat(b);
}

Meeting meeting(const Wound& a, const Cut& of_a, const Wound& b, const Cut& of_b) {
  const Nearest nearest = nearest_of(of_a, b);
  const double depth = std::max(a.scale() * a.incision->path().largest_depth(),
                                b.scale() * b.incision->path().largest_depth());
  if (nearest.distance >= nearly_meeting * depth) return Meeting::apart;
  const bool slant = a.field.turns() && b.field.turns() && cross_at_a_slant(of_a, of_b, nearest);
  return slant ? Meeting::at_a_slant : Meeting::close;
}

}  // namespace

Meeting meeting(const Wound& a, const Wound& b) { return meeting(a, Cut(a), b, Cut(b)); }

Meetings meetings(const std::vector<const Wound*>& cuts) {
  Meetings result(cuts.size(), std::vector<Meeting>(cuts.size(), Meeting::close));
  std::vector<Cut> pieces;
  pieces.reserve(cuts.size());
  for (const Wound* cut : cuts) pieces.emplace_back(*cut);
  for (std::size_t i = 0; i < cuts.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      result[i][j] = result[j][i] = meeting(*cuts[i], pieces[i], *cuts[j], pieces[j]);
  return result;
}

std::vector<std::vector<Amplitude>> membrane_relief(const std::vector<const Wound*>& cuts,
                                                    const Meetings& meets,
                                                    const std::vector<double>& blades) {
  std::optional<CutMembrane> membrane;
  for (const Wound* cut : cuts)
    if (!membrane) membrane = membrane_of(cut->field, cut->complete() / 2);
  if (!membrane) return {};
  std::vector<std::vector<Amplitude>> result(blades.size(), std::vector<Amplitude>(cuts.size()));
  if (cuts.size() < 2) return result;
  const Together together(cuts, meets, *membrane);
  for (std::size_t i = 0; i < blades.size(); ++i) result[i] = together.with_blade_at(blades[i]);
  return result;
}

}  // namespace cleft
