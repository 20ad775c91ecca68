#include "solver/patch_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <set>
#include <string>
#include <utility>

#include "base/error.h"
#include "params/consistency.h"
#include "tests/solver/patch_mesh_shapes.h"

namespace cleft {

namespace {

/// Derivatives of a linear wedge's map at (xi, eta) of its triangle and height t (0: lower, 1: upper).
double jacobian(const PatchMesh& mesh, const std::array<int, 6>& w, double xi, double eta, double t) {
  const auto p = [&](int c) { return lerp(mesh.points[w[c]], mesh.points[w[c + 3]], t); };
  const auto rise = [&](int c) { return mesh.points[w[c + 3]] - mesh.points[w[c]]; };
  const Vec3 up = (1 - xi - eta) * rise(0) + xi * rise(1) + eta * rise(2);
  return dot(cross(p(1) - p(0), p(2) - p(0)), up);
}

/// Midpoints of the edges and Gauss points: exact for the quadratic Jacobian.
double volume(const PatchMesh& mesh, const std::array<int, 6>& w) {
  double sum = 0;
  for (const double t : {0.5 - std::sqrt(1 / 12.0), 0.5 + std::sqrt(1 / 12.0)})
    for (const auto& [xi, eta] : {std::pair{0.5, 0.0}, {0.5, 0.5}, {0.0, 0.5}})
      sum += jacobian(mesh, w, xi, eta, t) / 12;
  return sum;
}

Vec3 centre(const PatchMesh& mesh, const std::array<int, 6>& w) {
  Vec3 sum;
  for (const int n : w) sum += mesh.points[n];
  return (1 / 6.0) * sum;
}

using Face = std::vector<int>;  // nodes, sorted

Face face_of(std::vector<int> nodes) {
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

std::vector<Face> faces_of(const std::array<int, 6>& w) {
  std::vector<Face> faces = {face_of({w[0], w[1], w[2]}), face_of({w[3], w[4], w[5]})};
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3;
    faces.push_back(face_of({w[a], w[b], w[a + 3], w[b + 3]}));
  }
  return faces;
}

std::set<Face> boundary(const PatchMesh& mesh) {
  std::set<Face> faces;
  for (const auto& t : mesh.skin) faces.insert(face_of({t.begin(), t.end()}));
  for (const auto& t : mesh.bottom) faces.insert(face_of({t.begin(), t.end()}));
  for (const auto& q : mesh.sides) faces.insert(face_of({q.begin(), q.end()}));
  return faces;
}

/// For every node the first of the copies at its place.
std::vector<int> glued(const PatchMesh& mesh) {
  std::vector<int> first(mesh.points.size());
  std::iota(first.begin(), first.end(), 0);
  for (const NodePair& pair : mesh.pairs) first[pair.right] = first[pair.left];
  return first;
}

bool same(const NodePair& a, const NodePair& b) {
  return a.left == b.left && a.right == b.right && a.normal == b.normal && a.incision == b.incision &&
         a.along == b.along && a.depth == b.depth;
}

void expect_same(const PatchMesh& a, const PatchMesh& b) {
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.wedges, b.wedges);
  EXPECT_EQ(a.skin_above, b.skin_above);
  EXPECT_EQ(a.lines_along, b.lines_along);
  EXPECT_EQ(a.lines_depth, b.lines_depth);
  EXPECT_TRUE(std::equal(a.pairs.begin(), a.pairs.end(), b.pairs.begin(), b.pairs.end(), same));
}

}  // namespace

TEST(PatchMesh, FillsTheBoxWithWedgesAndCoversItsFaces) {
  for (const auto& [name, p] : shapes()) {
    SCOPED_TRACE(name);
    const PatchMesh mesh = make_patch_mesh(p);
    const auto& b = p.patch;
    double sum = 0, top = 0, bottom = 0, sides = 0;
    for (const auto& w : mesh.wedges) {
      sum += volume(mesh, w);
      for (const double t : {0.0, 1.0})
        for (const auto& [xi, eta] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}})
          ASSERT_GT(jacobian(mesh, w, xi, eta, t), 1e-4);
    }
    const auto triangle = [&](const auto& f, double height) {
      for (const int n : f) EXPECT_EQ(mesh.points[n].z, height);
      const double twice =
          cross(mesh.points[f[1]] - mesh.points[f[0]], mesh.points[f[2]] - mesh.points[f[0]]).z;
      EXPECT_GT(twice, 0) << "counter-clockwise from above";
      return twice / 2;
    };
    for (const auto& t : mesh.skin) top += triangle(t, 0);
    for (const auto& t : mesh.bottom) bottom += triangle(t, -b.height);
    for (const auto& q : mesh.sides) {
      const auto on = [&](int axis, double place) {
        return std::all_of(q.begin(), q.end(), [&](int n) { return mesh.points[n][axis] == place; });
      };
      EXPECT_EQ(on(0, -b.length / 2) + on(0, b.length / 2) + on(1, -b.width / 2) + on(1, b.width / 2), 1);
      sides += norm(cross(mesh.points[q[2]] - mesh.points[q[0]], mesh.points[q[3]] - mesh.points[q[1]])) / 2;
    }
    EXPECT_NEAR(sum, b.length * b.width * b.height, 1e-9);
    EXPECT_NEAR(top, b.length * b.width, 1e-9);
    EXPECT_NEAR(bottom, b.length * b.width, 1e-9);
    EXPECT_NEAR(sides, 2 * (b.length + b.width) * b.height, 1e-9);
  }
}

TEST(PatchMesh, WithItsPairsGluedEveryInnerFaceHasTwoWedges) {
  for (const auto& [name, p] : shapes()) {
    SCOPED_TRACE(name);
    const PatchMesh mesh = make_patch_mesh(p);
    const std::vector<int> first = glued(mesh);
    std::map<Face, int> whole;
    std::map<Face, std::set<Face>> lips;  // by glued face: the faces it consists of
    for (const auto& w : mesh.wedges)
      for (const Face& face : faces_of(w)) {
        Face one = face;
        for (int& n : one) n = first[n];
        ++whole[face_of(one)];
        lips[face_of(one)].insert(face);
      }
    std::set<Face> outside;
    for (Face face : boundary(mesh)) {
      for (int& n : face) n = first[n];
      outside.insert(face_of(face));
    }
    std::size_t cut_faces = 0;
    for (const auto& [face, count] : whole) {
      EXPECT_EQ(count, outside.count(face) ? 1 : 2);
      cut_faces += lips[face].size() == 2;
    }
    std::size_t expected = 0;
    for (const auto& lines : mesh.lines_along) expected += (lines.size() - 1) * (mesh.lines_depth.size() - 1);
    EXPECT_EQ(cut_faces, expected) << "the cuts' surfaces, and nothing else, are split";
    EXPECT_EQ(whole.size(), lips.size());
  }
}

/// Around each place of a cut the wedges fall into as many bodies as it has copies, each with one of them.
TEST(PatchMesh, TheLipsAreSeparate) {
  for (const auto& [name, p] : shapes()) {
    SCOPED_TRACE(name);
    const PatchMesh mesh = make_patch_mesh(p);
    const std::vector<int> first = glued(mesh);
    std::map<int, std::set<int>> copies;
    for (const NodePair& pair : mesh.pairs) copies[first[pair.left]].insert({pair.left, pair.right});
    std::map<int, std::vector<const std::array<int, 6>*>> star;
    for (const auto& w : mesh.wedges)
      for (const int n : w) star[first[n]].push_back(&w);
    for (const auto& [place, nodes] : copies) {
      const auto& around = star[place];
      std::vector<std::size_t> body(around.size());
      std::iota(body.begin(), body.end(), 0);
      std::map<Face, std::size_t> seen;
      for (std::size_t a = 0; a < around.size(); ++a)
        for (const Face& face : faces_of(*around[a])) {
          const auto [other, is_new] = seen.insert({face, a});
          if (!is_new) {
            const std::size_t from = body[a], to = body[other->second];
            std::replace(body.begin(), body.end(), from, to);
          }
        }
      std::map<std::size_t, std::set<int>> held;
      for (std::size_t a = 0; a < around.size(); ++a)
        for (const int n : *around[a])
          if (nodes.count(n)) held[body[a]].insert(n);
      EXPECT_EQ(held.size(), nodes.size());
      for (const auto& [one, of_body] : held) EXPECT_EQ(of_body.size(), 1u);
    }
  }
}

TEST(PatchMesh, EveryPairsNormalPointsFromItsLeftWedgesToItsRightOnes) {
  for (const auto& [name, p] : shapes()) {
    SCOPED_TRACE(name);
    const PatchMesh mesh = make_patch_mesh(p);
    std::map<int, std::vector<const NodePair*>> at;
    for (const NodePair& pair : mesh.pairs) at[pair.left].push_back(&pair), at[pair.right].push_back(&pair);
    for (const auto& w : mesh.wedges)
      for (const int n : w)
        for (const NodePair* pair : at[n])
          EXPECT_GT(dot(centre(mesh, w) - mesh.points[n], pair->normal) * (n == pair->right ? 1 : -1), 0);
  }
}

TEST(PatchMesh, PairsLieOnTheirCut) {
  for (const auto& [name, p] : shapes()) {
    SCOPED_TRACE(name);
    const PatchMesh mesh = make_patch_mesh(p);
    const double slope = std::tan(p.cut.tilt * std::numbers::pi / 180), r = p.cut.radius;
    for (const NodePair& pair : mesh.pairs) {
      const Vec3 x = mesh.points[pair.left];
      EXPECT_EQ(x, mesh.points[pair.right]);
      EXPECT_LT(pair.left, pair.right);
      EXPECT_NEAR(x.z, -pair.depth, 1e-12);
      EXPECT_NEAR(norm(pair.normal), 1, 1e-12);
      const double on_skin = x.y - pair.depth * slope;  // up the tilted blade
      if (p.cut.branch > 0 && pair.incision == 1) {
        EXPECT_EQ(x.x, 0);
        EXPECT_NEAR(on_skin, pair.along, 1e-12);
        EXPECT_EQ(pair.normal, (Vec3{1, 0, 0}));
        continue;
      }
      const double middle = (pair.incision - (p.cut.count - 1) / 2) * p.cut.spacing;
      Vec3 tangent{1, 0, 0};
      if (r > 0) {  // a circle about (0, middle + r)
        const double dx = x.x, dy = middle + r - on_skin;
        EXPECT_NEAR(std::hypot(dx, dy), r, 1e-12);
        EXPECT_NEAR(r * std::atan2(dx, dy), pair.along, 1e-12);
        tangent = {dy, dx, 0};
      } else {
        EXPECT_NEAR(on_skin, middle, 1e-12);
        EXPECT_NEAR(x.x, pair.along, 1e-12);
      }
      EXPECT_NEAR(dot(pair.normal, tangent), 0, 1e-12);
      EXPECT_NEAR(dot(pair.normal, {0, slope, -1}), 0, 1e-12);
      EXPECT_GT(pair.normal.y, 0);
    }
  }
}

TEST(PatchMesh, ThePairsAreThoseOfAllInnerLinesInOrder) {
  for (const auto& [name, p] : shapes()) {
    SCOPED_TRACE(name);
    const PatchMesh mesh = make_patch_mesh(p);
    const double length = p.mesh.cut_length > 0 ? p.mesh.cut_length : p.cut.length;
    const double depth = p.mesh.cut_depth > 0 ? p.mesh.cut_depth : p.cut.depth;
    ASSERT_EQ(static_cast<int>(mesh.lines_along.size()), incisions(p));
    EXPECT_EQ(mesh.lines_depth.front(), 0);
    EXPECT_EQ(mesh.lines_depth.back(), depth);
    std::size_t n = 0;
    for (int incision = 0; incision < incisions(p); ++incision) {
      const bool branch = p.cut.branch > 0 && incision == 1;
      const std::vector<double>& lines = mesh.lines_along[incision];
      EXPECT_EQ(lines.front(), branch ? 0 : -length / 2);
      EXPECT_EQ(lines.back(), branch ? p.cut.branch : length / 2);
      for (std::size_t a = 1; a < lines.size(); ++a)
        EXPECT_NEAR(lines[a] - lines[a - 1], (lines.back() - lines.front()) / (lines.size() - 1.0), 1e-12);
      // Under a tilted blade they are shorter along the first cut.
      const double longest =
          p.mesh.element_size * (branch ? 1 : std::cos(p.cut.tilt * std::numbers::pi / 180));
      EXPECT_LE(lines[1] - lines[0], longest + 1e-9);
      const double fewer =
          p.cut.branch > 0 && !branch ? 3 : 2;  // a branch has a line in the middle of the cut
      EXPECT_GT((lines.back() - lines.front()) / (lines.size() - fewer), longest);
      for (std::size_t a = branch ? 0 : 1; a + 1 < lines.size(); ++a)
        for (std::size_t d = 0; d + 1 < mesh.lines_depth.size(); ++d, ++n) {
          ASSERT_LT(n, mesh.pairs.size());
          EXPECT_EQ(mesh.pairs[n].incision, incision);
          EXPECT_EQ(mesh.pairs[n].along, lines[a]);
          EXPECT_EQ(mesh.pairs[n].depth, mesh.lines_depth[d]);
        }
    }
    EXPECT_EQ(n, mesh.pairs.size());
  }
}

TEST(PatchMesh, TheSkinAboveANodeIsOnItsSideOfTheCut) {
  for (const auto& [name, p] : shapes()) {
    SCOPED_TRACE(name);
    const PatchMesh mesh = make_patch_mesh(p);
    ASSERT_EQ(mesh.skin_above.size(), mesh.points.size());
    std::set<int> skin;
    for (const auto& t : mesh.skin) skin.insert(t.begin(), t.end());
    for (std::size_t n = 0; n < mesh.points.size(); ++n) {
      const int above = mesh.skin_above[n];
      EXPECT_TRUE(skin.count(above));
      EXPECT_EQ(mesh.points[above].x, mesh.points[n].x);
      EXPECT_EQ(mesh.points[above].z, 0);
      if (p.cut.tilt == 0) {
        EXPECT_NEAR(mesh.points[above].y, mesh.points[n].y, 1e-12);
      }
      if (skin.count(static_cast<int>(n))) {
        EXPECT_EQ(above, static_cast<int>(n));
      }
    }
    for (const auto& w : mesh.wedges)
      for (int c = 0; c < 3; ++c) {
        if (mesh.points[w[c]].z > -mesh.lines_depth.back()) {
          EXPECT_EQ(mesh.skin_above[w[c]], mesh.skin_above[w[c + 3]]) << "a wedge reaches over no cut";
        }
      }
  }
}

TEST(PatchMesh, TheSkinOfAStraightCutIsItsOwnMirrorImage) {
  Parameters graded = awkward_patch(), two = small_patch(), odd = small_patch();
  graded.mesh.grading = 1.3;
  two.cut.count = 2, two.cut.spacing = 2;
  odd.cut.length = 4.7;
  for (const TissueFormulation formulation :
       {TissueFormulation::displacement, TissueFormulation::mean_dilatation}) {
    const bool stripes = formulation == TissueFormulation::displacement;
    int even = 0;
    for (Parameters p : {small_patch(), graded, two, odd}) {
      p.tissue.formulation = formulation;
      const PatchMesh mesh = make_patch_mesh(p);
      using Corners = std::set<std::pair<long, long>>;
      const auto triangles = [&](double sign_u, double sign_v) {
        std::set<Corners> all;
        for (const auto& t : mesh.skin) {
          Corners corners;
          for (const int n : t)
            corners.insert(
                {std::lround(sign_u * mesh.points[n].x * 1e9), std::lround(sign_v * mesh.points[n].y * 1e9)});
          all.insert(corners);
        }
        return all;
      };
      EXPECT_EQ(triangles(1, 1), triangles(1, -1));
      if (mesh.grid[0] % 2 == 0) continue;  // lines, one more than squares
      ++even;
      EXPECT_EQ(triangles(1, 1) == triangles(-1, 1), !stripes);
    }
    EXPECT_GE(even, 2);
    EXPECT_LT(even, 4);
  }
}

TEST(PatchMesh, DiagonalsMakeStripesAndInNearlyIncompressibleTissueAChessBoard) {
  Parameters p = awkward_patch();
  p.mesh.grading = 1.3;
  for (const auto& [formulation, poisson] : {std::pair{TissueFormulation::displacement, 0.4},
                                             {TissueFormulation::mean_dilatation, 0.4},
                                             {TissueFormulation::mean_dilatation, 0.49}})
    for (const double tilt : {0., 20.}) {
      p.tissue.formulation = formulation, p.tissue.poisson_ratio = poisson, p.cut.tilt = tilt;
      const bool stripes = !has_chess_board(p);
      EXPECT_EQ(stripes, formulation == TissueFormulation::displacement || (tilt > 0 && poisson < 0.45));
      const PatchMesh mesh = make_patch_mesh(p);
      const std::vector<int> first = glued(mesh);
      std::map<int, int> met;
      std::map<std::pair<int, int>, std::set<bool>> rises;  // by square
      int start = -1;
      for (const auto& t : mesh.skin) {
        std::array<std::array<int, 2>, 3> lines;
        for (int c = 0; c < 3; ++c) {
          const int n = first[t[c]];
          ++met[n];
          lines[c] = {n % mesh.grid[0], n / mesh.grid[0]};
          if (mesh.points[n] == mesh.start) start = n;
        }
        const int i = std::min({lines[0][0], lines[1][0], lines[2][0]});
        const int j = std::min({lines[0][1], lines[1][1], lines[2][1]});
        for (int c = 0; c < 3; ++c) {
          const auto &a = lines[c], &b = lines[(c + 1) % 3];
          if (a[0] != b[0] && a[1] != b[1]) rises[{i, j}].insert((a[0] < b[0]) == (a[1] < b[1]));
        }
      }
      ASSERT_GE(start, 0);
      ASSERT_EQ(rises.size(), static_cast<std::size_t>((mesh.grid[0] - 1) * (mesh.grid[1] - 1)));
      const int i0 = start % mesh.grid[0], j0 = start / mesh.grid[0];
      for (const auto& [square, directions] : rises) {
        const auto [i, j] = square;
        const bool expected = ((stripes ? 0 : i - i0) + j - j0) % 2 == 0;
        EXPECT_EQ(directions, std::set<bool>{expected})
            << static_cast<int>(formulation) << ", square " << i << ", " << j;
      }
      for (const auto& [n, count] : met) {
        const Vec3& at = mesh.points[n];
        if (std::abs(at.x) == p.patch.length / 2 || std::abs(at.y) == p.patch.width / 2) continue;
        EXPECT_TRUE(stripes ? count == 6 : count == 8 || count == 4) << count;
      }
    }
}

TEST(PatchMesh, ABranchLeavesTheMiddleByNodesWithThreeCopies) {
  for (const auto& [name, p] : shapes()) {
    if (p.cut.branch == 0) continue;
    SCOPED_TRACE(name);
    const PatchMesh mesh = make_patch_mesh(p);
    std::map<int, int> right_of_first, left_count;
    int junctions = 0;
    for (const NodePair& pair : mesh.pairs)
      if (pair.incision == 0) right_of_first[pair.right] = pair.left;
    for (const NodePair& pair : mesh.pairs) {
      if (pair.incision == 0 || pair.along > 0) continue;
      ++junctions;
      ASSERT_TRUE(right_of_first.count(pair.left)) << "the branch splits the right node";
      const int left = right_of_first[pair.left];
      for (const auto& w : mesh.wedges)
        for (const int n : w) {
          const Vec3 d = centre(mesh, w) - mesh.points[n];
          if (n == pair.left) {
            EXPECT_TRUE(d.x < 0);
          }
          if (n == pair.right) {
            EXPECT_TRUE(d.x > 0);
          }
          if (n == left) ++left_count[d.x > 0];
        }
    }
    EXPECT_EQ(junctions, static_cast<int>(mesh.lines_depth.size()) - 1);
    EXPECT_TRUE(left_count[0] > 0 && left_count[1] > 0) << "the left lip is whole";
  }
}

TEST(PatchMesh, ARightNodeIsTheLeftOneOfLaterPairsOnly) {
  for (const auto& [name, p] : shapes()) {
    SCOPED_TRACE(name);
    std::set<int> lefts, rights;
    for (const NodePair& pair : make_patch_mesh(p).pairs) {
      EXPECT_FALSE(lefts.count(pair.right));
      EXPECT_TRUE(rights.insert(pair.right).second) << "a node is a right one once";
      lefts.insert(pair.left);
    }
  }
}

TEST(PatchMesh, DependsOnTheLargestCutAlone) {
  for (auto [name, p] : shapes()) {
    SCOPED_TRACE(name);
    const PatchMesh own = make_patch_mesh(p);
    if (p.mesh.cut_length == 0) p.mesh.cut_length = p.cut.length;
    if (p.mesh.cut_depth == 0) p.mesh.cut_depth = p.cut.depth;
    expect_same(own, make_patch_mesh(p));
    p.cut.length = std::max(0.6 * p.cut.length, 2 * p.mesh.element_size), p.cut.depth *= 0.7;
    check_consistency(p, name);
    expect_same(own, make_patch_mesh(p));
  }
}

TEST(PatchMesh, RefusesShapesThatWouldFlattenElements) {
  const auto message = [](const Parameters& p) -> std::string {
    try {
      make_patch_mesh(p);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  };
  Parameters arc = small_patch(), tilted = small_patch(), folded = small_patch(), back = small_patch();
  arc.cut.radius = 2.5, arc.patch.width = 3.3;  // rises by 1.59 mm of 1.65 mm
  tilted.cut.tilt = 60, tilted.patch.width = 8;
  back.cut.tilt = -60, back.patch.width = 8;
  folded.cut.radius = 1.5, folded.patch.width = 20;  // the ends pass 90 degrees
  for (const Parameters& p : {arc, tilted, back, folded}) {
    EXPECT_NE(message(p).find("cut.radius = "), std::string::npos) << message(p);
    EXPECT_NE(message(p).find("raise patch.width"), std::string::npos) << message(p);
    EXPECT_THROW(check_consistency(p, "here"), InputError);
  }
  arc.patch.width = tilted.patch.width = back.patch.width = 10;
  arc.cut.radius = 3;
  for (const Parameters& p : {arc, tilted, back}) {
    EXPECT_EQ(message(p), "");
    EXPECT_NO_THROW(check_consistency(p, "here"));
  }
}

}  // namespace cleft
