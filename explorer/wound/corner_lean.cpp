#include "explorer/wound/corner_lean.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace cleft {

namespace {

using Vector = Eigen::Vector2d;

/// How far a corner of a right angle rises over the way that it draws back, with a cut as deep as the skin is
/// thick, and the power of the depth over that; and by how much more with the cosine of the angle, and with
/// its square. Depths of the cut along it, over which that falls by e, of a right angle, and by how many more
/// with the cosine.
struct Rises {
  double right_angle, with_depth, with_cosine, with_square, reach, further_with_cosine;
};
/// Of simulated crossings at 20, 30, 45, 60 and 75 degrees, pulled 1 : 3, alike and 3 : 1, with cuts 2, 3 and
/// 5 mm deep, in tissue of 0.008, 0.02 and 0.05 MPa, which makes no difference.
constexpr Rises at_crossings{0.52, 0.27, 0.15, -0.15, 2. / 3, 0};
/// Of simulated branches at 45, 60, 75 and 90 degrees, pulled 1 : 3, alike and 3 : 1; and how far the
/// straight lip rises over the way that it draws back.
constexpr Rises at_mouths{0.58, 0, 0.23, 0, 0.42, 0.2};
constexpr double straight_lip_rises = 0.44;
/// The cosine of how far a corner beside a mouth turns away from the cut that opens there, where that no
/// longer shears it: of simulated branches at 45 and 60 degrees.
constexpr double obtuse = 0.7;
/// Depths that a cut goes beyond a crossing where its corners are free.
constexpr double freed = 1;

/// How a cut opens at a crossing.
struct Opening {
  double across_alone = 0;  ///< mm
  Vec3 between_lips;        ///< from left to right, in space
  PathFrame frame;
  double beyond = 0;  ///< mm: from the crossing to the nearer end of what is cut
};

Opening opening_of(const Wound& cut, double s, double blade, const Amplitude& in_membrane) {
  const CanonicalCut& canonical = cut.field.shape().cut();
  const auto [u, time_offset] = cut.volume.canonical(s, cut.complete());
  const double t = std::clamp(cut.volume.opened_to()(blade) + time_offset, 0., canonical.length);
  Opening result;
  result.frame = cut.volume.skin_frame(s / cut.scale());
  result.beyond = std::min(s, blade - s);
  if (result.beyond <= 0) return result;
  const Vec3 alone = cut.field.displacement({u, 0, 0}, Side::right, t, s) -
                     cut.field.displacement({u, 0, 0}, Side::left, t, s);
  const Amplitude::At there = in_membrane(s);
  result.across_alone = alone.y;
  result.between_lips = (there.value * alone.x + std::clamp(there.shift, -most_shift, most_shift) * alone.y) *
                            result.frame.along +
                        there.value * alone.y * result.frame.across;
  return result;
}

}  // namespace

double CornerLean::at(double from) const {
  return share * std::exp(-std::abs(from) / (from < 0 ? reach_before : reach_after));
}

CornerLean lean_at(const Crossing& crossing, const std::vector<const Wound*>& cuts, double blade,
                   const std::vector<Amplitude>& in_membrane) {
  const bool crosses = crossing.branch == 0;
  const auto blade_in = [&](std::size_t k) { return k + 1 < cuts.size() ? cuts[k]->complete() : blade; };
  const auto opening = [&](std::size_t k, double s) {
    return opening_of(*cuts[k], s, blade_in(k), in_membrane[k]);
  };
  const Opening own = opening(crossing.cut, crossing.s);
  Opening other = opening(crossing.other, crossing.other_s);
  if (crossing.at_end)  // its corners are free when it runs on
    other.beyond = cuts[crossing.other]->volume.opened_to().beyond(blade_in(crossing.other));
  const double depth =
      std::min(cuts[crossing.cut]->depth(crossing.s), cuts[crossing.other]->depth(crossing.other_s));
  const Rises& rises = crosses ? at_crossings : at_mouths;
  const double reach = rises.reach * depth;
  CornerLean result{0, 0, std::clamp(std::min(own.beyond, other.beyond) / (freed * depth), 0., 1.), reach,
                    reach};
  if (!(own.across_alone > 0) || result.share == 0) return {0, 0, 0, reach, reach};
  const auto in_skin = [&](const Vec3& x) {
    return Vector(dot(x, own.frame.along), dot(x, own.frame.across));
  };
  const Vector own_half = in_skin(own.between_lips) / 2,
               other_half = crossing.toward * in_skin(other.between_lips) / 2,
               other_ray = -crossing.toward * in_skin(other.frame.along).normalized();  // to v > 0
  const double thickness = cuts[crossing.cut]->skin_thickness(),
               of_right_angle = rises.right_angle * std::pow(depth / thickness, rises.with_depth),
               straight_lip = straight_lip_rises * std::abs(own_half.y());
  const auto cosine_of = [&](double behind, double side) { return Vector(behind, 0).dot(side * other_ray); };
  // Of the piece before (-1) or behind (1) the other cut, and at v < 0 (-1) or v > 0 (1).
  const auto height = [&](double behind, double side) {
    if (side == -crossing.branch) return straight_lip;
    const Vector along(behind, 0), other_edge = side * other_ray,
                                   drawn_back = side * own_half + behind * other_half;
    const double cosine = cosine_of(behind, side);
    return (of_right_angle + (rises.with_cosine + rises.with_square * cosine) * cosine) *
           drawn_back.dot((along + other_edge).normalized());
  };
  result.before = (height(-1, 1) - height(-1, -1)) / own.across_alone;
  result.after = (height(1, 1) - height(1, -1)) / own.across_alone;
  result.reach_before += rises.further_with_cosine * cosine_of(-1, crossing.branch) * depth;
  result.reach_after += rises.further_with_cosine * cosine_of(1, crossing.branch) * depth;
  return result;
}

double beside_branch(const Wound& cut, double s, const Wound& later) {
  double part = 1;
  for (const bool at_end : {false, true}) {
    const std::optional<double> mouth = cut.mouth_of(later, at_end);
    if (!mouth) continue;
    const auto place = [&](double at) { return cut.incision->path().at(at / cut.scale()).position; };
    const Vec3 way = place(s) - place(*mouth);
    const double distance = norm(way);
    if (!(distance > 0)) continue;
    const Vec3& along = later.volume.skin_frame(later.volume.mouth(at_end)->s / later.scale()).along;
    const double cosine = (at_end ? -1 : 1) * dot(way, along) / distance;
    part = std::min(part, std::clamp(1 + cosine / obtuse, 0., 1.));
  }
  return part;
}

}  // namespace cleft
