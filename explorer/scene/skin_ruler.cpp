#include "explorer/scene/skin_ruler.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/error.h"
#include "base/nearest_weights.h"
#include "base/text.h"

namespace cleft {

Measures measures_of(std::vector<Vec3> places) {
  Measures m;
  for (std::size_t i = 1; i < places.size(); ++i) m.distances.push_back(norm(places[i] - places[i - 1]));
  if (places.size() == 3) {
    const Vec3 a = places[0] - places[1], b = places[2] - places[1];
    m.angle = std::atan2(norm(cross(a, b)), dot(a, b)) * 180 / std::numbers::pi;
  }
  if (places.size() >= 3) {
    Vec3 sum;
    for (std::size_t i = 2; i < places.size(); ++i)
      sum += cross(places[i - 1] - places[0], places[i] - places[0]);
    m.area = 0.5 * norm(sum);
  }
  m.places = std::move(places);
  return m;
}

std::string told(const Measures& now, const Measures& rest) {
  std::string text;
  for (std::size_t i = 0; i < now.distances.size(); ++i)
    text += (i == 0 ? "" : ", ") + formatted(i == 0 ? "%.2f mm (at rest %.2f)" : "%.2f mm (%.2f)",
                                             now.distances[i], rest.distances[i]);
  if (now.angle) text += formatted("; angle %.1f degrees (%.1f)", *now.angle, *rest.angle);
  if (now.area) text += formatted("; area %.4g mm2 (%.4g)", *now.area, *rest.area);
  return text;
}

SkinRuler::SkinRuler(std::shared_ptr<const WoundScene> scene, std::vector<Vec3> places)
    : scene_(std::move(scene)), asked_(std::move(places)) {
  const WoundSurface& surface = scene_->surface();
  for (const Vec3& place : asked_) {
    double least = std::numeric_limits<double>::infinity();
    Attachment nearest{};
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
      if (surface.regions[t] != Region::skin) continue;
      const auto& corners = surface.triangles[t];
      const auto at = [&](std::size_t i) { return surface.points[corners[i]]; };
      const std::array<double, 3> weights = nearest_weights(place, at(0), at(1), at(2));
      const double squared =
          squared_norm(weights[0] * at(0) + weights[1] * at(1) + weights[2] * at(2) - place);
      if (squared < least) least = squared, nearest = {corners, weights};
    }
    if (!(least <= farthest * farthest))
      throw InputError(
          formatted("the skin is %.3g mm away from %g,%g,%g", std::sqrt(least), place.x, place.y, place.z));
    attachments_.push_back(nearest);
  }
}

Measures SkinRuler::of(const std::vector<Vec3>& points) const {
  std::vector<Vec3> places;
  for (const auto& [corners, weights] : attachments_)
    places.push_back(weights[0] * points[corners[0]] + weights[1] * points[corners[1]] +
                     weights[2] * points[corners[2]]);
  return measures_of(std::move(places));
}

Measures SkinRuler::at(double t) const {
  std::vector<Vec3> points;
  scene_->positions(t, points);
  return of(points);
}

Measures SkinRuler::at_rest() const { return of(scene_->surface().points); }

}  // namespace cleft
