#include "encoder/curved_places.h"

#include <cmath>
#include <numbers>

#include "params/meshed_cut.h"

namespace cleft {

std::vector<Vec3> further_places(const Parameters& parameters, const Vec3& place) {
  const double curvature = parameters.cut.curvature;
  if (curvature == 0 || !(place.y * curvature > 0)) return {};
  const double radius = 1 / std::abs(curvature), sign = curvature < 0 ? -1 : 1;
  const double half = meshed_cut(parameters).length / 2, widest = half / radius;

  // In the plane, with the cut's middle at the origin and its circle's centre at (0, radius).
  const double inside = std::fmin(std::fmax(place.x, -half), half), beyond = place.x - inside;
  const double turn = inside / radius, c = std::cos(turn), s = std::sin(turn), across = sign * place.y;
  const double x = radius * s + beyond * c - across * s, y = radius * (1 - c) + beyond * s + across * c;

  std::vector<Vec3> places;
  const auto add = [&](double u, double distance) {
    constexpr double same = 1e-6;  // mm
    if (distance > across + same) places.push_back({u, sign * distance, place.z});
  };
  const double angle = std::atan2(x, radius - y), from_centre = std::hypot(x, radius - y);
  if (std::abs(angle) <= widest) add(radius * angle, radius - from_centre);
  const double opposite = angle - std::copysign(std::numbers::pi, angle);
  if (std::abs(opposite) <= widest) add(radius * opposite, radius + from_centre);
  const double c_end = std::cos(widest), s_end = std::sin(widest);
  for (const double side : {1., -1.}) {
    const double from_end = side * x - radius * s_end, up = y - radius * (1 - c_end);
    const double along = c_end * from_end + s_end * up;
    if (along > 0) add(side * (half + along), c_end * up - s_end * from_end);
  }
  return places;
}

}  // namespace cleft
