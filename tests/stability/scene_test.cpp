// Where cutting a mesh, and opening the cut, meet their limits.
#include <gtest/gtest.h>

#include <cmath>

#include "encoder/field/file/field_file.h"
#include "explorer/incision/triangle_quality.h"
#include "explorer/wound/replay.h"
#include "explorer/wound/validity.h"
#include "tests/incision/meshes.h"
#include "tests/support/stability_row.h"
#include "tests/support/temporary_folder.h"
#include "tests/wound/fields.h"

namespace cleft {
namespace {

using namespace testing;

const CanonicalCut canonical{-5, 10, 3};
constexpr double half_width = 8;

Field wound() { return opening_field(canonical, 20, 2 * half_width, 6, 2); }

ScalpelPath arc(double radius, double length) {
  std::vector<Vec3> points;
  for (int i = -20; i <= 20; ++i) {
    const double a = length / 2 * i / 20 / radius;
    points.push_back({radius * std::sin(a), radius * (1 - std::cos(a)), 0});
  }
  return path_through(points, up, canonical.depth);
}

/// The gaps of the whole cut, between its `ends` mm.
std::vector<double> gaps(const Field& field, const Incision& incision, double ends = 0) {
  const double length = incision.path().length();
  const Replay replay(Wound(incision, field, 1));
  std::vector<Vec3> moved(replay.vertex_count());
  replay.positions(length, moved);
  std::vector<double> result;
  for (const auto& c : incision.chain())
    if (c.s >= ends && c.s <= length - ends) result.push_back(norm(moved[c.right] - moved[c.left]));
  return result;
}

double largest(const std::vector<double>& values) { return *std::max_element(values.begin(), values.end()); }
double least(const std::vector<double>& values) { return *std::min_element(values.begin(), values.end()); }

struct Bend {
  double jump = 0;        ///< mm: of u between neighbours of the skin, at most
  double moved_jump = 0;  ///< the same of displacements
  std::string warning;
};

/// Cut into squares of 1 / parts mm.
Bend bend(double radius, int parts) {
  IncisionOptions unrefined;
  unrefined.max_edge = 0;
  Incision incision(grid(50 * parts, 40 * parts, -25 + 0.013, -20 + 0.017, 1. / parts), arc(radius, 10),
                    unrefined);
  incision.advance_to(incision.path().length());
  const Field field = wound();
  const Wound wound(incision, field, 1);
  std::vector<std::optional<ActiveVertex>> places(incision.mesh().vertices().size());
  std::vector<Vec3> displacement(places.size());
  for (std::size_t v = 0; v < places.size(); ++v)
    if ((places[v] = wound.volume.locate(static_cast<int>(v))))
      displacement[v] = places[v]->in_mesh(field.displacement(places[v]->uvw, places[v]->side, 10));
  Bend result;
  for (const CutMesh::Triangle& t : incision.mesh().triangles()) {
    if (t.region != Region::skin) continue;
    for (int i = 0; i < 3; ++i) {
      const auto a = static_cast<std::size_t>(t.vertex[i]),
                 b = static_cast<std::size_t>(t.vertex[(i + 1) % 3]);
      const auto at_tip = [&](std::size_t v) {  // where the opening falls as a root does
        return places[v] && std::abs(places[v]->uvw.x) > 4 && std::abs(places[v]->uvw.y) < 1;
      };
      if (!at_tip(a) && !at_tip(b))
        result.moved_jump = std::max(result.moved_jump, norm(displacement[a] - displacement[b]));
      if (places[a] && places[b])
        result.jump = std::max(result.jump, std::abs(places[a]->uvw.x - places[b]->uvw.x));
    }
  }
  const auto warnings = validity_of({&wound}, true).front().warnings;
  if (!warnings.empty()) result.warning = warnings.front();
  return result;
}

}  // namespace

TEST(SceneLimits, TightBends) {
  const Bend straight = bend(1000, 4), coarse = bend(3, 2), fine = bend(3, 4);
  EXPECT_EQ(straight.warning, "");
  EXPECT_NE(fine.warning, "");
  EXPECT_GT(fine.jump, 4 * straight.jump);
  EXPECT_GT(fine.jump, 0.7 * coarse.jump);              // a jump is one on any mesh
  EXPECT_LT(fine.moved_jump, 0.6 * coarse.moved_jump);  // what is smooth falls by half
  record_limit(
      {.method = "canonical coordinates next to a path",
       .limit = "a bend tighter than the patch is wide",
       .shown = "in a bend of 3 mm, half the patch 8 mm wide, u of neighbours 0.5 and 0.25 mm apart jumps "
                "by " +
                rounded(coarse.jump) + " and " + rounded(fine.jump) +
                " mm (straight: " + rounded(straight.jump) + "), displacements by " +
                rounded(coarse.moved_jump) + " and " + rounded(fine.moved_jump) + " mm",
       .noticed = "`cleft cut` warns: " + quoted(fine.warning, "the path bends"),
       .then = "inside the bend displacements fall to zero before the nearest place jumps"});
}

TEST(SceneLimits, Slivers) {
  SurfaceMesh plane = grid(20, 20, -10, -10, 1);
  for (Vec3& p : plane.points)
    if (p.y == 0) p.y = 1 - 1e-10;
  const Shape whole = shape_of(CutMesh(plane));
  const double before = smallest_radius_ratio(CutMesh(plane));
  Incision incision(plane, path_through({{-5, 0.4, 0}, {5, 1.6, 0}}, up, canonical.depth));
  incision.advance_to(incision.path().length());
  const Shape shape = shape_of(incision.mesh());
  EXPECT_LT(before, 1e-9);
  EXPECT_DOUBLE_EQ(incision.tip(), incision.path().length());
  EXPECT_EQ(shape.euler, whole.euler);
  EXPECT_EQ(shape.bad_edges + shape.split_vertices, 0);
  EXPECT_NEAR(shape.skin_area / whole.skin_area, 1, 1e-12);
  const double worse = smallest_radius_ratio(incision.mesh()) / before;
  EXPECT_GT(worse, 0.1);
  record_limit(
      {.method = "cutting triangle after triangle",
       .limit = "slivers",
       .shown = "across a row of triangles 1 mm long and 1e-10 mm high the cut reaches its end; area, "
                "Euler characteristic and edges are kept; the smallest radius ratio becomes " +
                rounded(worse) + " times that of the given mesh",
       .noticed = "sides of edges are decided by exact predicates",
       .then = "slivers that a cut makes are repaired, given ones remain"});
}

TEST(SceneLimits, LongPaths) {
  const TemporaryFolder folder;
  constexpr double length = 1000;
  Incision incision(grid(1020, 20, -10, -10, 1),
                    path_through({{0.3, 0.4, 0}, {length + 0.3, 0.4, 0}}, up, canonical.depth),
                    {.max_edge = 0, .chord_tolerance = {}});
  incision.advance_to(incision.path().length());
  const Field field = wound();  // no quantum: its file holds floats
  write_field(folder / "case.dffd", field);
  const std::vector<double> exact = gaps(field, incision, 6),
                            single = gaps(read_field(folder / "case.dffd"), incision, 6);
  ASSERT_GT(exact.size(), 900u);
  EXPECT_LT(largest(exact) - least(exact), 1e-12);
  double change = 0;
  for (std::size_t i = 0; i < exact.size(); ++i)
    change = std::max(change, std::abs(single[i] / exact[i] - 1));
  EXPECT_LT(change, 1.2e-7);  // two roundings to 24 bits
  EXPECT_GT(change, 0);
  double place = 0;
  for (const auto& c : incision.chain()) {
    const double x = incision.mesh().position(c.left).x;
    place = std::max(place, std::abs(static_cast<float>(x) - x));
  }
  record_limit(
      {.method = "fields of 32 bits",
       .limit = "paths much longer than the field's cut",
       .shown =
           "on a path of 1000 mm the gape of a file of floats differs from that of doubles by less than " +
           power_of_ten(change) +
           " of itself everywhere; places in 32 bits, as the window draws "
           "them, are off by less than " +
           power_of_ten(place) + " mm",
       .noticed = "not needed: floats are canonical displacements, never places",
       .then = "places and the path's s are doubles up to the picture"});
}

TEST(SceneLimits, FarFromTheOrigin) {
  const auto gape_at = [](double far) {
    SurfaceMesh plane = grid(30, 20, -15, -10, 1);
    for (Vec3& p : plane.points) p.x += far;
    Incision incision(plane, path_through({{far - 5, 0.4, 0}, {far + 5, 0.6, 0}}, up, canonical.depth));
    incision.advance_to(incision.path().length());
    EXPECT_EQ(shape_of(incision.mesh()).bad_edges, 0);
    return largest(gaps(wound(), incision));
  };
  const double here = gape_at(0), at_a_kilometre = gape_at(1e6), beyond = gape_at(1e12);
  EXPECT_NEAR(at_a_kilometre / here, 1, 1e-9);  // 1e6 mm in units of the last place of doubles
  EXPECT_NEAR(beyond / here, 1, 1e-3);
  record_limit(
      {.method = "coordinates of a mesh",
       .limit = "a mesh far from the origin",
       .shown =
           "gape of the same cut 1e6 mm away: off by less than 1e-9 of itself; 1e12 mm away: less than " +
           power_of_ten(beyond / here - 1),
       .noticed = "not noticed",
       .then = "the cut is made nevertheless"});
}

}  // namespace cleft
