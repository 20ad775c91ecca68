#include "explorer/cut_volume.h"

#include <algorithm>
#include <cmath>

namespace cleft {

namespace {

void split(VolumeMesh& volume, const SurfaceMesh& surface, const Incision& cut) {
  const std::vector<Vec3> points = volume.points();
  const std::vector<VolumeMesh::Nearest> nearest = volume.nearest(surface);
  const auto& labels = cut.surroundings().labels();
  std::vector<PathCoordinates> at;
  std::vector<double> beside;
  for (const Vec3& p : points) {
    at.push_back(cut.path().coordinates(p));
    // The blade's surface goes exactly through points that are on it but for rounding.
    beside.push_back(std::abs(at.back().v) <= 1e-9 * cut.path().length() ? 0 : at.back().v);
  }
  volume.split(beside, [&](const std::vector<int>& corners) {
    // Where the blade's surface passes the cell, on average over the edges that it cuts.
    double s = 0, depth = 0, weight = 0, size = 0;
    for (const int i : corners)
      for (const int j : corners) {
        const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
        size = std::max(size, norm(points[a] - points[b]));
        if (!(beside[a] < 0 && beside[b] > 0)) continue;
        const double part = beside[a] / (beside[a] - beside[b]);
        s += (1 - part) * at[a].s + part * at[b].s;
        depth += (1 - part) * nearest[a].distance + part * nearest[b].distance;
        weight += 1;
      }
    s /= weight, depth /= weight;
    const bool near = std::all_of(corners.begin(), corners.end(), [&](int i) {
      return std::abs(beside[static_cast<std::size_t>(i)]) <= size;
    });
    const bool reached = std::any_of(corners.begin(), corners.end(), [&](int i) {
      const auto v = static_cast<std::size_t>(nearest[static_cast<std::size_t>(i)].vertex);
      return labels.empty() || labels[v].reached;
    });
    return near && reached && s > cut.start() && s < cut.tip() && depth < cut.path().depth(s);
  });
}

}  // namespace

int write_cut_volume(VolumeMesh& volume, const SurfaceMesh& surface, const std::vector<const Incision*>& cuts,
                     const Wounds* wounds, double scale, double t, const std::string& out) {
  const int before = volume.cells();
  for (const Incision* cut : cuts) split(volume, surface, *cut);
  std::vector<std::vector<int>> parts;
  for (std::size_t k = 0; k < cuts.size(); ++k) parts.push_back(volume.parts(static_cast<int>(k)));
  const std::vector<Vec3> rest = volume.points();
  const std::vector<VolumeMesh::Nearest> nearest = volume.nearest(surface);
  std::vector<Vec3> moved = rest;
  PointArray displacement{"displacement", 3, {}}, depth{"depth", 1, {}};
  for (std::size_t i = 0; i < rest.size(); ++i) {
    std::vector<Side> sides;
    for (const auto& part : parts) sides.push_back(side_of(part[i]));
    Vec3 d;
    if (wounds)
      d = wounds->displacement_below(rest[i], nearest[i].distance * scale, nearest[i].vertex, sides, t);
    moved[i] += d;
    displacement.values.insert(displacement.values.end(), {d.x, d.y, d.z});
    depth.values.push_back(nearest[i].distance * scale);
  }
  volume.write(out, moved, {displacement, depth});
  return volume.cells() - before;
}

}  // namespace cleft
