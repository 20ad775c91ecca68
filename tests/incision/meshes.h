// Classes of meshes to cut, and what must hold of a mesh whatever was cut into it.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "explorer/incision/cut_mesh.h"
#include "explorer/incision/incision.h"
#include "explorer/incision/scalpel_path.h"

namespace cleft::testing {

using Height = double (*)(double x, double y);

/// Every third triangle is divided at a place that is next to nothing beside one of its edges.
inline SurfaceMesh with_slivers(SurfaceMesh plate) {
  for (std::size_t t = 0, count = plate.triangles.size(); t < count; t += 3) {
    const auto [a, b, c] = plate.triangles[t];
    const Vec3 middle = 0.5 * (plate.points[a] + plate.points[b]);
    const int at = static_cast<int>(plate.points.size());
    plate.points.push_back(middle + 1e-4 * (plate.points[c] - middle));
    plate.triangles[t] = {a, b, at};
    plate.triangles.push_back({b, c, at});
    plate.triangles.push_back({c, a, at});
  }
  return plate;
}

/// nx x ny squares of the given size, from (x0, y0), each cut along one diagonal.
inline SurfaceMesh grid(int nx, int ny, double x0, double y0, double h, Height height = nullptr) {
  SurfaceMesh mesh;
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i) {
      const double x = x0 + i * h, y = y0 + j * h;
      mesh.points.push_back({x, y, height ? height(x, y) : 0});
    }
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      const int a = j * (nx + 1) + i, b = a + 1, c = a + nx + 1, d = c + 1;
      mesh.triangles.push_back({a, b, d});
      mesh.triangles.push_back({a, d, c});
    }
  return mesh;
}

/// An octahedron's faces divided `levels` times, points on the sphere.
inline SurfaceMesh sphere(int levels, double radius) {
  SurfaceMesh mesh;
  mesh.points = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<int, int>, int> middles;
    std::vector<std::array<int, 3>> finer;
    const auto middle = [&](int a, int b) {
      const auto [at, fresh] = middles.insert({std::minmax(a, b), static_cast<int>(mesh.points.size())});
      if (fresh) mesh.points.push_back(normalized(mesh.points[a] + mesh.points[b]));
      return at->second;
    };
    for (const auto& [a, b, c] : mesh.triangles) {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    mesh.triangles = std::move(finer);
  }
  for (Vec3& p : mesh.points) p *= radius;
  return mesh;
}

/// Around the z axis; `closed`: a torus with the given radii, else an open cylinder of length 4 * inner.
inline SurfaceMesh ring(int around, int across, double radius, double inner, bool closed) {
  SurfaceMesh mesh;
  const int rows = closed ? across : across + 1;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < around; ++i) {
      const double p = 2 * std::numbers::pi * i / around, q = 2 * std::numbers::pi * j / across;
      const double r = closed ? radius + inner * std::cos(q) : radius;
      const double z = closed ? inner * std::sin(q) : 4 * inner * (double(j) / across - 0.5);
      mesh.points.push_back({r * std::cos(p), r * std::sin(p), z});
    }
  for (int j = 0; j < across; ++j)
    for (int i = 0; i < around; ++i) {
      const int k = (j + 1) % rows, l = (i + 1) % around;
      const int a = j * around + i, b = j * around + l, c = k * around + i, d = k * around + l;
      mesh.triangles.push_back({a, b, d});
      mesh.triangles.push_back({a, d, c});
    }
  return mesh;
}

struct Shape {
  int boundary_edges = 0, bad_edges = 0;  ///< with one triangle; with more, or with disagreeing directions
  int euler = 0;                          ///< V - E + F over vertices in use
  int split_vertices = 0;                 ///< whose triangles form more than one fan
  double skin_area = 0, volume = 0;
  double smallest_angle = 180;  ///< of the skin, degrees
};

inline Shape shape_of(const CutMesh& mesh) {
  Shape shape;
  std::map<std::pair<int, int>, int> directed;
  std::map<int, std::vector<std::pair<int, int>>> links;
  for (const auto& t : mesh.triangles()) {
    for (int i = 0; i < 3; ++i) {
      ++directed[{t.vertex[i], t.vertex[(i + 1) % 3]}];
      links[t.vertex[i]].push_back({t.vertex[(i + 1) % 3], t.vertex[(i + 2) % 3]});
    }
    const Vec3 p[3] = {mesh.position(t.vertex[0]), mesh.position(t.vertex[1]), mesh.position(t.vertex[2])};
    shape.volume += dot(p[0], cross(p[1], p[2])) / 6;
    if (t.region != Region::skin) continue;
    shape.skin_area += norm(cross(p[1] - p[0], p[2] - p[0])) / 2;
    for (int i = 0; i < 3; ++i) {
      const Vec3 a = p[(i + 1) % 3] - p[i], b = p[(i + 2) % 3] - p[i];
      shape.smallest_angle =
          std::min(shape.smallest_angle, std::atan2(norm(cross(a, b)), dot(a, b)) * 180 / std::numbers::pi);
    }
  }
  int edges = 0;
  for (const auto& [edge, count] : directed) {
    const auto back = directed.find({edge.second, edge.first});
    if (count > 1) ++shape.bad_edges;
    if (back == directed.end()) ++shape.boundary_edges;
    if (back == directed.end() || edge.first < edge.second) ++edges;
  }
  for (auto& [v, link] : links) {  // one path or one ring: follow it
    std::map<int, int> next(link.begin(), link.end());
    std::set<int> ends;
    for (const auto& [from, to] : next) ends.insert(to);
    int start = link.front().first;
    for (const auto& [from, to] : next)
      if (!ends.count(from)) start = from;
    std::size_t count = 0;
    for (int at = start; next.count(at) && count <= link.size(); ++count) {
      at = next[at];
      if (at == start) {
        ++count;
        break;
      }
    }
    if (count != link.size() || next.size() != link.size()) ++shape.split_vertices;
  }
  shape.euler = static_cast<int>(links.size()) - edges + static_cast<int>(mesh.triangles().size());
  return shape;
}

/// Whether all stored adjacency agrees with the triangles.
inline bool adjacency_holds(const CutMesh& mesh) {
  std::map<std::pair<int, int>, int> owner;
  for (std::size_t t = 0; t < mesh.triangles().size(); ++t)
    for (int i = 0; i < 3; ++i)
      owner[{mesh.triangles()[t].vertex[i], mesh.triangles()[t].vertex[(i + 1) % 3]}] = static_cast<int>(t);
  for (const auto& t : mesh.triangles())
    for (int i = 0; i < 3; ++i) {
      const auto other = owner.find({t.vertex[(i + 1) % 3], t.vertex[i]});
      if (t.neighbor[i] != (other == owner.end() ? CutMesh::boundary : other->second)) return false;
    }
  for (std::size_t v = 0; v < mesh.vertices().size(); ++v) {
    const int t = mesh.vertices()[v].triangle;
    if (t < 0 || mesh.triangle(t).corner(static_cast<int>(v)) < 0) return false;
    const VertexKind kind = mesh.vertices()[v].kind;
    const bool on_skin = kind != VertexKind::left_wall && kind != VertexKind::right_wall &&
                         mesh.vertices()[v].depth_fraction == 0;
    if (on_skin && mesh.triangle(t).region != Region::skin) return false;
  }
  return true;
}

/// All that undoing and redoing must bring back.
inline std::vector<double> state_of(const CutMesh& mesh) {
  std::vector<double> all;
  for (const auto& v : mesh.vertices())
    all.insert(all.end(), {v.position.x, v.position.y, v.position.z, double(v.triangle), double(v.kind)});
  for (const auto& t : mesh.triangles())
    for (int i = 0; i < 3; ++i)
      all.insert(all.end(), {double(t.vertex[i]), double(t.neighbor[i]), double(t.region)});
  return all;
}

/// A path through points with a common depth; `outward` tells N at a point.
template <class Outward>
ScalpelPath path_through(const std::vector<Vec3>& points, const Outward& outward, double depth) {
  std::vector<ScalpelPath::Point> path;
  for (const Vec3& p : points) path.push_back({p, outward(p), depth});
  return ScalpelPath(path);
}

inline Vec3 up(const Vec3&) { return {0, 0, 1}; }

}  // namespace cleft::testing
