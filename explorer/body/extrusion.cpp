#include "explorer/body/extrusion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>

#include "base/error.h"
#include "explorer/body/skin_coordinates.h"
#include "params/meshed_cut.h"

namespace cleft {

namespace {

constexpr double least_determinant = 0.2;  // of a wedge: least over mean Jacobian of its corners
constexpr double least_part = 0.1;         // of the thickness
constexpr int most_rounds = 40;
constexpr double most_in_a_round = 0.85, beside_in_a_round = 0.93;  // of the thickness, that are left
constexpr int first_of_blades = 4;  // round: before it, columns of blades keep their directions
constexpr double part_of_normal = 0.1;
constexpr double most_cut = 0.8;  // of the thickness: layers of the cut
// Columns turn from the blade's direction to the normals over so many times their way aside: there the tissue
// is compressed to the rest of 1 less one over it.
constexpr double turned_over = 2.5;
constexpr double least_over = 0.5;  // of the thickness
constexpr double most_aside = 3;    // of the thickness: how far aside columns go, about 70 degrees

/// Neighbours along edges.
std::vector<std::vector<int>> neighbors_of(const SurfaceMesh& mesh) {
  std::vector<std::vector<int>> around(mesh.points.size());
  for (const auto& t : mesh.triangles)
    for (int i = 0; i < 3; ++i)
      for (const int j : {1, 2}) around[t[i]].push_back(t[(i + j) % 3]);
  for (auto& list : around) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return around;
}

class Extruder {
 public:
  Extruder(const LinedSurface& surface, const Layers& layers, const std::vector<Vec3>& blade,
           const SurfaceIndex* bone)
      : s_(surface), layers_(layers), blade_(blade), around_(neighbors_of(surface.mesh)) {
    set_directions();
    set_thickness(bone);
  }

  Extrusion run() {
    const std::size_t points = s_.mesh.points.size();
    std::vector<bool> thinned(points, false);
    const std::vector<Vec3> normal = normals_of(s_.mesh);
    const double least = least_part * layers_.depth.back();
    for (int round = 0; find_bad(); ++round) {
      if (round >= most_rounds) break;
      std::vector<bool> bad(points, false);
      for (const int t : e_.turned)
        for (const int p : s_.mesh.triangles[t]) bad[p] = true;
      // Neighbours too, so that the thickness changes slowly.
      std::vector<double> thickness = e_.thickness;
      std::vector<Vec3> inward = e_.inward;
      for (std::size_t p = 0; p < points; ++p) {
        if (bad[p]) {
          thickness[p] = std::max(std::min(least, thickness[p]), most_in_a_round * thickness[p]);
          thinned[p] = true;
          if (squared_norm(blade_[p]) == 0 || round >= first_of_blades) inward[p] = evened_out(p, normal[p]);
        }
        for (const int q : around_[p])
          if (bad[q])
            thickness[p] =
                std::min(thickness[p], std::max(beside_in_a_round * e_.thickness[p], e_.thickness[q]));
      }
      e_.thickness = thickness, e_.inward = inward;
    }
    double thinnest = 0;
    for (std::size_t p = 0; p < points; ++p)
      if (thinned[p] && (e_.thinned++ == 0 || e_.thickness[p] < thinnest))
        thinnest = e_.thickness[p], e_.thinnest = s_.mesh.points[p];
    for (std::size_t p = 0; p < points; ++p)
      if (const double turn = turn_of_blade(p); turn > e_.blade_turn)
        e_.blade_turn = turn, e_.blade_turned_at = s_.mesh.points[p];
    return std::move(e_);
  }

 private:
  /// The mean of a column's direction and those around it, a little nearer to the normal.
  Vec3 evened_out(std::size_t p, const Vec3& normal) const {
    Vec3 sum;
    for (const int q : around_[p]) sum += e_.inward[q];
    return normalized(e_.inward[p] + normalized(sum) - part_of_normal * normal);
  }

  /// Radians from the blade to its column.
  double turn_of_blade(std::size_t p) const {
    if (squared_norm(blade_[p]) == 0) return 0;
    return std::atan2(norm(cross(blade_[p], e_.inward[p])), dot(blade_[p], e_.inward[p]));
  }

  /// Where columns that no blade turns go: means over the neighbourhood, as far as the tissue is thick.
  std::vector<Vec3> upright(const std::vector<Vec3>& normal) const {
    double edge = 0;
    int edges = 0;
    for (std::size_t p = 0; p < normal.size(); ++p)
      for (const int q : around_[p])
        if (squared_norm(blade_[p]) > 0) edge += norm(s_.mesh.points[p] - s_.mesh.points[q]), ++edges;
    const double part = edges > 0 ? layers_.depth.back() / (edge / edges) : 4;
    const int rounds = std::clamp(static_cast<int>(part * part / 2), 4, 60);
    std::vector<Vec3> inward(normal.size());
    for (std::size_t p = 0; p < normal.size(); ++p) inward[p] = -normal[p];
    for (int round = 0; round < rounds; ++round) {
      std::vector<Vec3> next = inward;
      for (std::size_t p = 0; p < next.size(); ++p) {
        Vec3 sum = inward[p];
        for (const int q : around_[p]) sum += inward[q];
        if (const Vec3 mean = normalized(sum); dot(mean, normal[p]) < -0.5) next[p] = mean;
      }
      inward = next;
    }
    return inward;
  }

  /// How far aside of these columns go for each mm below the skin: on the cuts as the blade, away from them
  /// less and less.
  std::vector<Vec3> ways_aside(const std::vector<Vec3>& inward) const {
    std::vector<Vec3> aside(inward.size());
    std::vector<double> distance(inward.size(), std::numeric_limits<double>::infinity());
    std::vector<int> nearest(inward.size(), -1);
    using Reached = std::pair<double, int>;
    std::priority_queue<Reached, std::vector<Reached>, std::greater<>> queue;
    for (std::size_t p = 0; p < inward.size(); ++p) {
      const double down = dot(blade_[p], inward[p]);
      if (squared_norm(blade_[p]) == 0 || down <= 0) continue;
      aside[p] = 1 / down * blade_[p] - inward[p];
      if (norm(aside[p]) > most_aside) aside[p] = most_aside * normalized(aside[p]);
      distance[p] = 0, nearest[p] = static_cast<int>(p), queue.push({0., static_cast<int>(p)});
    }
    while (!queue.empty()) {
      const auto [at, p] = queue.top();
      queue.pop();
      if (at > distance[p]) continue;
      for (const int q : around_[p])
        if (const double d = at + norm(s_.mesh.points[q] - s_.mesh.points[p]); d < distance[q])
          distance[q] = d, nearest[q] = nearest[p], queue.push({d, q});
    }
    std::vector<Vec3> result(inward.size());
    for (std::size_t p = 0; p < inward.size(); ++p) {
      if (nearest[p] < 0) continue;
      const Vec3& way = aside[nearest[p]];
      const double over = std::max(least_over, turned_over * norm(way)) * layers_.depth.back();
      if (distance[p] < over) result[p] = (1 - distance[p] / over) * (way - dot(way, inward[p]) * inward[p]);
    }
    return result;
  }

  void set_directions() {
    e_.inward = upright(normals_of(s_.mesh));
    aside_ = ways_aside(e_.inward);
    for (std::size_t p = 0; p < aside_.size(); ++p)
      e_.inward[p] = squared_norm(blade_[p]) > 0 ? blade_[p] : normalized(e_.inward[p] + aside_[p]);
  }

  /// Columns that lean end as deep as upright ones.
  void set_thickness(const SurfaceIndex* bone) {
    for (const Vec3& aside : aside_)
      e_.thickness.push_back(layers_.depth.back() * std::sqrt(1 + squared_norm(aside)));
    e_.on_bone.assign(s_.mesh.points.size(), false);
    if (!bone) return;
    for (std::size_t p = 0; p < s_.mesh.points.size(); ++p) {
      const Vec3& at = s_.mesh.points[p];
      const Vec3 whole = e_.thickness[p] * e_.inward[p];
      if (bone->meets(at, -1. * whole) && !bone->meets(at, 3. * whole))
        throw InputError("bone lies above the skin at " + place_text(at) +
                         " mm; check units and places of --bone");
      if (const auto part = bone->meets(at, whole)) {
        e_.thickness[p] *= std::max(0.05, *part);
        e_.on_bone[p] = true;
      }
    }
  }

  /// Finds triangles above wedges whose least Jacobian is too small.
  bool find_bad() {
    const int count = static_cast<int>(layers_.depth.size());
    std::vector<std::vector<Vec3>> nodes(count);
    for (int k = 0; k < count; ++k)
      for (std::size_t p = 0; p < s_.mesh.points.size(); ++p)
        nodes[k].push_back(e_.node(s_, layers_, static_cast<int>(p), k));
    e_.turned.clear();
    e_.least_determinant = std::numeric_limits<double>::infinity();
    for (int number = 0; number < static_cast<int>(s_.mesh.triangles.size()); ++number) {
      const auto& t = s_.mesh.triangles[number];
      double worst = std::numeric_limits<double>::infinity();
      for (int k = 0; k + 1 < count; ++k) {
        double least = std::numeric_limits<double>::infinity(), sum = 0;
        for (const int layer : {k, k + 1})
          for (int i = 0; i < 3; ++i) {
            const auto& n = nodes[layer];
            const Vec3 here = n[t[i]];
            const double j = dot(cross(n[t[(i + 1) % 3]] - here, n[t[(i + 2) % 3]] - here),
                                 nodes[k][t[i]] - nodes[k + 1][t[i]]);
            least = std::min(least, j), sum += std::abs(j) / 6;
          }
        worst = std::min(worst, sum > 0 ? least / sum : 0);
      }
      e_.least_determinant = std::min(e_.least_determinant, worst);
      if (worst < least_determinant) e_.turned.push_back(number);
    }
    return !e_.turned.empty();
  }

  const LinedSurface& s_;
  const Layers& layers_;
  const std::vector<Vec3>& blade_;
  std::vector<std::vector<int>> around_;
  std::vector<Vec3> aside_;  // of each column, for each mm below the skin
  Extrusion e_;
};

}  // namespace

std::vector<Vec3> normals_of(const SurfaceMesh& mesh) {
  std::vector<Vec3> normals(mesh.points.size());
  for (const auto& t : mesh.triangles) {
    // Weighted by the angle, so that it does not matter how a fan is divided into triangles.
    for (int i = 0; i < 3; ++i) {
      const Vec3 a = mesh.points[t[(i + 1) % 3]] - mesh.points[t[i]],
                 b = mesh.points[t[(i + 2) % 3]] - mesh.points[t[i]];
      const Vec3 n = cross(a, b);
      if (squared_norm(n) > 0) normals[t[i]] += std::atan2(norm(n), dot(a, b)) * normalized(n);
    }
  }
  for (Vec3& n : normals)
    if (squared_norm(n) > 0) n = normalized(n);
  return normals;
}

Layers make_layers(const Parameters& p, double depth) {
  const double part = front_parts(p).bottom, size = p.mesh.element_size, thickness = p.patch.height;
  Layers layers;
  const int count = std::max(1, static_cast<int>(std::ceil(depth / size + part - 1e-9)));
  layers.front = part * depth / (count - part);
  layers.bottom = count;
  const double deepest = depth + layers.front;
  if (!(deepest < 0.95 * thickness))
    throw InputError("the cut is " + shortest(depth) + " mm deep, in tissue of patch.height = " +
                     shortest(thickness) + " mm: make it shallower, or the tissue thicker");
  for (int k = 0; k <= count; ++k) layers.depth.push_back(deepest * k / count);
  double step = deepest / count;
  std::vector<double> sums = {0};
  while (sums.back() < thickness - deepest - 1e-9) sums.push_back(sums.back() + (step *= p.mesh.grading));
  for (std::size_t k = 1; k < sums.size(); ++k)
    layers.depth.push_back(deepest + (thickness - deepest) * sums[k] / sums.back());
  return layers;
}

Vec3 Extrusion::node(const LinedSurface& surface, const Layers& layers, int point, int layer) const {
  const double whole = layers.depth.back(), cut = layers.depth[layers.bottom], depth = layers.depth[layer];
  const double thick = thickness[point], kept = cut_depth(layers, point);
  const double at = depth <= cut ? depth * kept / cut : kept + (depth - cut) * (thick - kept) / (whole - cut);
  return surface.mesh.points[point] + at * inward[point];
}

double Extrusion::cut_depth(const Layers& layers, int point) const {
  return std::min(layers.depth[layers.bottom], most_cut * thickness[point]);
}

Extrusion extrude(const LinedSurface& surface, const Layers& layers, const std::vector<Vec3>& blade,
                  const SurfaceIndex* bone) {
  return Extruder(surface, layers, blade, bone).run();
}

}  // namespace cleft
