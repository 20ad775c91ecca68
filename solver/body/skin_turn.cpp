#include "solver/body/skin_turn.h"

#include <algorithm>
#include <cmath>

namespace cleft {

namespace {

constexpr double beside_in_depths = 1.5;

/// The nodes of the skin where cuts part it.
std::vector<Vec3> parted_places(const Body& body) {
  std::vector<Vec3> places;
  for (const BodyPair& pair : body.pairs)
    if (body.skin_above[pair.left] == pair.left) places.push_back(body.points[pair.left]);
  return places;
}

}  // namespace

Turn most_turned_skin(const Body& body, const std::vector<Vec3>& displacement) {
  const std::vector<Vec3> parted = parted_places(body);
  const double beside = beside_in_depths * body.depth;
  const auto is_beside_a_cut = [&](const Vec3& x) {
    return std::ranges::any_of(parted, [&](const Vec3& place) { return norm(x - place) < beside; });
  };
  Turn most;
  for (const auto& [a, b, c] : body.skin) {
    const auto& p = body.points;
    const auto& d = displacement;
    const Vec3 rest = cross(p[b] - p[a], p[c] - p[a]);
    const Vec3 now = cross(p[b] + d[b] - p[a] - d[a], p[c] + d[c] - p[a] - d[a]);
    const double angle = std::atan2(norm(cross(rest, now)), dot(rest, now));
    if (angle > most.angle && !is_beside_a_cut(1. / 3 * (p[a] + p[b] + p[c]))) most = {angle, p[a]};
  }
  return most;
}

double turning_share(double angle) {
  return std::clamp((angle - much_turn) / (most_turn - much_turn), 0., 1.);
}

bool lacks_stiffness_of_tension(const Parameters& p) {
  const Prestress& s = p.skin.prestress;
  return p.model == Model::small && !is_stiffened_by_prestress(p) && std::min(s.uu, s.vv) >= 0 &&
         s.uu * s.vv >= s.uv * s.uv;
}

}  // namespace cleft
