#include "explorer/body/extrusion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/text.h"
#include "params/meshed_cut.h"

namespace cleft {

namespace {

constexpr double least_determinant = 0.2;  // of a wedge: least over mean Jacobian of its corners
constexpr double least_part = 0.1;         // of the thickness
constexpr double most_cut = 0.8;           // of the thickness: layers of the cut

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
    for (int round = 0;; ++round) {
      std::vector<bool> bad(points, false);
      if (!find_bad(bad)) break;
      if (round >= 60) {
        const auto at = std::find(bad.begin(), bad.end(), true) - bad.begin();
        throw InputError("the tissue below the skin at " + place(s_.mesh.points[at]) +
                         " mm turns inside out even where it is thin; smooth the mesh there, make the "
                         "triangles coarser (mesh.element_size), or patch.height smaller");
      }
      // Neighbours too, so that the thickness changes slowly.
      std::vector<double> next = e_.thickness;
      for (std::size_t p = 0; p < points; ++p) {
        if (bad[p]) next[p] *= 0.85, thinned[p] = true;
        for (const int q : around_[p])
          if (bad[q]) next[p] = std::min(next[p], std::max(0.93 * e_.thickness[p], e_.thickness[q]));
      }
      e_.thickness = next;
    }
    for (std::size_t p = 0; p < points; ++p)
      if (thinned[p]) {
        if (e_.thinned++ == 0 || e_.thickness[p] < thinnest_) thinnest_ = e_.thickness[p], e_.thinnest = s_.mesh.points[p];
        if (e_.thickness[p] < least_part * layers_.depth.back() && !e_.on_bone[p])
          throw InputError("the tissue below the skin at " + place(s_.mesh.points[p]) +
                           " mm would have to be thinner than a tenth of patch.height = " +
                           shortest(layers_.depth.back()) + " mm; make patch.height smaller");
      }
    return std::move(e_);
  }

 private:
  static std::string place(const Vec3& p) {
    const auto rounded = [](double x) { return shortest(std::round(1e3 * x) / 1e3); };
    return "(" + rounded(p.x) + ", " + rounded(p.y) + ", " + rounded(p.z) + ")";
  }

  /// Means over the neighbourhood, as far as the tissue is thick, with the blades' directions fixed.
  void set_directions() {
    const std::vector<Vec3> normal = normals_of(s_.mesh);
    e_.inward.resize(normal.size());
    const auto fixed = [&](std::size_t p) { return squared_norm(blade_[p]) > 0; };
    for (std::size_t p = 0; p < normal.size(); ++p) e_.inward[p] = fixed(p) ? blade_[p] : -normal[p];
    double mean_edge = 0;
    int edges = 0;
    for (std::size_t p = 0; p < normal.size(); ++p)
      for (const int q : around_[p])
        if (fixed(p)) mean_edge += norm(s_.mesh.points[p] - s_.mesh.points[q]), ++edges;
    const double part = edges > 0 ? layers_.depth.back() / (mean_edge / edges) : 4;
    const int rounds = std::clamp(static_cast<int>(part * part / 2), 4, 60);
    for (int round = 0; round < rounds; ++round) {
      std::vector<Vec3> next = e_.inward;
      for (std::size_t p = 0; p < next.size(); ++p) {
        if (fixed(p)) continue;
        Vec3 sum = e_.inward[p];
        for (const int q : around_[p]) sum += e_.inward[q];
        if (const Vec3 mean = normalized(sum); dot(mean, normal[p]) < -0.5) next[p] = mean;
      }
      e_.inward = next;
    }
  }

  void set_thickness(const SurfaceIndex* bone) {
    const double whole = layers_.depth.back();
    e_.thickness.assign(s_.mesh.points.size(), whole);
    e_.on_bone.assign(s_.mesh.points.size(), false);
    if (!bone) return;
    for (std::size_t p = 0; p < s_.mesh.points.size(); ++p) {
      const Vec3& at = s_.mesh.points[p];
      if (bone->meets(at, -whole * e_.inward[p]) && !bone->meets(at, 3 * whole * e_.inward[p]))
        throw InputError("bone lies above the skin at " + place(at) + " mm; check units and places of --bone");
      if (const auto part = bone->meets(at, whole * e_.inward[p])) {
        e_.thickness[p] = std::max(0.05, *part) * whole;
        e_.on_bone[p] = true;
      }
    }
  }

  /// The points of wedges whose least Jacobian is too small.
  bool find_bad(std::vector<bool>& bad) {
    const int count = static_cast<int>(layers_.depth.size());
    std::vector<std::vector<Vec3>> nodes(count);
    for (int k = 0; k < count; ++k)
      for (std::size_t p = 0; p < s_.mesh.points.size(); ++p)
        nodes[k].push_back(e_.node(s_, layers_, static_cast<int>(p), k));
    bool any = false;
    e_.least_determinant = std::numeric_limits<double>::infinity();
    for (const auto& t : s_.mesh.triangles)
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
        const double part = sum > 0 ? least / sum : 0;
        e_.least_determinant = std::min(e_.least_determinant, part);
        if (part >= least_determinant) continue;
        any = true;
        for (const int p : t) bad[p] = true;
      }
    return any;
  }

  const LinedSurface& s_;
  const Layers& layers_;
  const std::vector<Vec3>& blade_;
  std::vector<std::vector<int>> around_;
  Extrusion e_;
  double thinnest_ = 0;
};

}  // namespace

std::vector<Vec3> normals_of(const SurfaceMesh& mesh) {
  std::vector<Vec3> normals(mesh.points.size());
  for (const auto& t : mesh.triangles) {
    // Weighted by the angle, so that it does not matter how a fan is divided into triangles.
    for (int i = 0; i < 3; ++i) {
      const Vec3 a = mesh.points[t[(i + 1) % 3]] - mesh.points[t[i]], b = mesh.points[t[(i + 2) % 3]] - mesh.points[t[i]];
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
    throw InputError("the cut is " + shortest(depth) + " mm deep, in tissue of patch.height = " + shortest(thickness) +
                     " mm: make it shallower, or the tissue thicker");
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
