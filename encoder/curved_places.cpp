#include "encoder/curved_places.h"

#include <cmath>

namespace cleft {

std::vector<Vec3> further_places(const CutCurve& cut, const Vec3& place) {
  constexpr double same = 1e-6;  // mm
  const CutCurve::Place foot = cut(place.x);
  std::vector<Vec3> places;
  for (const auto& [u, v] :
       cut.feet(foot.x - place.y * std::sin(foot.direction), foot.y + place.y * std::cos(foot.direction)))
    if (v * place.y > 0 && std::abs(v) > std::abs(place.y) + same) places.push_back({u, v, place.z});
  return places;
}

}  // namespace cleft
