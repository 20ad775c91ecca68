#include "explorer/wound/path_opening.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <mutex>

#include "base/stations.h"
#include "explorer/wound/plane_tensor.h"
#include "explorer/wound/room.h"

namespace cleft {

namespace {

/// Pieces of a field's own cut, and of a path at most.
constexpr int own_pieces = 40, most_pieces = 120, fewest_pieces = 8;
/// The reach of a membrane is sought between these, in lengths of the field's own cut: four pieces, and what
/// is as good as endless.
constexpr double least_reach = 0.1, greatest_reach = 20;
constexpr double usual_poisson_ratio = 0.4;
/// What is added is no more than so many times the prestress, and leaves a cut this part of its own opening:
/// lips that the path's other parts press together bear on each other.
constexpr double most_added = 1, least_opening = 0.25;

/// Corners of a path in the plane, mm.
using Corners = std::vector<Eigen::Vector2d>;

/// Of pieces of the same length, each in a direction, radians.
Corners corners_of(double length, int pieces, const std::function<double(int)>& direction) {
  Corners result = {{0, 0}};
  for (int i = 0; i < pieces; ++i) {
    const double angle = direction(i);
    result.emplace_back(result.back() + length / pieces * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  return result;
}

/// In the middle of a straight cut, under unit tension across it.
double straight_opening(const CutMembrane& membrane, double length) {
  constexpr int pieces = own_pieces / 2 + 1;  // an odd number: one is in the middle
  Eigen::MatrixXd tension = Eigen::MatrixXd::Zero(2 * pieces, 1);
  for (int i = 0; i < pieces; ++i) tension(2 * i + 1, 0) = 1;
  const Corners corners = corners_of(length, pieces, [](int) { return 0.; });
  return membrane.openings(corners, tension)(2 * (pieces / 2) + 1, 0);
}

/// Which part of its opening in the middle a straight cut has when half of it is cut, by the membrane's
/// reach: of a short cut half, of a long one all.
struct HalfOpenings {
  CutMembrane membrane;
  std::vector<double> log_reach, part;  // falling

  explicit HalfOpenings(double poisson_ratio) : membrane(1, poisson_ratio) {
    constexpr int steps = 40;
    for (int i = 0; i <= steps; ++i) {
      log_reach.push_back(std::lerp(std::log(least_reach), std::log(greatest_reach), double(i) / steps));
      const double length = std::exp(-log_reach.back());  // in reaches
      part.push_back(straight_opening(membrane, length / 2) / straight_opening(membrane, length));
    }
  }

  /// In lengths of the cut.
  double reach(double of_half) const {
    const auto beyond = std::partition_point(part.begin(), part.end(), [&](double p) { return p > of_half; });
    if (beyond == part.begin()) return least_reach;
    if (beyond == part.end()) return greatest_reach;
    const auto i = static_cast<std::size_t>(beyond - part.begin());
    return std::exp(
        std::lerp(log_reach[i - 1], log_reach[i], (part[i - 1] - of_half) / (part[i - 1] - part[i])));
  }
};

/// Made once for each ratio.
const HalfOpenings& half_openings(double poisson_ratio) {
  static std::mutex mutex;
  static std::map<double, HalfOpenings> known;
  const std::lock_guard lock(mutex);
  return known.try_emplace(poisson_ratio, poisson_ratio).first->second;
}

/// Whether a path comes back to itself: so near, pieces feel each other's ends.
bool comes_back(const Corners& corners) {
  constexpr std::size_t next = 5;    // corners that are near each other anyway
  constexpr double near_pieces = 2;  // of a piece's length
  const double near = near_pieces * (corners[1] - corners[0]).norm();
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (std::size_t j = i + next; j < corners.size(); ++j)
      if ((corners[j] - corners[i]).norm() < near) return true;
  return false;
}

/// A path in the plane, in which it bends as in the skin.
Corners unrolled(const IncisionVolume& volume, double length, int pieces) {
  std::vector<double> directions;
  PathFrame before{};
  for (int i = 0; i < pieces; ++i) {
    const PathFrame frame = volume.skin_frame((i + 0.5) * length / pieces / volume.scale());
    directions.push_back(i == 0 ? 0
                                : directions.back() + std::atan2(dot(frame.along, before.across),
                                                                 dot(frame.along, before.along)));
    before = frame;
  }
  return corners_of(length, pieces, [&](int i) { return directions[i]; });
}

/// How a field's own cut opens in the membrane when `t` mm of it are cut.
class OwnOpening {
 public:
  OwnOpening(const CutMembrane& membrane, const OwnCut& own, double cut_length, double t)
      : own_(own), t_(t), middle_(cut_length / 2) {
    const int pieces =
        std::clamp(static_cast<int>(std::lround(own_pieces * t / cut_length)), fewest_pieces, own_pieces);
    piece_ = t / pieces;
    const auto direction = [&](int i) { return own.turned((i + 0.5) * piece_ - middle_); };
    Eigen::MatrixXd tractions(2 * pieces, 3);  // of unit stresses in the frame of the cut's middle
    for (int i = 0; i < pieces; ++i) {
      const double c = std::cos(direction(i)), s = std::sin(direction(i));
      tractions.row(2 * i) << -c * s, c * s, c * c - s * s;
      tractions.row(2 * i + 1) << s * s, c * c, -2 * c * s;
    }
    opened_ = membrane.openings(corners_of(t, pieces, direction), tractions);
  }

  /// Whether it is that of another cut too, but for what no opening shows.
  bool is_of(const OwnCut& own, double t) const {
    return std::abs(own.curvature - own_.curvature) < same_curvature &&
           std::abs(own.curvature_rate - own_.curvature_rate) < same_rate && std::abs(t - t_) < 1e-9 * t_;
  }

  /// At u mm from its start: along and across, under unit stresses along, across and in shear there.
  Eigen::Matrix<double, 2, 3> at(double u) const {
    // Between the middles of pieces the opening is smooth when it is divided by that of a straight cut.
    const auto shape = [&](double at) { return std::sqrt(std::max(1e-9, at * (t_ - at))); };
    const auto pieces = static_cast<int>(opened_.rows() / 2);
    const double place = std::clamp(u / piece_ - 0.5, 0., pieces - 1.);
    const int before = std::min(static_cast<int>(place), pieces - 2);
    Eigen::Matrix<double, 2, 3> opened = Eigen::Matrix<double, 2, 3>::Zero();
    for (const int i : {before, before + 1})
      opened += (i == before ? before + 1 - place : place - before) * shape(u) / shape((i + 0.5) * piece_) *
                opened_.middleRows<2>(2 * i);
    Eigen::Matrix3d in_middle;  // unit stresses there, in the frame of the middle
    for (int k = 0; k < 3; ++k) {
      std::array<double, 3> unit{};
      unit[static_cast<std::size_t>(k)] = 1;
      const auto [uu, vv, uv] = turned(unit, own_.turned(u - middle_));
      in_middle.col(k) << uu, vv, uv;
    }
    return opened * in_middle;
  }

 private:
  /// 1/mm and 1/mm^2: a cut of 40 mm turns by less than 2 mrad from its middle to an end.
  static constexpr double same_curvature = 5e-5, same_rate = 5e-6;

  OwnCut own_;
  double t_, middle_, piece_ = 0;
  Eigen::MatrixXd opened_;
};

}  // namespace

double middle_opening(const VaryingField& field, double t, double s) {
  const Vec3 middle{field.shape().cut().start + t / 2, 0, 0};
  return field.displacement(middle, Side::right, t, s).y - field.displacement(middle, Side::left, t, s).y;
}

std::optional<CutMembrane> membrane_of(const VaryingField& field, double s) {
  const Field& shape = field.shape();
  const double length = shape.cut().length;
  const double whole = middle_opening(field, length, s), half = middle_opening(field, length / 2, s);
  if (!(whole > 0) || !(half > 0)) return std::nullopt;
  const double poisson = shape.parameters.value_or(shape.parameters->skin.poisson_ratio, usual_poisson_ratio);
  const HalfOpenings& known = half_openings(poisson);
  return known.membrane.with_reach(length * known.reach(half / whole));
}

PathPrestress tension_of_winding(const CutMembrane& membrane, const CanonicalCut& cut,
                                 const IncisionVolume& volume, double length, const PathPrestress& prestress,
                                 const std::function<OwnCut(double s)>& own,
                                 const std::function<double(double s)>& ease) {
  const int pieces =
      std::clamp(static_cast<int>(std::lround(own_pieces * length / cut.length)), fewest_pieces, most_pieces);
  std::vector<Prestress> local;
  std::vector<double> eases;
  Eigen::MatrixXd tractions(2 * pieces, 1);
  PathPrestress result;
  for (int i = 0; i < pieces; ++i) {
    result.stations.push_back((i + 0.5) * length / pieces);
    local.push_back(prestress.at(result.stations.back()));
    eases.push_back(ease(result.stations.back()));
    tractions(2 * i, 0) = eases.back() * local.back().uv,
                     tractions(2 * i + 1, 0) = eases.back() * local.back().vv;
  }
  const Corners path = unrolled(volume, length, pieces);
  if (comes_back(path)) return {{0}, {{}}};
  const Eigen::MatrixXd opened = membrane.openings(path, tractions);
  std::optional<OwnOpening> of_own_cut;
  for (int i = 0; i < pieces; ++i) {
    const double s = result.stations[i];
    const auto [u, time_offset] = canonical_place(s, length, cut);
    const double t = std::clamp(length + time_offset, 0., cut.length);
    const OwnCut at = own(s);
    if (!of_own_cut || !of_own_cut->is_of(at, t)) of_own_cut.emplace(membrane, at, cut.length, t);
    const Eigen::Matrix<double, 2, 3> unit = eases[i] * of_own_cut->at(u - cut.start);
    const auto there = turned({local[i].uu, local[i].vv, local[i].uv}, -at.ahead);
    const Eigen::Rotation2Dd back(-at.ahead);
    const Eigen::Vector2d own_opening = unit * Eigen::Vector3d(there[0], there[1], there[2]);
    Eigen::Vector2d wanted = back * opened.middleRows<2>(2 * i).col(0);
    wanted[1] = std::max(wanted[1], std::min(own_opening[1], least_opening * own_opening[1]));
    const Eigen::Vector2d lacking = wanted - own_opening;
    const Eigen::Vector2d added = unit.rightCols<2>().lu().solve(lacking);
    const double most = most_added * std::max({std::abs(there[0]), std::abs(there[1]), std::abs(there[2])});
    result.values.push_back({0, std::clamp(added[0], -most, most), std::clamp(added[1], -most, most)});
  }
  return result;
}

}  // namespace cleft
