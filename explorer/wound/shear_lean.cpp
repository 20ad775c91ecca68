#include "explorer/wound/shear_lean.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "explorer/wound/corner_lean.h"

namespace cleft {

namespace {

/// How far lips lean in all, over how far the other cut shears the tissue above the bottom: of simulated
/// parallel cuts 10 to 60 mm long, 3 and 5 mm deep and 4 to 20 mm apart, in tissue of 0.008 to 0.05 MPa.
constexpr double leaning = 1.2;
/// Next to a shallow cut lips lean more, by so many times what the skin's thickness over the cut's depth is
/// above the least one. That counts in full up to so many depths from the cut, and falls to nothing at so
/// many. Of simulated parallel cuts 4 mm apart, and cuts that cross, 2, 3 and 5 mm deep.
constexpr double more_leaning = 0.95, least_thickness = 0.3, leans_more_to = 4. / 3,
                 leans_as_others_from = 2.5;
/// Depths of the cut: what lips lean falls to nothing over so much before an end.
constexpr double leans_fully = 0.6;
/// The shear is summed over parts of the cut's depth, each taken in its middle, and is the mean at two Gauss
/// points of a part of the depth to either side. Nearer to the other cut than its depth it is as so far from
/// it: next to a wall the tissue is free of shear, but the strip between the walls sinks as a whole. Along
/// the other cut it is a difference over that part: next to its front, derivatives of a field jump.
constexpr int layers = 6;
constexpr double reach = 0.5;
const double gauss = 1 / std::numbers::sqrt3;

/// By how much further than the bottom of a cut there another cut's field moves the skin along `n`, mm: as
/// the shear of the tissue tells it, with which the sides of the cut turn up and down. It changes its sign
/// where cuts cross, but not where one opens into the other (`branch`: where it does).
double shear_across(const Wound& other, const ActiveVertex& at, const Vec3& n, double blade,
                    const IncisionVolume::Mouth* branch) {
  const CanonicalCut& cut = other.field.shape().cut();
  const Side side = !branch ? at.side : branch->right ? Side::right : Side::left;
  const double t = at.time_at(blade, cut.length);
  double a = dot(n, at.along), b = dot(n, normalized(at.across));
  const double length = std::hypot(a, b);
  if (length < turned_away) return 0;
  a /= length, b /= length;
  const auto shear = [&](double v, double w) {
    const Derivatives d = other.field.derivatives({at.uvw.x, v, w}, side, t, at.s);
    const double from = at.uvw.x - reach * cut.depth, to = at.uvw.x + reach * cut.depth;
    const double rises = (other.field.displacement({to, v, w}, side, t, at.s).z -
                          other.field.displacement({from, v, w}, side, t, at.s).z) /
                         (to - from);
    return at.weight * (a * (d.by_w.x + rises) + b * (d.by_w.y + d.by_v.z));
  };
  const double beside = std::max(std::abs(at.uvw.y), cut.depth);
  double sum = 0;
  for (const double distance : {beside - gauss * reach * cut.depth, beside + gauss * reach * cut.depth}) {
    const double v = side == Side::both   ? std::copysign(distance, at.uvw.y)
                     : side == Side::left ? -distance
                                          : distance;
    for (int i = 0; i < layers; ++i)
      sum += cut.depth / layers * shear(v, -cut.depth * (i + 0.5) / layers) / 2;
  }
  return branch ? sum : sum * std::min(1., std::abs(at.uvw.y) / (lean_fades * cut.depth));
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

/// The place of another cut, nearest to lips of one that opens into it at `s`, mm: the other cut opens
/// differently before and behind there, and all of these lips are in the skin on one side.
double on_side_of(const Wound& branch, double s, const Wound& other) {
  for (const bool at_end : {false, true}) {
    const std::optional<double> mouth = other.mouth_of(branch, at_end);
    const double depth = other.field.shape().cut().depth;
    if (!mouth || std::abs(s - *mouth) > depth) continue;
    const Vec3& along = branch.volume.skin_frame((at_end ? branch.complete() : 0) / branch.scale()).along;
    const double way = dot(along, other.volume.skin_frame(*mouth / other.scale()).along);
    return *mouth +
           std::copysign(std::max(std::abs(s - *mouth), Crossing::corners_apart), at_end ? -way : way);
  }
  return s;
}

/// How many times as far lips lean at a place beside another cut as further away from it.
double more_beside(const Wound& other, const ActiveVertex& at) {
  const double depth = other.depth(at.s), depths = std::abs(at.uvw.y) / depth;
  const double more = std::max(0., more_leaning * (other.skin_thickness() / depth - least_thickness));
  return 1 +
         more * std::clamp((leans_as_others_from - depths) / (leans_as_others_from - leans_more_to), 0., 1.);
}

/// Whether they open into the same earlier cut from either side: its walls pass no shear from one to the
/// other.
bool on_both_sides_of_a_cut(const Wound& one, const Wound& other) {
  for (const bool end_of_one : {false, true})
    for (const bool end_of_other : {false, true}) {
      const auto &a = one.volume.mouth(end_of_one), &b = other.volume.mouth(end_of_other);
      if (a && b && a->earlier == b->earlier && a->right != b->right) return true;
    }
  return false;
}

}  // namespace

ShearLean::ShearLean(const std::vector<const Wound*>& cuts) : cuts_(cuts), stations_(cuts.size(), 0) {}

void ShearLean::add(const Lips& lips) {
  const Wound& cut = *cuts_[lips.cut];
  stations_[lips.cut] = std::max(stations_[lips.cut], lips.station + 1);
  const double leans = leaning_at(lips.s, cut, lips.opening);
  const Vec3 normal = cut.volume.skin_frame(lips.s / cut.scale()).across;
  for (std::size_t j = 0; j < cuts_.size(); ++j) {
    const Wound& other = *cuts_[j];
    if (j == lips.cut || on_both_sides_of_a_cut(cut, other)) continue;
    const auto add = [&](int lip, double part) {
      const std::optional<ActiveVertex> at = other.volume.locate(lip);
      if (!at || part == 0) return;
      const bool complete = j + 1 < cuts_.size();
      const IncisionVolume::Mouth* branch = cut.mouth_in(other);
      const double s = branch ? on_side_of(cut, at->s, other) : at->s;
      places_.push_back({lips.cut, j, lips.station, s, part * leans * more_beside(other, *at),
                         complete ? shear_across(other, *at, normal, other.complete(), branch) : 0, *at,
                         normal, branch});
    };
    if (const IncisionVolume::Mouth* mouth = other.mouth_in(cut)) {
      const double beside = beside_branch(cut, lips.s, other);
      add(mouth->right ? lips.right : lips.left, beside);
      add(mouth->right ? lips.left : lips.right, 1 - beside);
    } else {
      add(lips.left, 1);
    }
  }
}

ShearLean::Leans ShearLean::leans(double blade, const std::vector<Amplitude>& in_membrane) const {
  Leans result(cuts_.size());
  for (std::size_t i = 0; i < cuts_.size(); ++i) {
    result[i].resize(cuts_.size());
    for (std::size_t j = 0; j < cuts_.size(); ++j)
      if (j != i) result[i][j].assign(stations_[i], 0);
  }
  for (const Place& place : places_) {
    const double shear = place.by + 1 < cuts_.size()
                             ? place.shear
                             : shear_across(*cuts_[place.by], place.at, place.normal, blade, place.branch);
    double& lean = result[place.cut][place.by][place.station];
    lean += place.leaning * shear * std::min(most_opening, in_membrane[place.by].at(place.s));
    lean = std::clamp(lean, -most_lean, most_lean);
  }
  return result;
}

}  // namespace cleft
