#include "explorer/wound/opening_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "explorer/wound/path_shape.h"

namespace cleft {

namespace {

// Factors of the laws, for errors over the largest opening (tests/truth/bodies.md).
constexpr double of_fit = 0.02;          // a straight flat cut
constexpr double of_bend = 7.2;          // mm: times the curvature, where the tension does not turn
constexpr double of_bend_turned = 25;    // mm^2: times its square, where it does
constexpr double of_tilt = 0.15;         // at 45 degrees, with the square of the tilt
constexpr double of_tilt_family = 0.08;  // likewise
constexpr double of_shallow = 0.27, of_deep = 0.16;  // times the logarithm of depth over the canonical one
constexpr double of_skin_across = 5, of_skin_along = 1.7, of_twist = 3;  // mm: times the skin's curvatures
constexpr double of_length = 0.1;  // times the part of the path beyond the canonical cut
constexpr double of_neighbour = 0.25, neighbour_reach = 20;  // falls by e over so many mm
constexpr double of_junction = 0.6;
constexpr double of_winding = 2;      // mm: times the curvature's difference from that which opens it
constexpr double of_direction = 0.3;  // a radian: between the path and the direction that opens it
constexpr double of_outside = 0.1;    // half a range beyond the family
/// Of bone: at 5 mm, with a power of how much nearer it is than where it does not count.
constexpr double of_bone = 0.15, near_bone = 5, far_bone = 12, bone_power = 1.75;

constexpr double degrees_45 = 45;
/// mm: noise of paths is smoothed over so much, and of skin over so many depths of the cut.
constexpr double smoothing_of_path = 8, smoothing_of_skin = 8. / 3;

struct Part {
  double error;
  const char* cause;
};

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

}  // namespace

OpeningError opening_error_of(const Wound& cut, bool known, const Neighbourhood& neighbourhood) {
  const Field& field = cut.field.shape();
  const CanonicalCut& canonical = field.cut();
  const bool family = cut.field.follows_shape();
  const PathShape shape =
      shape_along(*cut.incision, cut.scale(), {smoothing_of_path, smoothing_of_skin * canonical.depth});
  const PathShape whole = family ? shape_along(*cut.incision, cut.scale(),
                                               {canonical.length / 2, smoothing_of_skin * canonical.depth})
                                 : PathShape{};
  const double length = cut.incision->path().length() * cut.scale();
  OpeningError result;
  for (std::size_t i = 0; i < shape.stations.size(); ++i) {
    const LocalShape& local = shape.values[i];
    const double s = shape.stations[i], in_cuts = canonical.length / 30;
    std::vector<Part> parts = {
        {of_fit, "that is the error of the field's fit"},
        {length > canonical.length ? of_length * (1 - canonical.length / length) : 0,
         "the path is longer than the field's cut"},
        {of_neighbour * std::exp(-neighbourhood.nearest_cut / neighbour_reach), "another cut is next to it"},
        {neighbourhood.held_back, "the skin would turn over"},
        {neighbourhood.unknown_junction ? of_junction : 0,
         "it meets another cut in a tension that does not turn with it"}};
    if (family) {
      parts.push_back({of_tilt_family * square(local.tilt / degrees_45), "the blade is tilted"});
      const double apart = std::abs(local.curvature - whole.at(s).curvature);
      parts.push_back({of_winding * apart + of_direction * astray(cut, s), "the path winds"});
      parts.push_back({of_outside * cut.field.outside(s), "its shape is beyond those of the family"});
    } else {
      parts.push_back({known ? of_bend_turned * square(local.curvature) * in_cuts * in_cuts
                             : of_bend * std::abs(local.curvature) * in_cuts,
                       known ? "the path bends" : "the path bends, and the tension does not turn with it"});
      parts.push_back({of_tilt * square(local.tilt / degrees_45), "the blade is tilted"});
      const double deeper = std::log(std::max(local.depth, 1e-3) / canonical.depth);
      parts.push_back({std::max(-of_shallow * deeper, of_deep * deeper), "its depth is not the field's"});
      parts.push_back({(std::abs(of_skin_across * local.skin_v + of_skin_along * local.skin_u) +
                        of_twist * std::abs(local.skin_uv)) *
                           in_cuts,
                       "the skin is curved"});
    }
    if (cut.tissue && !cut.follows_bone) {
      const Vec3 place = cut.scale() * cut.incision->path().at(s / cut.scale()).position;
      const double whole = field.parameters.value_or(field.parameters->patch.height, far_bone);
      parts.push_back(
          {error_over_bone(mean_tissue(cut.tissue, place, local, smoothing_of_skin * canonical.depth, whole)),
           "there is bone below, which the field does not know"});
    }
    double sum = 0;
    const Part* greatest = &parts.front();
    for (const Part& part : parts) {
      sum += square(part.error);
      if (part.error > greatest->error) greatest = &part;
    }
    const double error = std::sqrt(sum);
    result.stations.push_back(s), result.values.push_back(error);
    if (error > result.largest) result.largest = error, result.at = s, result.cause = greatest->cause;
  }
  return result;
}

}  // namespace cleft
