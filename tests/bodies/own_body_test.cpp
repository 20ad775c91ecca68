// Meshes of one's own: what bodies become of them, against the patch, and what is refused.
#include "explorer/body/own_body.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "base/error.h"
#include "tests/support/patch_body.h"

namespace cleft {

namespace {

constexpr int triangle = 5, quad = 9, tetrahedron = 10, hexahedron = 12, wedge = 13, quadratic_wedge = 26;

Parameters small_patch() {
  Parameters p;
  p.patch = {24, 20, 6};
  p.mesh.element_size = 2;
  p.cut.length = 12, p.cut.depth = 3;
  return p;
}

ScalpelPath straight(const Vec3& from, const Vec3& to) {
  return ScalpelPath({{from, {0, 0, 1}, 1}, {to, {0, 0, 1}, 1}});
}

/// Its cells and its skin, nothing else, in a random order; nodes keep their numbers.
OwnBodyRequest request_of(const Body& body, const std::vector<ScalpelPath>& paths) {
  OwnBodyRequest request;
  request.mesh.name = "own.vtu";
  request.mesh.points = body.points;
  std::vector<std::pair<int, std::vector<int>>> cells;
  for (const auto& t : body.skin) cells.push_back({triangle, {t[0], t[2], t[1]}});
  for (const auto& w : body.wedges) cells.push_back({wedge, {w[1], w[2], w[0], w[4], w[5], w[3]}});
  std::shuffle(cells.begin(), cells.end(), std::mt19937(5));
  for (const auto& [type, nodes] : cells)
    request.mesh.types.push_back(type), request.mesh.nodes.push_back(nodes);
  request.paths = paths;
  request.parameters = small_patch();
  return request;
}

OwnBodyRequest plate() {
  return request_of(body_of_patch(small_patch(), flat), {straight({-6, 0, 0}, {6, 0, 0})});
}

/// A block of cubes of 1 mm, 8 by 4 by 3, whose middle is cut from x = -2 to the end of the block, 2 deep.
OwnBodyRequest cubes(bool in_wedges) {
  OwnBodyRequest request;
  OwnMesh& m = request.mesh;
  m.name = "cubes.vtu";
  const auto number = [](int i, int j, int k) { return (k * 5 + j) * 9 + i; };
  for (int k = 0; k <= 3; ++k)
    for (int j = 0; j <= 4; ++j)
      for (int i = 0; i <= 8; ++i) m.points.push_back({i - 4., j - 2., -1. * k});
  const int single = static_cast<int>(m.points.size());
  const auto is_doubled = [](int i, int j, int k) { return j == 2 && i > 2 && k < 2; };
  std::vector<int> copy(single, -1);
  for (int k = 0; k <= 3; ++k)
    for (int i = 0; i <= 8; ++i)
      if (is_doubled(i, 2, k)) {
        copy[number(i, 2, k)] = static_cast<int>(m.points.size());
        m.points.push_back(m.points[number(i, 2, k)]);
      }
  const auto node = [&](int i, int j, int k, bool beyond) {
    const int n = number(i, j, k);
    return beyond && copy[n] >= 0 ? copy[n] : n;
  };
  const auto add = [&](int type, std::vector<int> nodes) {
    m.types.push_back(type), m.nodes.push_back(nodes);
  };
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 8; ++i)
      for (int k = 0; k < 3; ++k) {
        std::vector<int> lower, upper;
        for (const auto& [a, b] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
          upper.push_back(node(i + a, j + b, k, j >= 2)), lower.push_back(node(i + a, j + b, k + 1, j >= 2));
        if (in_wedges) {
          add(wedge, {lower[0], lower[1], lower[2], upper[0], upper[1], upper[2]});
          add(wedge, {lower[0], lower[2], lower[3], upper[0], upper[2], upper[3]});
          if (k == 0)
            add(triangle, {upper[0], upper[1], upper[2]}), add(triangle, {upper[0], upper[2], upper[3]});
        } else {
          add(hexahedron, {lower[0], lower[1], lower[2], lower[3], upper[0], upper[1], upper[2], upper[3]});
          if (k == 0) add(quad, upper);
        }
      }
  request.paths = {straight({-2, 0, 0}, {4, 0, 0})};
  request.parameters = small_patch();
  return request;
}

std::string refusal_of(const OwnBodyRequest& request) {
  try {
    own_body(request);
  } catch (const InputError& e) {
    return e.what();
  }
  return "nothing was refused";
}

#define EXPECT_REFUSED(request, part) EXPECT_PRED_FORMAT2(testing::IsSubstring, part, refusal_of(request))

}  // namespace

/// A patch, of which only cells and skin are given, is the patch: its pairs, in the order and at the times at
/// which they open there, its faces and its coordinates. Of a branch too, where three nodes have one place.
TEST(OwnBody, APatchIsWhatItWas) {
  for (const double branch : {0., 6.}) {
    Parameters p = small_patch();
    p.cut.branch = branch;
    const Body patch = body_of_patch(p, flat);
    std::vector<ScalpelPath> paths = {straight({-6, 0, 0}, {6, 0, 0})};
    if (branch > 0) paths.push_back(straight({0, 0, 0}, {0, branch, 0}));
    OwnBodyReport report;
    const Body own = own_body(request_of(patch, paths), &report);
    ASSERT_EQ(own.points, patch.points);
    ASSERT_EQ(own.pairs.size(), patch.pairs.size());
    for (std::size_t n = 0; n < own.pairs.size(); ++n) {
      const BodyPair &a = own.pairs[n], &b = patch.pairs[n];
      EXPECT_EQ(a.cut, b.cut) << n;
      EXPECT_NEAR(a.depth, b.depth, 1e-9);
      if (a.cut == 0) {
        EXPECT_EQ(a.left, b.left) << n;
        EXPECT_EQ(own.points[a.right], own.points[b.right]) << n;
        EXPECT_LT(norm(a.normal - b.normal), 1e-9);
      } else {  // of a patch's branch left is at u < 0, which is the right of its path
        EXPECT_EQ(a.left, b.right) << n;
        EXPECT_EQ(a.right, b.left) << n;
        EXPECT_LT(norm(a.normal + b.normal), 1e-9);
      }
      if (branch == 0) EXPECT_EQ(a.right, b.right) << n;
    }
    EXPECT_EQ(own.released, patch.released);
    for (std::size_t f = 0; f < patch.times.size(); ++f) {
      EXPECT_NEAR(own.times[f], patch.times[f], 1e-6) << f;
      if (branch == 0) EXPECT_NEAR(own.position[f], patch.position[f], 1e-6) << f;
    }
    EXPECT_NEAR(own.length, patch.length, 1e-9);
    EXPECT_NEAR(own.depth, patch.depth, 1e-9);
    EXPECT_EQ(own.wedges.size(), patch.wedges.size());
    EXPECT_EQ(own.bottom.size(), patch.bottom.size());
    EXPECT_EQ(own.sides.size(), patch.sides.size());
    for (std::size_t n = 0; n < own.points.size(); ++n) {
      EXPECT_LT(norm(own.canonical[n] - patch.canonical[n]), 1e-6) << n;
      EXPECT_EQ(own.points[own.skin_above[n]].x, own.points[n].x);
    }
    EXPECT_EQ(report.cuts.size(), paths.size());
  }
}

/// A path that is drawn from node to node, or too long, is taken as far as the mesh's cut goes.
TEST(OwnBody, APathIsAsLongAsItsWalls) {
  const Body patch = body_of_patch(small_patch(), flat);
  for (const double half : {5., 6.4, 8.}) {
    const Body own = own_body(request_of(patch, {straight({-half, 0, 0}, {half, 0, 0})}));
    EXPECT_NEAR(own.length, patch.length, 1e-6) << half;
    for (std::size_t f = 0; f < patch.times.size(); ++f) EXPECT_NEAR(own.times[f], patch.times[f], 1e-6);
  }
}

/// Each hexahedron becomes two wedges; a cut that begins at the end of the block has no front there.
TEST(OwnBody, HexahedraBecomeWedges) {
  const Body hexahedra = own_body(cubes(false)), wedges = own_body(cubes(true));
  EXPECT_EQ(hexahedra.wedges.size(), 2U * 8 * 4 * 3);
  EXPECT_EQ(hexahedra.wedges, wedges.wedges);
  EXPECT_EQ(hexahedra.pairs.size(), 6U * 2);
  EXPECT_EQ(hexahedra.sides, wedges.sides);
  EXPECT_NEAR(hexahedra.length, 6 - front_parts(small_patch()).end, 1e-9);
  EXPECT_NEAR(hexahedra.depth, 2 - front_parts(small_patch()).bottom, 1e-9);
}

/// A number for each node says when it opens: here the deeper nodes of a column later.
TEST(OwnBody, AnArrayMayGiveTheOrder) {
  OwnBodyRequest request = plate();
  for (const Vec3& p : request.mesh.points) request.release.push_back(7 + p.x - 2 * p.z);
  const Body own = own_body(request);
  for (std::size_t f = 1; f < own.times.size(); ++f)
    for (int n = own.released[f - 1]; n < own.released[f]; ++n)
      EXPECT_EQ(own.times[f], request.release[own.pairs[n].left]);
  EXPECT_EQ(own.released.back(), static_cast<int>(own.pairs.size()));
  request.release[own.pairs.front().right] += 1;
  EXPECT_REFUSED(request, "the mm cut when they part");
}

TEST(OwnBody, RegionsHaveMaterials) {
  OwnBodyRequest request = plate();
  for (std::size_t c = 0; c < request.mesh.types.size(); ++c) {
    double z = 0;
    for (const int n : request.mesh.nodes[c]) z += request.mesh.points[n].z / 6;
    request.mesh.regions.push_back(request.mesh.types[c] == triangle ? 1 : z < -3 ? 40 : 41);
  }
  RegionFile& file = request.regions.emplace();
  file.sections = {{{"fat", 0.01}, {41}, {}, "m.toml, line 1"},
                   {{"muscle", {}, 0.4}, {40}, {}, "m.toml, line 4"}};
  OwnBodyReport report;
  const Body own = own_body(request, &report);
  ASSERT_EQ(own.materials.size(), 2U);
  for (std::size_t w = 0; w < own.wedges.size(); ++w) {
    double z = 0;
    for (const int n : own.wedges[w]) z += own.points[n].z / 6;
    EXPECT_EQ(own.region[w], z < -3 ? 1 : 0);
  }
  EXPECT_EQ(report.regions[0].wedges + report.regions[1].wedges, static_cast<int>(own.wedges.size()));
  EXPECT_EQ(own.materials[1].poisson_ratio, 0.4);
  file.faces = FaceRegions{{2}, {}, {}};
  EXPECT_REFUSED(request, "[faces]: skin = 2, and no face of");
  file.faces = FaceRegions{{1}, {40}, {}};  // a number of cells
  EXPECT_REFUSED(request, "[faces]: bone = 40, and no face of");
  file.faces = FaceRegions{{1}, {}, {3}};
  EXPECT_REFUSED(request, "(there are 1): correct it, or leave it out");
  file.faces = FaceRegions{{1}, {}, {}};
  EXPECT_EQ(own_body(request).skin, own.skin);
  file.sections[1].regions = {40, 39};
  EXPECT_REFUSED(request, "m.toml, line 4: [muscle]: region = 39, and no cell of tissue of");
  EXPECT_REFUSED(request, "(there are 40, 41): correct it, or leave it out");
  file.sections.pop_back();
  EXPECT_REFUSED(request, "region 40");
  EXPECT_REFUSED(request, "has no material; add region = 40");
  file.sections.push_back({{"muscle", {}, 0.4}, {41}, {}, "m.toml, line 4"});
  EXPECT_REFUSED(request, "m.toml, line 4: region 41 has two materials");
  request.mesh.regions.clear();
  EXPECT_REFUSED(request, "has no array of the cells");
}

TEST(OwnBody, WhatCannotBeSolvedIsRefusedWithPlaceAndRemedy) {
  const auto first = [](const OwnBodyRequest& r, int type) {
    return std::find(r.mesh.types.begin(), r.mesh.types.end(), type) - r.mesh.types.begin();
  };
  const Body good = own_body(plate());
  OwnBodyRequest request = plate();
  request.mesh.types.push_back(tetrahedron), request.mesh.nodes.push_back({0, 1, 2, 3});
  EXPECT_REFUSED(request, "is a tetrahedron (VTK's type 10)");
  request = plate();
  request.mesh.types[first(request, wedge)] = quadratic_wedge;
  EXPECT_REFUSED(request, "Mesh.ElementOrder = 1");
  request = plate();
  const auto cell = first(request, wedge);
  request.mesh.points[request.mesh.nodes[cell].front()].z += 50;
  EXPECT_REFUSED(request, "turned inside out");
  request = plate();
  request.mesh.points[good.pairs[3].right].x += 1e-3;
  EXPECT_REFUSED(request, "must be at one place");
  request = plate();
  request.mesh.types[first(request, triangle)] = 1;
  EXPECT_REFUSED(request, "does not hang from the skin");
  request = plate();
  request.paths = {straight({-6, 5, 0}, {6, 5, 0})};
  EXPECT_REFUSED(request, "from the nearest path");
  request = plate();
  request.paths.push_back(straight({-6, 5, 0}, {6, 5, 0}));
  EXPECT_REFUSED(request, "no walls with doubled nodes along path 2");
}

}  // namespace cleft
