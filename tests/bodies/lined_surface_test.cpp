#include "explorer/body/lined_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "explorer/body/remesh.h"
#include "tests/bodies/subjects.h"

namespace cleft {

namespace {

using testing::arc, testing::path_on, testing::sheet;

double area_of(const SurfaceMesh& mesh) {
  double area = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    area += norm(cross(mesh.points[b] - mesh.points[a], mesh.points[c] - mesh.points[a])) / 2;
  return area;
}

using Edge = std::pair<int, int>;
std::map<Edge, int> edges_of(const SurfaceMesh& mesh) {
  std::map<Edge, int> edges;
  for (const auto& t : mesh.triangles)
    for (int i = 0; i < 3; ++i) ++edges[std::minmax(t[i], t[(i + 1) % 3])];
  return edges;
}

int euler_number(const SurfaceMesh& mesh) {
  std::set<int> used;
  for (const auto& t : mesh.triangles) used.insert(t.begin(), t.end());
  return static_cast<int>(used.size() + mesh.triangles.size() - edges_of(mesh).size());
}

double least_angle(const SurfaceMesh& mesh) {
  double least = 180;
  for (const auto& t : mesh.triangles)
    for (int i = 0; i < 3; ++i) {
      const Vec3 a = mesh.points[t[(i + 1) % 3]] - mesh.points[t[i]],
                 b = mesh.points[t[(i + 2) % 3]] - mesh.points[t[i]];
      least = std::min(least, std::atan2(norm(cross(a, b)), dot(a, b)) * 180 / std::numbers::pi);
    }
  return least;
}

/// Lines follow each other, arc lengths increase, and each line is an edge between two triangles.
void expect_connected(const LinedSurface& s, std::size_t cut) {
  const auto edges = edges_of(s.mesh);
  const auto& lines = s.cuts[cut];
  ASSERT_FALSE(lines.empty());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    EXPECT_LT(lines[i].s_from, lines[i].s_to);
    const auto edge = edges.find(std::minmax(lines[i].from, lines[i].to));
    ASSERT_NE(edge, edges.end()) << "line " << i << " is no edge";
    EXPECT_EQ(edge->second, 2);
    if (i == 0) continue;
    EXPECT_EQ(lines[i].from, lines[i - 1].to);
    EXPECT_DOUBLE_EQ(lines[i].s_from, lines[i - 1].s_to);
  }
}

struct Lined {
  std::string name;
  SurfaceMesh whole;
  std::vector<ScalpelPath> paths;
  double radius;  ///< of the sphere; 0: flat
};

std::vector<Lined> all_lined() {
  const testing::Bend ball = testing::sphere_cap(60);
  const std::vector<std::pair<double, double>> along = {{-15, 0}, {15, 0}},
                                               across = {{0, -12}, {0, -6}, {0, 0}, {0, 6}, {0, 12}},
                                               branch = {{0, 0}, {0, 15}};
  const auto on = [](const testing::Bend& bend, const auto&... places) {
    return std::vector<ScalpelPath>{path_on(bend, places, 3)...};
  };
  const SurfaceMesh plate = sheet(testing::flat, 30, 30, 2, 0.3), cap = sheet(ball, 30, 30, 2, 0.3);
  return {{"a line", plate, on(testing::flat, along), 0},
          {"an arc", plate, on(testing::flat, arc(15, 30)), 0},
          {"an arc on a sphere", cap, on(ball, arc(15, 30)), 60},
          {"an X", plate, on(testing::flat, along, across), 0},
          {"an X on a sphere", cap, on(ball, arc(30, 30), across), 60},
          {"a T", plate, on(testing::flat, along, branch), 0}};
}

constexpr double everywhere = 1e3;
constexpr double least_rest = 0.003;  // of a path that gets a point of its own (incision_tolerances.h)
constexpr double sag = 0.04;          // mm, of the sphere's triangles: 2 mm with jitter, 2.3^2 / (2 * 60)

}  // namespace

/// Lines are where the paths are, and the surface is the same: of a flat one to rounding.
TEST(LinedSurface, TheCutsAreEdgesOfTheSameSurface) {
  for (const Lined& l : all_lined()) {
    SCOPED_TRACE(l.name);
    const LinedSurface s = lined_surface(l.whole, l.paths, everywhere);
    EXPECT_EQ(euler_number(s.mesh), 1);
    EXPECT_NEAR(area_of(s.mesh), area_of(l.whole), (l.radius > 0 ? 1e-4 : 1e-12) * area_of(l.whole));
    ASSERT_EQ(s.cuts.size(), l.paths.size());
    for (std::size_t c = 0; c < s.cuts.size(); ++c) {
      expect_connected(s, c);
      EXPECT_NEAR(s.cuts[c].front().s_from, 0, 1e-9);
      EXPECT_NEAR(s.cuts[c].back().s_to, l.paths[c].length(), least_rest * l.paths[c].length());
      for (const CutLine& line : s.cuts[c])
        EXPECT_LT(norm(s.mesh.points[line.from] - l.paths[c].at(line.s_from).position),
                  (l.radius > 0 ? sag : 0) + 1e-3 * l.paths[c].length());
    }
    for (std::size_t p = 0; p < s.outline.size(); ++p)
      if (l.radius == 0) {
        const Vec3& at = s.mesh.points[p];
        EXPECT_EQ(s.outline[p], std::max(std::abs(at.x), std::abs(at.y)) > 30 - 1e-9);
      }
  }
}

TEST(LinedSurface, EndsWhereItsReachEnds) {
  const Lined l = all_lined().front();
  const double reach = 7;
  const LinedSurface s = lined_surface(l.whole, l.paths, reach);
  double furthest = 0;
  for (const Vec3& p : s.mesh.points)
    furthest = std::max(furthest, std::hypot(std::max(0., std::abs(p.x) - 15), p.y));
  EXPECT_GT(furthest, reach - 2.5);  // one triangle more or less
  EXPECT_LT(furthest, reach + 2.5);
  EXPECT_FALSE(std::count(s.outline.begin(), s.outline.end(), true)) << "the body goes on there";
}

TEST(LinedSurface, StationsAreEquallyFarFromEachOther) {
  for (const Lined& l : all_lined()) {
    SCOPED_TRACE(l.name);
    LinedSurface s = lined_surface(l.whole, l.paths, everywhere);
    const double area = area_of(s.mesh);
    const double size = 1.3;
    const std::vector<bool> station = place_stations(s, size);
    EXPECT_EQ(station.size(), s.mesh.points.size());
    EXPECT_NEAR(area_of(s.mesh), area, 1e-9 * area);
    EXPECT_EQ(euler_number(s.mesh), 1);
    std::map<int, int> degree;
    for (const auto& lines : s.cuts)
      for (const CutLine& line : lines) ++degree[line.from], ++degree[line.to];
    for (std::size_t c = 0; c < s.cuts.size(); ++c) {
      expect_connected(s, c);
      const auto& lines = s.cuts[c];
      EXPECT_TRUE(station[lines.front().from] && station[lines.back().to]);
      for (const CutLine& line : lines)
        EXPECT_LT(norm(s.mesh.points[line.from] - l.paths[c].at(line.s_from).position),
                  (l.radius > 0 ? sag : 0) + 1e-3 * l.paths[c].length());
      std::vector<double> stretch;  // distances between the stations from a crossing or end to the next
      double passed = 0;
      for (const CutLine& line : lines) {
        passed += norm(s.mesh.points[line.to] - s.mesh.points[line.from]);
        if (!station[line.to]) continue;
        stretch.push_back(passed), passed = 0;
        if (degree[line.to] == 2) continue;
        for (const double d : stretch) {
          EXPECT_NEAR(d, stretch.front(), 2e-3 * stretch.front());
          EXPECT_LT(d, size * (1 + 1e-6));
          EXPECT_GT(d, size / 2 * (1 - 2e-3));
        }
        stretch.clear();
      }
    }
  }
}

/// The points remain on the surface, its area and kind are kept, triangles are good and of the wanted size,
/// and the cuts go from station to station.
TEST(Remesh, TheSurfaceIsTheSameWithTrianglesOfTheWantedSize) {
  for (const Lined& l : all_lined()) {
    SCOPED_TRACE(l.name);
    LinedSurface s = lined_surface(l.whole, l.paths, everywhere);
    const SurfaceIndex shape(s.mesh);
    const double size = 1.3, area = area_of(s.mesh);
    const std::vector<bool> station = place_stations(s, size);
    std::vector<Vec3> stations;
    for (std::size_t p = 0; p < station.size(); ++p)
      if (station[p]) stations.push_back(s.mesh.points[p]);
    const auto wanted = [&](const Vec3& x) {
      double nearest = 1e9;
      for (const Vec3& p : stations) nearest = std::min(nearest, norm(p - x));
      return size + 0.15 * nearest;
    };
    const LinedSurface r = remeshed(s, station, shape, wanted);
    EXPECT_EQ(euler_number(r.mesh), 1);
    // Chords of the larger triangles: (4 / 60)^2 / 12 of the area of a sphere.
    EXPECT_NEAR(area_of(r.mesh), area, (l.radius > 0 ? 1e-3 : 1e-9) * area);
    for (const Vec3& p : r.mesh.points) {
      EXPECT_LT(norm(shape.nearest(p).position - p), 1e-9);
      if (l.radius > 0) EXPECT_NEAR(norm(p + Vec3{0, 0, l.radius}), l.radius, sag);
    }
    for (const auto& [a, b, c] : r.mesh.triangles) {
      const Vec3 normal =
          normalized(cross(r.mesh.points[b] - r.mesh.points[a], r.mesh.points[c] - r.mesh.points[a]));
      const Vec3 outward = l.radius > 0 ? normalized(r.mesh.points[a] + Vec3{0, 0, l.radius}) : Vec3{0, 0, 1};
      EXPECT_GT(dot(normal, outward), 0.8) << "a triangle has turned over";
    }
    EXPECT_GT(least_angle(r.mesh), 20);
    double longest = 0;
    for (const auto& [edge, count] : edges_of(r.mesh)) {
      const Vec3 &a = r.mesh.points[edge.first], &b = r.mesh.points[edge.second];
      longest = std::max(longest, norm(a - b) / std::min(wanted(a), wanted(b)));
    }
    EXPECT_LT(longest, 1.7);
    std::size_t lines = 0;
    for (std::size_t c = 0; c < r.cuts.size(); ++c) {
      expect_connected(r, c);
      lines += r.cuts[c].size();
      EXPECT_NEAR(r.cuts[c].front().s_from, 0, 1e-9);
      EXPECT_NEAR(r.cuts[c].back().s_to, l.paths[c].length(), least_rest * l.paths[c].length());
      for (const CutLine& line : r.cuts[c]) {
        double off = 1e9;
        for (const Vec3& p : stations) off = std::min(off, norm(p - r.mesh.points[line.from]));
        EXPECT_EQ(off, 0) << "a line begins elsewhere than at a station";
      }
    }
    EXPECT_EQ(lines + 1, stations.size()) << "all stations are kept, and only these";
  }
}

/// Stations are far from each other here: points beside lines would have Delaunay's criterion cross them.
TEST(Remesh, LinesRemainWhateverIsBesideThem) {
  for (const Lined& l : all_lined()) {
    SCOPED_TRACE(l.name);
    LinedSurface s = lined_surface(l.whole, l.paths, 8);
    const SurfaceIndex shape(s.mesh);
    const std::vector<bool> station = place_stations(s, 4);
    const LinedSurface r = remeshed(s, station, shape, [](const Vec3&) { return 0.8; });
    for (std::size_t c = 0; c < r.cuts.size(); ++c) expect_connected(r, c);
  }
}

}  // namespace cleft
