#include "explorer/commands/cut_volume.h"

#include <algorithm>
#include <cmath>

namespace cleft {

namespace {

/// How the points of a volume lie beside a cut's path.
struct Beside {
  std::vector<Vec3> points;
  std::vector<VolumeMesh::Nearest> nearest;
  std::vector<PathCoordinates> at;
  std::vector<double> v;

  Beside(const VolumeMesh& volume, const SurfaceMesh& surface, const Incision& cut)
      : points(volume.points()), nearest(volume.nearest(surface)) {
    for (const Vec3& p : points) {
      at.push_back(cut.path().coordinates(p));
      // The blade's surface goes exactly through points that are on it but for rounding.
      v.push_back(std::abs(at.back().v) <= 1e-9 * cut.path().length() ? 0 : at.back().v);
    }
  }

  /// Whether the blade's surface, or what goes on from it, passes a cell: not only one far beside the path,
  /// or below another side of the mesh.
  bool passes(const std::vector<int>& corners, const Incision& cut) const {
    const auto& labels = cut.surroundings().labels();
    double size = 0, low = 0, high = 0;
    bool reached = labels.empty();
    for (const int i : corners) {
      const std::size_t a = i;
      const double below = height(cut, at[a].s) - at[a].w;
      if (below > 1.5 * std::max(cut.path().depth(at[a].s), nearest[a].distance)) return false;
      for (const int j : corners) size = std::max(size, norm(points[a] - points[j]));
      low = std::min(low, v[a]), high = std::max(high, v[a]);
      reached = reached || labels[nearest[a].vertex].reached;
    }
    return reached && low < 0 && high > 0 && std::max(-low, high) <= size;
  }

  /// Of the skin over C(s).
  static double height(const Incision& cut, double s) {
    const auto& stations = cut.surroundings().stations();
    if (stations.empty()) return 0;
    const auto next = std::lower_bound(stations.begin(), stations.end(), s,
                                       [](const auto& station, double x) { return station.s < x; });
    return next == stations.end() ? stations.back().height : next->height;
  }

  /// Where the blade's surface passes a cell that it parts, on average over the edges that it cuts.
  struct Middle {
    double s = 0, depth = 0;
  };
  Middle middle(const std::vector<int>& corners) const {
    Middle sum;
    double weight = 0;
    for (const int i : corners)
      for (const int j : corners) {
        const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
        if (!(v[a] < 0 && v[b] > 0)) continue;
        const double part = v[a] / (v[a] - v[b]);
        sum.s += (1 - part) * at[a].s + part * at[b].s;
        sum.depth += (1 - part) * nearest[a].distance + part * nearest[b].distance;
        weight += 1;
      }
    return {sum.s / weight, sum.depth / weight};
  }
};

/// Parts the cells in which the cut begins or ends, along the path or in depth, so that none is half cut.
void slice_at_ends(VolumeMesh& volume, const SurfaceMesh& surface, const Incision& cut) {
  const auto slice = [&](const auto& value, const auto& where) {
    const Beside beside(volume, surface, cut);
    std::vector<double> values;
    for (std::size_t i = 0; i < beside.points.size(); ++i) {
      const double x = value(beside, i);
      values.push_back(std::abs(x) <= 1e-6 * cut.path().length() ? 0 : x);
    }
    volume.slice(values, [&](const std::vector<int>& corners) {
      return beside.passes(corners, cut) && where(beside, corners);
    });
  };
  slice([&](const Beside& b, std::size_t i) { return b.nearest[i].distance - cut.path().depth(b.at[i].s); },
        [&](const Beside& b, const std::vector<int>& corners) {
          double low = b.at[corners[0]].s, high = low;
          for (const int i : corners) {
            low = std::min(low, b.at[i].s);
            high = std::max(high, b.at[i].s);
          }
          return low < cut.tip() && high > cut.start();
        });
  for (const double end : {cut.start(), cut.tip()})
    slice([&](const Beside& b, std::size_t i) { return b.at[i].s - end; },
          [&](const Beside& b, const std::vector<int>& corners) {
            const auto [s, depth] = b.middle(corners);
            return depth < cut.path().depth(s);
          });
}

void split(VolumeMesh& volume, const SurfaceMesh& surface, const Incision& cut) {
  slice_at_ends(volume, surface, cut);
  const Beside beside(volume, surface, cut);
  volume.split(beside.v, [&](const std::vector<int>& corners) {
    const auto [s, depth] = beside.middle(corners);
    return beside.passes(corners, cut) && s > cut.start() && s < cut.tip() && depth < cut.path().depth(s);
  });
}

}  // namespace

int write_cut_volume(VolumeMesh& volume, const SurfaceMesh& surface, const std::vector<const Incision*>& cuts,
                     const ReplayedWounds* wounds, double scale, double t, const std::string& out) {
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
      d = wounds->displacement_below(rest[i], nearest[i].distance * scale, nearest[i].vertex, sides,
                                     wounds->blade(t));
    moved[i] += d;
    displacement.values.insert(displacement.values.end(), {d.x, d.y, d.z});
    depth.values.push_back(nearest[i].distance * scale);
  }
  volume.write(out, moved, {displacement, depth});
  return volume.cells() - before;
}

}  // namespace cleft
