#include "explorer/scalpel/hand_script.h"

#include <algorithm>
#include <cmath>

namespace cleft {

ScalpelPose pose_over(const ScalpelPath& path, double scale, double s, double height) {
  const PathFrame frame = path.at(s);
  ScalpelPose pose;
  pose.tip = scale * frame.position + height * frame.outward;
  pose.axis = frame.outward;
  pose.edge = frame.along;
  return pose;
}

ScalpelPose pose_above(const SurfaceMesh& mesh, double scale) {
  Vec3 low = mesh.points.front(), high = low;
  for (const Vec3& p : mesh.points)
    for (int k = 0; k < 3; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
  ScalpelPose pose;
  pose.tip = scale * Vec3{(low.x + high.x) / 2, (low.y + high.y) / 2, high.z} + Vec3{0, 0, 10};
  return pose;
}

std::vector<HandTarget> hand_along(const ScalpelPath& path, double scale, double speed,
                                   const HandParameters& hand, const ForceParameters& force) {
  std::vector<HandTarget> script;
  double time = 0;
  const auto go = [&](double seconds, double s, double height, bool press = false) {
    time += seconds;
    script.push_back({time, pose_over(path, scale, s, height), press});
  };
  // The grip and the skin yield until the skin holds no longer; then the hand has pressed enough.
  const double felt = std::min(force.stiffness, hand.limits.max_stiffness);
  const double through = 1.2 * force.puncture_force * (1 / hand.stiffness + 1 / felt) + 1;
  go(0, 0, 10);
  go(10 / 40., 0, 1);
  go(through / 40, 0, -through, true);
  go(0.2, 0, -through, true);
  go(0.2, 0, -scale * path.depth(0));
  const int pieces = std::max(1, static_cast<int>(std::ceil(path.length() * scale)));
  for (int k = 1; k <= pieces; ++k) {
    const double s = path.length() * k / pieces;
    go(path.length() * scale / pieces / speed, s, -scale * path.depth(s));
  }
  go(0.3, path.length(), 15);
  go(0.2, path.length(), 15);
  return script;
}

}  // namespace cleft
