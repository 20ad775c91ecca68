#include "explorer/wound/opening_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/stations.h"
#include "base/text.h"
#include "explorer/wound/path_shape.h"

namespace cleft {

namespace {

// Factors of the laws, for errors over the largest opening (tests/truth/bodies.md).
constexpr double of_fit = 0.02;           // a straight flat cut
constexpr double of_bend = 7.2;           // mm: times the curvature, where the tension does not turn
constexpr double of_bend_turned = 25;     // mm^2: times its square, where it does
constexpr double of_tilt = 0.07;          // at 45 degrees, with the square of the tilt
constexpr double of_tilt_family = 0.035;  // likewise
/// mm, times the path's curvature, and mm^2, times those of path and skin: of a tilt of 45 degrees, with its
/// square, in a family, which knows each two of these together at most.
constexpr double of_tilted_bend = 1.4, of_tilted_bend_in_curved_skin = 75;
/// mm, times the path's curvature, in a family: of a tension that is larger than the mean across the path, by
/// that over the mean; and mm^2, times the curvatures of path and skin.
constexpr double of_bend_along_tension = 0.55, of_bend_in_curved_skin = 20;
/// At most so many times the mean across: beyond, hardly anything opens.
constexpr double most_along = 4;
constexpr double of_shallow = 0.27, of_deep = 0.16;  // times the logarithm of depth over the canonical one
constexpr double of_skin_across = 5, of_skin_along = 1.7, of_twist = 3;  // mm: times the skin's curvatures
constexpr double of_uneven = 1;    // of the skin: its distance from a quadric, in depths of the cut
constexpr double of_length = 0.1;  // times the part of the path beyond the canonical cut
/// Of the error by the length, where the tension is that with which the whole path opens (path_opening.h).
constexpr double of_length_turned = 0.4;
constexpr double of_neighbour = 0.05, neighbour_reach = 20;  // falls by e over so many mm
constexpr double of_nearest = 0.08;                          // of one that is nearer than cuts are deep
/// Where it meets a cut and the tension does not turn. Otherwise where the cut that it meets is pulled alike
/// along and across; up to a third as hard along as across none, from 13/9 on 5/3 of it.
constexpr double of_junction = 0.6, of_junction_turned = 0.3, pulled_enough = 1. / 3, most_pulled = 5. / 3;
/// Likewise of a cut that it opens into.
constexpr double of_mouth = 0.05;
constexpr double of_winding = 0.6;    // mm: times the curvature's difference from that which opens it
constexpr double of_direction = 0.1;  // a radian: between the path and the direction that opens it
constexpr double of_loop = 3.3;       // of these two, where the path ends so near to its start, in depths:
constexpr double ends_apart = 2;
constexpr double of_outside = 0.1;  // half a range beyond the family
/// Of bone: at 5 mm, with a power of how much nearer it is than where it does not count.
constexpr double of_bone = 0.15, near_bone = 5, far_bone = 12, bone_power = 1.75;

constexpr double degrees_45 = 45;
/// Of a cut that lies otherwise than the first, whose tension does not turn: in proportion to the sine of the
/// angle between them, up to this.
constexpr double of_turned = 0.6, of_sine = 0.96;
/// mm: noise of paths is smoothed over so much, and of skin over so many depths of the cut.
constexpr double smoothing_of_path = 8, smoothing_of_skin = 8. / 3;

struct Part {
  double error;
  const char* cause;  // # stands for the figure
  double figure = 0;
};

std::string told(const Part& part) {
  std::string text = part.cause;
  if (const std::size_t at = text.find('#'); at != std::string::npos)
    text.replace(at, 1, shortest(std::round(10 * part.figure) / 10));
  return text;
}

double square(double x) { return x * x; }

/// Of a field that does not know the bone below.
double error_over_bone(double tissue) {
  const double nearer = std::max(0., far_bone - tissue) / (far_bone - near_bone);
  return of_bone * std::pow(nearer, bone_power);
}

/// By the angle in radians between the path and the direction along which a family opens it.
double astray(const Wound& cut, double s) {
  const PathFrame frame = cut.incision->path().at(s / cut.scale());
  const Vec3 own = frame.along, opened = *cut.field.along(s);
  return std::acos(std::clamp(dot(own, opened), -1., 1.));
}

using Parts = std::vector<Part>;

/// `as_path`: the tension is that with which the whole path opens.
Parts parts_of_whole(double length, const CanonicalCut& canonical, bool known, bool as_path,
                     const Neighbourhood& n) {
  const double beyond = std::max(0., 1 - canonical.length / length);
  Parts parts = {
      {std::max(of_fit, n.field),
       n.between ? "the field lies between the cases of a study" : "that is the error of the field's fit"},
      {(as_path ? of_length_turned : 1) * std::min(1., std::max(of_length, n.length_defect)) * beyond,
       "the path of # mm is longer than the field's cut", length},
      {(n.nearest_cut < canonical.depth ? of_nearest : of_neighbour) *
           std::exp(-n.nearest_cut / neighbour_reach),
       "another cut is # mm beside it", n.nearest_cut},
      {n.held_back, "the skin would turn over or pass through itself, and is held back"}};
  if (!known && n.turned > 0)
    parts.push_back(
        {std::min(of_turned, of_sine * std::sin(n.turned)),
         "it lies # degrees from the direction of the first cut, and the tension does not turn with it",
         n.turned * 180 / std::numbers::pi});
  const auto pulled = [](double tension) {
    return std::min(most_pulled, (tension - pulled_enough) / (1 - pulled_enough));
  };
  if (known && n.mouth_tension > pulled_enough)
    parts.push_back({of_mouth * pulled(n.mouth_tension),
                     "it opens into another cut, along which the skin is pulled # times as hard as across it",
                     n.mouth_tension});
  if (n.junction_tension > 0 && !known)
    parts.push_back({of_junction, "it meets another cut, and the tension does not turn with it"});
  else if (n.junction_tension > pulled_enough)
    parts.push_back({of_junction_turned * pulled(n.junction_tension),
                     "it meets another cut, along which the skin is pulled # times as hard as across it",
                     n.junction_tension});
  return parts;
}

/// The larger tension of the skin anywhere along the path over the mean across it.
double tension_ratio(const Wound& cut) {
  constexpr int pieces = 32;
  double larger = 0, across = 0;
  for (int i = 0; i < pieces; ++i) {
    const double s = cut.complete() * (i + 0.5) / pieces;
    const double uu = cut.field.prestress(&Prestress::uu, s), vv = cut.field.prestress(&Prestress::vv, s),
                 uv = cut.field.prestress(&Prestress::uv, s);
    larger = std::max(larger, (uu + vv) / 2 + std::hypot((uu - vv) / 2, uv)), across += vv / pieces;
  }
  return across > 0 ? std::min(most_along, larger / across) : larger > 0 ? most_along : 1;
}

/// `whole` is the shape over half the canonical cut, `pulled` the tension_ratio().
Parts parts_at(double s, const LocalShape& local, const LocalShape& whole, double pulled, const Wound& cut,
               bool known, bool loop) {
  const CanonicalCut& canonical = cut.field.shape().cut();
  const double in_cuts = canonical.length / 30, radius = 1 / std::abs(local.curvature);
  Parts parts;
  const double skin = std::max(std::abs(local.skin_u), std::abs(local.skin_v));
  if (cut.followed.bend) {
    parts.push_back({(loop ? of_loop : 1) * (of_winding * std::abs(local.curvature - whole.curvature) +
                                             of_direction * astray(cut, s)),
                     "the path winds"});
    parts.push_back({of_bend_along_tension * (pulled - 1) * std::abs(local.curvature),
                     "the path bends, and the skin's larger tension is # times that across it", pulled});
    parts.push_back({of_bend_in_curved_skin * skin * std::abs(local.curvature),
                     "the path bends with a radius of # mm in curved skin", radius});
  } else if (known)
    parts.push_back(
        {of_bend_turned * square(local.curvature * in_cuts), "the path bends with a radius of # mm", radius});
  else
    parts.push_back({of_bend * std::abs(local.curvature) * in_cuts,
                     "the path bends with a radius of # mm, and the tension does not turn with it", radius});
  parts.push_back({(cut.followed.tilt ? of_tilt_family : of_tilt) * square(local.tilt / degrees_45),
                   "the blade is tilted by # degrees", local.tilt});
  if (cut.followed.tilt && cut.followed.bend)
    parts.push_back({(of_tilted_bend + of_tilted_bend_in_curved_skin * skin) * std::abs(local.curvature) *
                         square(local.tilt / degrees_45),
                     "the path bends, and the blade is tilted by # degrees", local.tilt});
  if (!cut.followed.depth) {
    const double deeper = std::log(std::max(local.depth, 1e-3) / canonical.depth);
    parts.push_back({std::max(-of_shallow * deeper, of_deep * deeper),
                     "its depth of # mm is not that of the field's cut", local.depth});
  }
  const double along_and_across =
                   cut.followed.skin ? 0 : of_skin_across * local.skin_v + of_skin_along * local.skin_u,
               twist = cut.followed.twist ? 0 : of_twist * local.skin_uv;
  parts.push_back({(std::abs(along_and_across) + std::abs(twist)) * in_cuts, "the skin is curved"});
  parts.push_back({of_uneven * local.skin_uneven / canonical.depth,
                   "the skin is uneven: # mm from smoothly curved", local.skin_uneven});
  parts.push_back({of_outside * cut.field.outside(s), "its shape is beyond those of the family"});
  return parts;
}

}  // namespace

double OpeningError::value_at(double s) const {
  const auto [a, b, part] = between(stations, s);
  return (1 - part) * values[a] + part * values[b];
}

OpeningError opening_error_of(const Wound& cut, bool known, const Neighbourhood& neighbourhood) {
  const Field& field = cut.field.shape();
  const CanonicalCut& canonical = field.cut();
  const double skin_smoothing = smoothing_of_skin * canonical.depth;
  const PathShape shape = shape_along(*cut.incision, cut.scale(), {smoothing_of_path, skin_smoothing});
  const PathShape whole =
      cut.followed.bend ? shape_along(*cut.incision, cut.scale(), {canonical.length / 2, skin_smoothing})
                        : shape;
  const ScalpelPath& path = cut.incision->path();
  const double chord = norm(path.at(path.length()).position - path.at(0).position) * cut.scale();
  const bool loop = chord < ends_apart * canonical.depth;
  const bool as_path = !loop && (cut.field.follows_shape() || cut.field.typical().size() > 1);
  const double pulled = cut.followed.bend ? tension_ratio(cut) : 1;
  const Parts of_whole = parts_of_whole(shape.stations.back(), canonical, known, as_path, neighbourhood);
  OpeningError result;
  for (std::size_t i = 0; i < shape.stations.size(); ++i) {
    const LocalShape& local = shape.values[i];
    const double s = shape.stations[i];
    Parts parts = parts_at(s, local, whole.at(s), pulled, cut, known, loop);
    parts.insert(parts.begin(), of_whole.begin(), of_whole.end());
    if (cut.tissue && !cut.followed.bone) {
      const Vec3 place = cut.scale() * cut.incision->path().at(s / cut.scale()).position;
      const double most = field.parameters.value_or(field.parameters->patch.height, far_bone);
      const double tissue = mean_tissue(cut.tissue, place, local, skin_smoothing, most);
      parts.push_back(
          {error_over_bone(tissue), "there is bone # mm below, which the field does not know", tissue});
    }
    double sum = 0;
    const Part* greatest = &parts.front();
    for (const Part& part : parts) {
      sum += square(part.error);
      if (part.error > greatest->error) greatest = &part;
    }
    const double error = std::sqrt(sum);
    result.stations.push_back(s), result.values.push_back(error);
    if (error > result.largest) result.largest = error, result.at = s, result.cause = told(*greatest);
  }
  return result;
}

}  // namespace cleft
