#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <random>

#include "base/error.h"
#include "explorer/io/mesh_file.h"
#include "tests/incision/meshes.h"

namespace cleft {
namespace {

using namespace testing;

constexpr double pi = std::numbers::pi;
constexpr double depth = 2;

Vec3 radial(const Vec3& p) { return p; }
Vec3 from_axis(const Vec3& p) { return {p.x, p.y, 0}; }
Vec3 from_ring(const Vec3& p) {
  const double r = std::hypot(p.x, p.y);
  return {p.x / r * (r - 10), p.y / r * (r - 10), p.z};
}

struct Cut {
  std::string name;
  SurfaceMesh mesh;
  ScalpelPath path;
  bool closed, flat;
  int open_ends;  ///< where the path crosses the boundary
};

std::vector<Cut> cuts() {
  const SurfaceMesh plane = grid(20, 20, -10, -10, 1);
  const auto flat = [&](const char* name, std::vector<Vec3> points, int open_ends) {
    return Cut{name, plane, path_through(points, up, depth), false, true, open_ends};
  };
  return {
      flat("through vertices", {{-5, 0, 0}, {5, 0, 0}}, 0),
      flat("along diagonals", {{-5, -5, 0}, {5, 5, 0}}, 0),
      flat("across diagonals", {{-5, 5, 0}, {5, -5, 0}}, 0),
      flat("skew", {{-5.3, -2.1, 0}, {5.2, 3.3, 0}}, 0),
      flat("almost along edges", {{-5.3, 0.01, 0}, {5.2, -0.03, 0}}, 0),
      flat("curved", {{-5.3, -2.1, 0}, {0.2, 1, 0}, {5, -1, 0}, {6, -4, 0}}, 0),
      flat("hook", {{-4, 0, 0}, {0, 0.5, 0}, {2, 2.5, 0}, {0, 5, 0}, {-3, 5.2, 0}}, 0),
      flat("inside one triangle", {{0.6, 0.2, 0}, {0.7, 0.4, 0}, {0.85, 0.45, 0}}, 0),
      flat("over one edge", {{0.6, 0.2, 0}, {0.6, 0.9, 0}}, 0),
      flat("out over the boundary", {{-5, -2.1, 0}, {12, 3.3, 0}}, 1),
      flat("in over the boundary", {{-15, -2.1, 0}, {2, 3.3, 0}}, 1),
      flat("right across", {{-12.3, -2.1, 0}, {12, 3.3, 0}}, 2),
      {"sphere", sphere(4, 10), path_through({{9, 2, 1}, {7, 5, 4}, {3, 8, 2}}, radial, depth), true, false,
       0},
      {"coarse sphere", sphere(1, 10), path_through({{9, 2, 1}, {7, 5, 4}, {3, 8, 2}}, radial, depth), true,
       false, 0},
      {"torus", ring(60, 24, 10, 4, true), path_through({{10, 0, 4}, {9, 5, 4}, {6, 9, 4}}, from_ring, depth),
       true, false, 0},
      {"cylinder", ring(40, 20, 10, 3, false),
       path_through({{10, 0, -3}, {9, 3, 1}, {7, 6, 4}}, from_axis, depth), false, false, 0},
      {"cylinder, out", ring(40, 20, 10, 3, false),
       path_through({{10, 0, -3}, {9, 3, 1}, {7, 6, 9}}, from_axis, depth), false, false, 1},
  };
}

IncisionOptions unrefined() {
  IncisionOptions options;
  options.max_edge = 0;
  return options;
}

void expect_sound(const Incision& incision, const SurfaceMesh& original, int open_ends) {
  const Shape before = shape_of(CutMesh(original)), after = shape_of(incision.mesh());
  EXPECT_EQ(after.bad_edges, before.bad_edges);
  EXPECT_EQ(after.split_vertices, before.split_vertices);
  EXPECT_TRUE(adjacency_holds(incision.mesh()));
  // Closed ends: the skin loses a disc's worth and the pocket is a disc, a sphere's connected sum. An open
  // end adds the two sides of the wall to the boundary.
  EXPECT_EQ(after.euler, before.euler);
  if (open_ends == 0 && before.boundary_edges == 0) {
    EXPECT_EQ(after.boundary_edges, 0);
  }
  EXPECT_GT(after.smallest_angle, 0.05);
}

TEST(Incision, KeepsWhatMustHold) {
  for (const Cut& cut : cuts())
    for (const bool refine : {false, true}) {
      SCOPED_TRACE(cut.name + (refine ? ", refined" : ""));
      Incision incision(cut.mesh, cut.path, refine ? IncisionOptions{} : unrefined());
      incision.advance_to(cut.path.length());
      expect_sound(incision, cut.mesh, cut.open_ends);
      EXPECT_EQ(incision.left_mesh(), cut.open_ends > 0 && cut.name.substr(0, 2) != "in");
      const Shape before = shape_of(CutMesh(cut.mesh)), after = shape_of(incision.mesh());
      if (cut.flat) {
        EXPECT_NEAR(after.skin_area, before.skin_area, 1e-12 * before.skin_area);
        EXPECT_NEAR(after.volume, 0, 1e-12 * before.skin_area);  // the pocket's own, at rest
      }
      if (cut.closed) {  // moving vertices within the surface's triangles bends it a little
        EXPECT_NEAR(after.volume, before.volume,
                    (cut.mesh.triangles.size() < 100 ? 1e-2 : 1e-4) * before.volume);
      }
      // The chain: lips at rest coincide, s grows, every vertex stands on the blade.
      const CutMesh& mesh = incision.mesh();
      for (std::size_t i = 0; i < incision.chain().size(); ++i) {
        const auto& c = incision.chain()[i];
        EXPECT_EQ(mesh.position(c.left), mesh.position(c.right));
        const bool end = i == 0 || i + 1 == incision.chain().size();
        if (!end) {
          EXPECT_NE(c.left, c.right);
          EXPECT_EQ(mesh.vertex(c.left).kind, VertexKind::left_lip);
          EXPECT_EQ(mesh.vertex(c.right).kind, VertexKind::right_lip);
          EXPECT_GT(c.s, incision.chain()[i - 1].s);
        }
        EXPECT_EQ(mesh.vertex(c.left).s, c.s);
        EXPECT_NEAR(cut.path.coordinates(mesh.position(c.left)).v, 0, 1e-3 * cut.path.length());
      }
      EXPECT_GE(incision.tip(), (cut.open_ends && incision.left_mesh() ? 0.5 : 0.95) * cut.path.length());
      if (cut.open_ends == 0) {
        EXPECT_LE(incision.tip(), 1.05 * cut.path.length());
      }
    }
}

TEST(Incision, LeftAndRightAreWhereTheyShouldBe) {
  Incision incision(grid(20, 20, -10, -10, 1), path_through({{-5.3, 0.3, 0}, {5.2, 0.7, 0}}, up, depth));
  incision.advance_to(100);
  for (const auto& t : incision.mesh().triangles()) {
    const Vec3 middle = 1. / 3 *
                        (incision.mesh().position(t.vertex[0]) + incision.mesh().position(t.vertex[1]) +
                         incision.mesh().position(t.vertex[2]));
    for (const int v : t.vertex) {
      const double side = static_cast<double>(side_of(incision.mesh().vertex(v).kind));
      if (t.region == Region::skin && side != 0) {
        EXPECT_GT(side * incision.path().coordinates(middle).v, 0);
      }
      EXPECT_FALSE(t.region == Region::left_wall && side > 0);
      EXPECT_FALSE(t.region == Region::right_wall && side < 0);
    }
  }
}

TEST(Incision, WallsReachTheDepth) {
  const ScalpelPath path({{{-5.3, 0.3, 0}, {0, 0, 1}, 1}, {{5.2, 0.7, 0}, {0.3, 0, 1}, 3}});
  Incision incision(grid(20, 20, -10, -10, 1), path, unrefined());
  incision.advance_to(path.length());
  double deepest = 0;
  for (const auto& v : incision.mesh().vertices()) {
    if (v.kind == VertexKind::skin) continue;
    const Vec3 lip = path.at(v.s).position;
    EXPECT_NEAR(norm(v.position - lip), v.depth_fraction * path.depth(v.s), 1e-12);
    deepest = std::max(deepest, v.depth_fraction);
  }
  EXPECT_EQ(deepest, 1);
}

TEST(Incision, StepsLeaveNoTrace) {
  for (const Cut& cut : cuts())
    for (const bool refine : {false, true}) {
      SCOPED_TRACE(cut.name + (refine ? ", refined" : ""));
      const IncisionOptions options = refine ? IncisionOptions{} : unrefined();
      Incision once(cut.mesh, cut.path, options), steps(cut.mesh, cut.path, options);
      once.advance_to(cut.path.length());
      std::mt19937 random(7);
      for (double s = 0; s < cut.path.length(); s += cut.path.length() / 50 * (random() % 1000) / 1000.) {
        steps.advance_to(s);
        if (random() % 10 == 0) expect_sound(steps, cut.mesh, cut.open_ends);
      }
      steps.advance_to(cut.path.length());
      ASSERT_EQ(once.mesh().triangles().size(), steps.mesh().triangles().size());
      ASSERT_EQ(once.mesh().vertices().size(), steps.mesh().vertices().size());
      for (std::size_t t = 0; t < once.mesh().triangles().size(); ++t)
        EXPECT_EQ(once.mesh().triangles()[t].vertex, steps.mesh().triangles()[t].vertex);
      for (std::size_t v = 0; v < once.mesh().vertices().size(); ++v)
        EXPECT_EQ(once.mesh().vertices()[v].position, steps.mesh().vertices()[v].position);
    }
}

TEST(Incision, ChordsStayWithinTheTolerance) {
  for (const bool refine : {false, true})
    for (const double tolerance : {0.1, 0.01, 0.001}) {
      IncisionOptions options = refine ? IncisionOptions{} : unrefined();
      options.chord_tolerance = tolerance;
      const ScalpelPath path =
          path_through({{-5.3, -2.1, 0}, {0.2, 1, 0}, {5, -1, 0}, {6, -4, 0}}, up, depth);
      Incision incision(grid(20, 20, -10, -10, 1), path, options);
      incision.advance_to(path.length());
      // Seven samples a chord decide: between them a parabola's top is at most 2 % higher.
      for (std::size_t i = 1; i < incision.chain().size(); ++i)
        for (int k = 0; k <= 100; ++k) {
          const Vec3 x = lerp(incision.mesh().position(incision.chain()[i - 1].left),
                              incision.mesh().position(incision.chain()[i].left), k / 100.);
          double least = 1e9;
          for (int j = 0; j <= 50; ++j)
            least = std::min(least, norm(x - path.at(incision.chain()[i - 1].s +
                                                     (incision.chain()[i].s - incision.chain()[i - 1].s) *
                                                         (0.3 * k / 100. + 0.7 * j / 50.))
                                                 .position));
          EXPECT_LE(std::abs(path.coordinates(x).v), 1.02 * tolerance);
          EXPECT_LE(std::abs(path.coordinates(x).v), least + 1e-9);
        }
    }
}

TEST(Incision, GoesExactlyThroughVerticesItMeets) {
  const SurfaceMesh plane = grid(20, 20, -10, -10, 1);
  Incision incision(plane, path_through({{-5, 0, 0}, {5, 0, 0}}, up, depth), unrefined());
  incision.advance_to(10);
  EXPECT_EQ(incision.moved_vertices(), 0);
  EXPECT_EQ(incision.chain().size(), 11u);
  for (const auto& c : incision.chain()) EXPECT_LT(c.left, static_cast<int>(plane.points.size()));
}

TEST(Incision, MovesNearVerticesAndRemembersTheirPlace) {
  const SurfaceMesh plane = grid(20, 20, -10, -10, 1);
  Incision incision(plane, path_through({{-5, 0.05, 0}, {5, 0.05, 0}}, up, depth), unrefined());
  incision.advance_to(10);
  EXPECT_EQ(incision.moved_vertices(), 20);  // the nine lips count twice
  for (const auto& v : incision.mesh().vertices())
    if (!(v.original == v.position)) {
      EXPECT_EQ(v.original.y, 0);
      EXPECT_NEAR(v.position.y, 0.05, 1e-12);
    }
}

TEST(Incision, SaysWhyItCannotGoOn) {
  const SurfaceMesh plane = grid(20, 20, -10, -10, 1);
  EXPECT_THROW(Incision(plane, path_through({{-5, 0, 90}, {5, 0, 90}}, up, depth)), InputError);  // far off
  EXPECT_THROW(Incision(plane, path_through({{-50, 0, 0}, {-55, 0, 0}}, up, depth)),
               InputError);                                                                 // next to it
  EXPECT_THROW(Incision(plane, path_through({{-5, 0, 0}, {5, 0, 0}}, up, 0)), InputError);  // no depth
  const auto down = [](const Vec3&) { return Vec3{0, 0, -1}; };
  try {
    const Incision refused(plane, path_through({{-5, 0, 0}, {5, 0, 0}}, down, depth));
    FAIL() << "not refused";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("faces the other way"), std::string::npos) << error.what();
  }
}

TEST(Incision, StopsAtPlacesThatAreNotManifold) {
  SurfaceMesh plane = grid(20, 20, -10, -10, 1);
  plane.points.push_back({3, 0.5, 2});  // a fin on the edge from (3, 0) to (3, 1)
  plane.triangles.push_back({10 * 21 + 13, 11 * 21 + 13, static_cast<int>(plane.points.size()) - 1});
  const ScalpelPath path = path_through({{-5, 0.4, 0}, {5, 0.6, 0}}, up, depth);
  Incision incision(plane, path, unrefined());
  const int bad = shape_of(incision.mesh()).bad_edges;
  EXPECT_THROW(incision.advance_to(path.length()), InputError);
  EXPECT_NEAR(incision.tip(), 8, 1.1);
  EXPECT_EQ(shape_of(incision.mesh()).bad_edges, bad);
}

/// Straight cuts from random places on any mesh: they succeed, or say why not, and the mesh stays as sound as
/// it was.
void cut_anywhere(const std::string& file, int attempts, int needed) {
  const SurfaceMesh surface = read_mesh(file);
  Vec3 low = surface.points[0], high = low;
  for (const Vec3& p : surface.points)
    for (int k = 0; k < 3; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
  const double length = 0.02 * norm(high - low);
  const Shape before = shape_of(CutMesh(surface));
  std::mt19937 random(1);
  int succeeded = 0;
  std::string reasons;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    const auto& t = surface.triangles[random() % surface.triangles.size()];
    const Vec3 p[3] = {surface.points[t[0]], surface.points[t[1]], surface.points[t[2]]};
    const Vec3 normal = normalized(cross(p[1] - p[0], p[2] - p[0])), along = normalized(p[1] - p[0]);
    const Vec3 start = 1. / 3 * (p[0] + p[1] + p[2]), side = cross(normal, along);
    std::vector<Vec3> points;
    for (int i = 0; i <= 8; ++i)
      points.push_back(start + length * (i / 8. * along + 0.1 * std::sin(pi * i / 8) * side));
    const ScalpelPath path = path_through(
        points, [&](const Vec3&) { return normal; }, length / 4);
    SCOPED_TRACE(file + ", attempt " + std::to_string(attempt));
    std::optional<Incision> incision;
    try {
      incision.emplace(surface, path, attempt % 2 ? IncisionOptions{} : unrefined());
      incision->advance_to(path.length());
      ++succeeded;
    } catch (const InputError& error) {
      reasons += std::string("\n  ") + error.what();
    }
    if (!incision) continue;
    const Shape after = shape_of(incision->mesh());
    EXPECT_EQ(after.bad_edges, before.bad_edges);
    EXPECT_EQ(after.split_vertices, before.split_vertices);
    EXPECT_EQ(after.euler, before.euler);
    if (before.boundary_edges == 0) {
      EXPECT_EQ(after.boundary_edges, 0);
      EXPECT_NEAR(after.volume, before.volume, 1e-3 * std::abs(before.volume));
    }
  }
  EXPECT_GE(succeeded, needed) << file << reasons;
}

TEST(Incision, CutsFacesAndOrgansAnywhere) {
  namespace fs = std::filesystem;
  if (!fs::exists(CLEFT_SHARED_MESHES)) GTEST_SKIP() << CLEFT_SHARED_MESHES << " is absent";
  for (const char* folder : {"/faces", "/organs"})
    for (const auto& entry : fs::directory_iterator(std::string(CLEFT_SHARED_MESHES) + folder))
      if (entry.path().extension() == ".obj" || entry.path().extension() == ".stl")
        cut_anywhere(entry.path().string(), 6, 2);  // eyelids and fingertips turn away soon
}

TEST(Incision, SurvivesDefectiveMeshes) {
  namespace fs = std::filesystem;
  if (!fs::exists(CLEFT_SHARED_MESHES)) GTEST_SKIP() << CLEFT_SHARED_MESHES << " is absent";
  for (const auto& entry : fs::directory_iterator(CLEFT_SHARED_MESHES "/defective"))
    cut_anywhere(entry.path().string(), 12, 0);
}

}  // namespace
}  // namespace cleft
