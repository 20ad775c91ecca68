// The example head is a mesh that every part of the project can rely on.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numbers>

#include "examples/head/head_shape.h"
#include "examples/head/surface_mesher.h"

namespace cleft::head {
namespace {

const TriangleMesh& head_mesh() {
  static const TriangleMesh mesh = mesh_head(12000);
  return mesh;
}

TEST(Head, HasTheTrianglesAskedFor) {
  EXPECT_EQ(head_mesh().triangles.size(), 12000u);
  EXPECT_EQ(mesh_head(5000).triangles.size(), 5000u);
}

TEST(Head, IsClosedOrientedAndOfGenusZero) {
  const TriangleMesh& mesh = head_mesh();
  std::map<std::pair<int, int>, int> edges;
  std::vector<int> used(mesh.points.size(), 0);
  for (const auto& t : mesh.triangles)
    for (int i = 0; i < 3; ++i) {
      ++edges[{t[i], t[(i + 1) % 3]}];
      used[t[i]] = 1;
    }
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(edges.count({edge.second, edge.first}), 1u);
  }
  EXPECT_EQ(std::count(used.begin(), used.end(), 0), 0);
  // One component (all triangles are reached over edges), whose Euler characteristic is a sphere's.
  std::vector<int> component(mesh.points.size());
  for (std::size_t i = 0; i < component.size(); ++i) component[i] = static_cast<int>(i);
  const auto root = [&component](int i) {
    while (component[i] != i) i = component[i] = component[component[i]];
    return i;
  };
  for (const auto& [edge, count] : edges) component[root(edge.first)] = root(edge.second);
  for (std::size_t i = 0; i < component.size(); ++i) EXPECT_EQ(root(static_cast<int>(i)), root(0));
  EXPECT_EQ(mesh.points.size() - edges.size() / 2 + mesh.triangles.size(), 2u);
}

TEST(Head, FacesOutwardsAndHasAHumanSize) {
  const TriangleMesh& mesh = head_mesh();
  double volume = 0;  // mm^3
  Vec3 low = mesh.points[0], high = low;
  for (const auto& [a, b, c] : mesh.triangles)
    volume += dot(mesh.points[a], cross(mesh.points[b], mesh.points[c])) / 6;
  for (const Vec3& p : mesh.points)
    for (int i = 0; i < 3; ++i) low[i] = std::min(low[i], p[i]), high[i] = std::max(high[i], p[i]);
  EXPECT_GT(volume, 3e6);
  EXPECT_LT(volume, 5e6);
  EXPECT_NEAR(high.y - low.y, 240, 10);
}

TEST(Head, TrianglesAreWellShaped) {
  const TriangleMesh& mesh = head_mesh();
  double smallest = 180;
  for (const auto& t : mesh.triangles)
    for (int i = 0; i < 3; ++i) {
      const Vec3 a = mesh.points[t[(i + 1) % 3]] - mesh.points[t[i]],
                 b = mesh.points[t[(i + 2) % 3]] - mesh.points[t[i]];
      smallest = std::min(smallest, std::atan2(norm(cross(a, b)), dot(a, b)) * 180 / std::numbers::pi);
    }
  EXPECT_GT(smallest, 20) << "Delaunay refinement promises 20.7 degrees: no worse than that";
}

TEST(Head, VerticesLieOnTheSurface) {
  for (const Vec3& p : head_mesh().points) EXPECT_NEAR(distance(p), 0, 1e-6);
}

/// Whether the segment p, q passes through the inside of the triangle a, b, c.
bool pierces(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto volume = [](const Vec3& o, const Vec3& x, const Vec3& y, const Vec3& z) {
    return dot(x - o, cross(y - o, z - o));
  };
  if ((volume(p, a, b, c) > 0) == (volume(q, a, b, c) > 0)) return false;
  const double u = volume(p, q, a, b), v = volume(p, q, b, c), w = volume(p, q, c, a);
  return (u > 0 && v > 0 && w > 0) || (u < 0 && v < 0 && w < 0);
}

TEST(Head, DoesNotIntersectItself) {
  const TriangleMesh& mesh = head_mesh();
  const std::vector<Vec3>& x = mesh.points;
  // Of two triangles that cross each other an edge of one passes through the other. Sorted by x, only
  // triangles whose x ranges overlap are compared.
  struct Span {
    Vec3 low, high;
    int triangle;
  };
  std::vector<Span> spans;
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    Span s{x[mesh.triangles[t][0]], x[mesh.triangles[t][0]], t};
    for (int v : mesh.triangles[t])
      for (int i = 0; i < 3; ++i)
        s.low[i] = std::min(s.low[i], x[v][i]), s.high[i] = std::max(s.high[i], x[v][i]);
    spans.push_back(s);
  }
  std::sort(spans.begin(), spans.end(), [](const Span& a, const Span& b) { return a.low.x < b.low.x; });
  int crossings = 0;
  for (std::size_t i = 0; i < spans.size(); ++i)
    for (std::size_t j = i + 1; j < spans.size() && spans[j].low.x <= spans[i].high.x; ++j) {
      const Span &s = spans[i], &r = spans[j];
      if (s.low.y > r.high.y || r.low.y > s.high.y || s.low.z > r.high.z || r.low.z > s.high.z) continue;
      for (const auto& [one, other] : {std::pair{s.triangle, r.triangle}, {r.triangle, s.triangle}}) {
        const auto &e = mesh.triangles[one], &f = mesh.triangles[other];
        for (int k = 0; k < 3; ++k) {
          const int p = e[k], q = e[(k + 1) % 3];
          if (std::count(f.begin(), f.end(), p) + std::count(f.begin(), f.end(), q) > 0) continue;
          crossings += pierces(x[p], x[q], x[f[0]], x[f[1]], x[f[2]]);
        }
      }
    }
  EXPECT_EQ(crossings, 0);
}

TEST(CheekPath, LiesOnTheSkinInEvenStepsWithOutwardNormals) {
  const std::vector<PathPoint> path = cheek_path(2);
  ASSERT_GT(path.size(), 2u);
  double length = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const auto& [p, n] = path[i];
    EXPECT_NEAR(distance(p), 0, 1e-6);
    EXPECT_NEAR(norm(n), 1, 1e-12);
    EXPECT_GT(distance(p + 1. * n), 0.5) << "one mm out";
    EXPECT_LT(distance(p - 1. * n), -0.5) << "one mm in";
    if (i == 0) continue;
    const double step = norm(p - path[i - 1].position);
    EXPECT_NEAR(step, 2, 0.05);
    length += step;
  }
  EXPECT_GT(length, 60);
  EXPECT_LT(length, 70);
}

}  // namespace
}  // namespace cleft::head
