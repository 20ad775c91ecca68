#include "explorer/wound/mutual_relief.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>

#include "explorer/wound/path_opening.h"
#include "explorer/wound/stations.h"

namespace cleft {

namespace {

/// How far a cut is taken to open at most, over what it would alone, and lips to slide, over their opening.
constexpr double most = 3, most_slide = 1;
/// Pieces of a cut as long as the canonical one, of any cut, and of all cuts together.
constexpr double pieces_of_canonical = 24;
constexpr int fewest_pieces = 6, most_pieces = 48, pieces_of_all = 160;
/// Of a cut, whatever its length: where amplitudes are told.
constexpr int stations = 40;
/// How far lips lean, for all of the tension across the cut that another takes: as simulated parallel cuts of
/// 30 mm do, 4 to 20 mm apart. And over which part of its depth that falls by e.
constexpr double leaning = 0.25, leaning_reach = 2. / 3;

/// A cut in the membrane, as far as the blade has come.
struct InMembrane {
  std::vector<double> stations;  // the middles of its pieces, mm along the path
  std::vector<CutPiece> pieces;
  Eigen::VectorXd tractions;  // of the skin, along and across each piece
  Eigen::Index first = 0;     // of its rows among those of all cuts
};

InMembrane in_membrane(const Wound& cut, double length, std::size_t cuts) {
  InMembrane result;
  const double by_length = pieces_of_canonical * length / cut.field.shape().cut().length;
  const int count =
      std::clamp(static_cast<int>(std::lround(by_length)), fewest_pieces,
                 std::clamp(pieces_of_all / static_cast<int>(cuts), fewest_pieces, most_pieces));
  const auto place = [&](int corner) {
    return cut.scale() * cut.incision->path().at(length * corner / count / cut.scale()).position;
  };
  result.tractions.resize(2 * count);
  const RecordedParameters& told = cut.field.shape().parameters;
  const bool shear = told.number(told.name_of(told->skin.prestress.uv)) || cut.field.follows_shape();
  for (int i = 0; i < count; ++i) {
    const double s = (i + 0.5) * length / count;
    result.stations.push_back(s);
    result.pieces.push_back({place(i), place(i + 1), cut.volume.skin_frame(s / cut.scale()).outward});
    result.tractions[2 * i] = shear ? cut.field.prestress(&Prestress::uv, s) : 0;
    result.tractions[2 * i + 1] = cut.field.prestress(&Prestress::vv, s);
  }
  return result;
}

double station_of(const Wound& cut, int k) { return (k + 0.5) * cut.reached() / stations; }

Amplitude unrelieved(const Wound& cut) {
  Amplitude result;
  for (int k = 0; k < stations; ++k) result.stations.push_back(station_of(cut, k));
  result.values.resize(stations);
  return result;
}

Vec3 across(const CutPiece& piece) { return normalized(cross(piece.outward, piece.to - piece.from)); }

/// On which side of a piece the nearest piece of another cut goes along it: 1, -1 or, where they cross at a
/// right angle, 0.
double side_of(const CutPiece& piece, const std::vector<CutPiece>& other) {
  const auto way_to = [&](const CutPiece& there) {
    return 0.5 * (there.from + there.to - piece.from - piece.to);
  };
  const CutPiece& nearest =
      *std::min_element(other.begin(), other.end(), [&](const CutPiece& a, const CutPiece& b) {
        return dot(way_to(a), way_to(a)) < dot(way_to(b), way_to(b));
      });
  return std::copysign(dot(across(piece), across(nearest)),
                       dot(across(piece), across(nearest)) * dot(way_to(nearest), across(nearest)));
}

}  // namespace

Amplitude::Value Amplitude::at(double s) const {
  const auto [before, after, part] = between(stations, s);
  const Value &a = values[before], &b = values[after];
  return {std::lerp(a.across, b.across, part), std::lerp(a.slide, b.slide, part),
          std::lerp(a.lean, b.lean, part)};
}

BesideCut::BesideCut(const ActiveVertex& vertex, const Wound& wound)
    : s(vertex.s),
      along(vertex.along),
      across(vertex.across),
      outward(std::exp(-std::abs(vertex.uvw.y) / (leaning_reach * wound.field.shape().cut().depth)) *
              vertex.outward) {}

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

std::vector<Amplitude> mutual_relief(const std::vector<const Wound*>& cuts, double blade) {
  std::vector<Amplitude> result;
  result.reserve(cuts.size());
  for (const Wound* cut : cuts) result.push_back(unrelieved(*cut));
  if (cuts.size() > 1)
    for (const Wound* cut : cuts) cut->field.prestress(&Prestress::vv, 0);  // throws where it is not told
  const std::optional<CutMembrane> membrane = membrane_of(cuts.back()->field);
  if (!membrane) return result;
  std::vector<InMembrane> parts;
  std::vector<CutPiece> pieces;
  for (const Wound* cut : cuts) {
    const double length = cut == cuts.back() ? blade : cut->complete();
    if (!(length > 0)) continue;  // the newest has not begun
    parts.push_back(in_membrane(*cut, length, cuts.size()));
    parts.back().first = 2 * static_cast<Eigen::Index>(pieces.size());
    pieces.insert(pieces.end(), parts.back().pieces.begin(), parts.back().pieces.end());
  }
  if (parts.size() < 2) return result;
  const Eigen::MatrixXd relief = membrane->relief(pieces);
  Eigen::VectorXd tractions(relief.rows());
  for (const InMembrane& part : parts) tractions.segment(part.first, part.tractions.size()) = part.tractions;
  const Eigen::VectorXd together = relief.partialPivLu().solve(tractions);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const InMembrane& part = parts[i];
    const Eigen::Index rows = part.tractions.size();
    const Eigen::VectorXd alone =
        relief.block(part.first, part.first, rows, rows).partialPivLu().solve(part.tractions);
    Amplitude now{part.stations, std::vector<Amplitude::Value>(part.stations.size())};
    for (std::size_t k = 0; k < now.values.size(); ++k) {
      const auto row = static_cast<Eigen::Index>(2 * k);
      const double opened = alone[row + 1];
      if (!(opened > 0)) continue;
      auto& [across, slide, lean] = now.values[k];
      across = std::clamp(together[part.first + row + 1] / opened, 0., most);
      slide =
          std::clamp((together[part.first + row] - across * alone[row]) / opened, -most_slide, most_slide);
    }
    for (const InMembrane& other : parts) {
      if (&other == &part) continue;
      const Eigen::VectorXd taken = relief.block(part.first, other.first, rows, other.tractions.size()) *
                                    together.segment(other.first, other.tractions.size());
      for (std::size_t k = 0; k < now.values.size(); ++k) {
        const auto row = static_cast<Eigen::Index>(2 * k + 1);
        if (!(part.tractions[row] > 0)) continue;
        const double of_tension = std::clamp(taken[row] / part.tractions[row], 0., 1.);
        now.values[k].lean -= leaning * of_tension * side_of(part.pieces[k], other.pieces);
      }
    }
    // At the same stations wherever the blade is.
    for (int k = 0; k < stations; ++k) result[i].values[k] = now.at(result[i].stations[k]);
  }
  return result;
}

}  // namespace cleft
