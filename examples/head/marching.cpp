#include "examples/head/marching.h"

#include <cstdint>
#include <unordered_map>

namespace cleft::head {
namespace {

struct Grid {
  Vec3 low;
  double spacing;
  std::array<int, 3> size;

  std::size_t index(int i, int j, int k) const { return (std::size_t(k) * size[1] + j) * size[0] + i; }
  Vec3 point(std::size_t node) const {
    const std::size_t i = node % size[0], j = node / size[0] % size[1], k = node / size[0] / size[1];
    return low + spacing * Vec3{double(i), double(j), double(k)};
  }
};

/// Signed distances at the nodes. A block of nodes farther from the surface than its own size is filled with
/// its centre's value: only the sign counts there.
std::vector<double> sample(const std::function<double(const Vec3&)>& distance, const Grid& grid) {
  constexpr int block = 5;
  const double reach = 1.6 * block / 2. * std::sqrt(3) * grid.spacing;  // blends stretch distances somewhat
  std::vector<double> values(std::size_t(grid.size[0]) * grid.size[1] * grid.size[2]);
  for (int k0 = 0; k0 < grid.size[2]; k0 += block)
    for (int j0 = 0; j0 < grid.size[1]; j0 += block)
      for (int i0 = 0; i0 < grid.size[0]; i0 += block) {
        const double half = (block - 1) / 2. * grid.spacing;
        const double middle = distance(grid.point(grid.index(i0, j0, k0)) + Vec3{half, half, half});
        for (int k = k0; k < std::min(k0 + block, grid.size[2]); ++k)
          for (int j = j0; j < std::min(j0 + block, grid.size[1]); ++j)
            for (int i = i0; i < std::min(i0 + block, grid.size[0]); ++i) {
              const std::size_t node = grid.index(i, j, k);
              values[node] = std::abs(middle) > reach ? middle : distance(grid.point(node));
            }
      }
  return values;
}

class Marcher {
 public:
  Marcher(const Grid& grid, const std::vector<double>& values) : grid_(grid), values_(values) {}

  void tetrahedron(std::array<std::size_t, 4> node) {
    std::array<std::size_t, 4> in{}, out{};
    int ins = 0, outs = 0;
    for (std::size_t n : node) (values_[n] < 0 ? in[ins++] : out[outs++]) = n;
    if (ins == 1) {
      triangle(in[0], crossing(in[0], out[0]), crossing(in[0], out[1]), crossing(in[0], out[2]));
    } else if (ins == 3) {
      triangle(in[0], crossing(in[0], out[0]), crossing(in[1], out[0]), crossing(in[2], out[0]));
    } else if (ins == 2) {
      const int a = crossing(in[0], out[0]), b = crossing(in[0], out[1]), c = crossing(in[1], out[1]),
                d = crossing(in[1], out[0]);
      triangle(in[0], a, b, c), triangle(in[0], a, c, d);
    }
  }

  TriangleMesh take() { return std::move(mesh_); }

 private:
  int crossing(std::size_t inside, std::size_t outside) {
    const std::uint64_t key = std::uint64_t(std::min(inside, outside)) << 32 | std::max(inside, outside);
    const auto [found, fresh] = crossings_.try_emplace(key, static_cast<int>(mesh_.points.size()));
    if (fresh) {
      const double a = values_[inside], b = values_[outside];
      mesh_.points.push_back(lerp(grid_.point(inside), grid_.point(outside), a / (a - b)));
    }
    return found->second;
  }

  /// Oriented away from a node inside.
  void triangle(std::size_t inside, int a, int b, int c) {
    const std::vector<Vec3>& x = mesh_.points;
    const Vec3 normal = cross(x[b] - x[a], x[c] - x[a]);
    if (dot(normal, x[a] - grid_.point(inside)) < 0) std::swap(b, c);
    mesh_.triangles.push_back({a, b, c});
  }

  const Grid& grid_;
  const std::vector<double>& values_;
  std::unordered_map<std::uint64_t, int> crossings_;
  TriangleMesh mesh_;
};

}  // namespace

TriangleMesh march(const std::function<double(const Vec3&)>& distance, const Box& box, double spacing) {
  Grid grid{box.low, spacing, {}};
  for (int axis = 0; axis < 3; ++axis)
    grid.size[axis] = static_cast<int>(std::ceil((box.high[axis] - box.low[axis]) / spacing)) + 1;
  std::vector<double> values = sample(distance, grid);
  // A crossing near a node would make needles: the node is treated as slightly off the surface.
  const double least = 0.02 * spacing;
  for (double& v : values)
    if (std::abs(v) < least) v = v < 0 ? -least : least;

  Marcher marcher(grid, values);
  for (int k = 0; k + 1 < grid.size[2]; ++k)
    for (int j = 0; j + 1 < grid.size[1]; ++j)
      for (int i = 0; i + 1 < grid.size[0]; ++i) {
        const auto corner = [&](int bits) {
          return grid.index(i + (bits & 1), j + (bits >> 1 & 1), k + (bits >> 2));
        };
        int inside = 0;
        for (int bits = 0; bits < 8; ++bits) inside += values[corner(bits)] < 0;
        if (inside == 0 || inside == 8) continue;
        // The six tetrahedra about the cube's diagonal: the walks from corner 0 to 7 along the axes.
        for (const auto& [a, b] : {std::pair{1, 3}, {1, 5}, {2, 3}, {2, 6}, {4, 5}, {4, 6}})
          marcher.tetrahedron({corner(0), corner(a), corner(b), corner(7)});
      }
  return marcher.take();
}

}  // namespace cleft::head
