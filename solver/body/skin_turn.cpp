#include "solver/body/skin_turn.h"

#include <algorithm>
#include <cmath>

namespace cleft {

Turn most_turned_skin(const Body& body, const std::vector<Vec3>& displacement) {
  Turn most;
  for (const auto& [a, b, c] : body.skin) {
    const auto& p = body.points;
    const auto& d = displacement;
    const Vec3 rest = cross(p[b] - p[a], p[c] - p[a]);
    const Vec3 now = cross(p[b] + d[b] - p[a] - d[a], p[c] + d[c] - p[a] - d[a]);
    const double angle = std::atan2(norm(cross(rest, now)), dot(rest, now));
    if (angle > most.angle) most = {angle, p[a]};
  }
  return most;
}

double turning_share(double angle) { return std::clamp(10 * (angle - much_turn), 0., 1.); }

bool lacks_stiffness_of_tension(const Parameters& p) {
  const Prestress& s = p.skin.prestress;
  return p.model == Model::small && !is_stiffened_by_prestress(p) && std::min(s.uu, s.vv) >= 0 &&
         s.uu * s.vv >= s.uv * s.uv;
}

}  // namespace cleft
