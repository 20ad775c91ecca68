#include "explorer/body/body_maker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>

#include "base/error.h"
#include "explorer/body/simulate.h"
#include "tests/bodies/subjects.h"

namespace cleft {

namespace {

using testing::path_on, testing::sheet;

Parameters coarse() {
  Parameters p;
  p.mesh.element_size = 1.5, p.mesh.grading = 1.5, p.patch.height = 6;
  return p;
}

BodyRequest request(const testing::Bend& bend,
                    const std::vector<std::vector<std::pair<double, double>>>& paths) {
  BodyRequest r;
  r.skin = sheet(bend, 40, 40, 2, 0.25);
  for (const auto& places : paths) r.paths.push_back(path_on(bend, places, 2.5));
  r.parameters = coarse(), r.reach = 12;
  return r;
}

std::vector<std::pair<double, double>> circle(double radius) {
  std::vector<std::pair<double, double>> places;
  for (int i = 0; i <= 48; ++i) {
    const double angle = 2 * std::numbers::pi * (i % 48) / 48;
    places.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return places;
}

const std::vector<std::pair<double, double>> along = {{-10, 0}, {0, 0}, {10, 0}},
                                             across = {{0, -8}, {0, 0}, {0, 8}}, branch = {{0, 0}, {0, 9}};

struct Made {
  std::string name;
  BodyRequest request;
  Body body;
  BodyReport report;
};

std::vector<Made> all_made() {
  std::vector<Made> made;
  const testing::Bend ball = testing::sphere_cap(60), roll = testing::cylinder_along(40);
  for (auto& [name, r] : std::initializer_list<std::pair<std::string, BodyRequest>>{
           {"a line", request(testing::flat, {along})},
           {"around a cylinder", request(roll, {across})},
           {"an X", request(testing::flat, {along, across})},
           {"an X on a sphere", request(ball, {along, across})},
           {"a T", request(testing::flat, {along, branch})},
           {"a circle", request(ball, {circle(7)})}}) {
    made.push_back({name, r, {}, {}});
    made.back().body = make_body(made.back().request, &made.back().report);
  }
  return made;
}

/// Vertices less edges plus faces less cells of what the wedges are joined to.
int euler_number(const Body& body) {
  std::set<int> nodes;
  std::set<std::vector<int>> edges, faces;
  const auto add = [](std::set<std::vector<int>>& to, std::vector<int> list) {
    std::sort(list.begin(), list.end());
    to.insert(list);
  };
  for (const auto& w : body.wedges) {
    nodes.insert(w.begin(), w.end());
    add(faces, {w[0], w[1], w[2]}), add(faces, {w[3], w[4], w[5]});
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      add(edges, {w[i], w[j]}), add(edges, {w[3 + i], w[3 + j]}), add(edges, {w[i], w[3 + i]});
      add(faces, {w[i], w[j], w[3 + j], w[3 + i]});
    }
  }
  return static_cast<int>(nodes.size()) - static_cast<int>(edges.size()) + static_cast<int>(faces.size()) -
         static_cast<int>(body.wedges.size());
}

/// Of a wedge, by two points along its axis at each of three corners' middles: exact for these elements.
double volume_of(const Body& body, const std::array<int, 6>& w) {
  double volume = 0;
  for (const auto& [a, b] : {std::pair{1 / 6., 1 / 6.}, {2 / 3., 1 / 6.}, {1 / 6., 2 / 3.}})
    for (const double c : {-1 / std::sqrt(3.), 1 / std::sqrt(3.)}) {
      const double corner[] = {1 - a - b, a, b};
      const auto at = [&](int i) { return body.points[w[i]]; };
      const auto level = [&](int i) { return (1 - c) / 2 * at(i) + (1 + c) / 2 * at(3 + i); };
      Vec3 up;
      for (int i = 0; i < 3; ++i) up += corner[i] / 2 * (at(3 + i) - at(i));
      volume += dot(cross(level(1) - level(0), level(2) - level(0)), up) / 6;
    }
  return volume;
}

}  // namespace

/// A notch in a ball is still a ball, whatever its shape.
TEST(MakeBody, AnOpenedBodyIsStillOnePiece) {
  for (const Made& m : all_made()) {
    SCOPED_TRACE(m.name);
    EXPECT_EQ(euler_number(m.body), 1);
    EXPECT_GT(m.report.least_determinant, 0.2);
    EXPECT_GT(m.report.least_angle, 15);
    EXPECT_EQ(m.report.left_out, 0);
  }
}

/// Each wedge at a pair is on the side of its node, near the cut.
TEST(MakeBody, LeftNodesBelongToTheLeft) {
  for (const Made& m : all_made()) {
    SCOPED_TRACE(m.name);
    std::vector<std::vector<int>> around(m.body.points.size());
    for (int w = 0; w < static_cast<int>(m.body.wedges.size()); ++w)
      for (const int n : m.body.wedges[w]) around[n].push_back(w);
    for (const BodyPair& pair : m.body.pairs) {
      ASSERT_FALSE(around[pair.left].empty());
      ASSERT_FALSE(around[pair.right].empty());
      const auto side = [&](int node) {
        Vec3 sum;
        for (const int w : around[node])
          for (const int n : m.body.wedges[w]) sum += m.body.points[n] - m.body.points[node];
        return dot(sum, pair.normal);
      };
      EXPECT_LT(side(pair.left), 0);
      EXPECT_GT(side(pair.right), 0);
      EXPECT_EQ(m.body.points[pair.left], m.body.points[pair.right]);
    }
  }
}

/// Four copies where two cuts cross, three where one begins at the other.
TEST(MakeBody, CopiesAtCrossings) {
  for (const Made& m : all_made()) {
    std::map<std::array<double, 3>, int> copies;
    for (std::size_t n = 0; n < m.body.points.size(); ++n)
      if (m.body.skin_above[n] == static_cast<int>(n)) {
        const Vec3& p = m.body.points[n];
        ++copies[{p.x, p.y, p.z}];
      }
    int most = 0;
    for (const auto& [place, count] : copies) most = std::max(most, count);
    EXPECT_EQ(most, m.name.find('X') != std::string::npos ? 4 : m.name == "a T" ? 3 : 2) << m.name;
  }
}

/// Of a layer of thickness h below an area A: A (h - H h^2 + K h^3 / 3) with the mean curvature H and the
/// Gaussian one K. Near the cuts: toward the rim columns lean outward, as their neighbours do.
TEST(MakeBody, TheWedgesFillTheLayerBelowTheSkin) {
  for (const Made& m : all_made()) {
    const double h = m.request.parameters.patch.height;
    double part = h, tolerance = 1e-9, near = 1e9;
    if (m.name.find("sphere") != std::string::npos || m.name == "a circle")
      part = h - h * h / 60 + h * h * h / 3 / 3600, tolerance = 5e-3, near = 9;
    if (m.name.find("cylinder") != std::string::npos) part = h - h * h / 80, tolerance = 5e-3, near = 9;
    double volume = 0, area = 0;
    for (std::size_t w = 0; w < m.body.wedges.size(); ++w) {
      const auto& [a, b, c] = m.body.skin[w % m.body.skin.size()];
      const Vec3 &p = m.body.points[a], &q = m.body.points[b], &r = m.body.points[c];
      if (std::max({norm(p), norm(q), norm(r)}) > near) continue;
      volume += volume_of(m.body, m.body.wedges[w]);
      if (w < m.body.skin.size()) area += norm(cross(q - p, r - p)) / 2;
    }
    EXPECT_GT(area, 100);
    EXPECT_NEAR(volume / (part * area), 1, tolerance) << m.name;
  }
}

/// A frame for each column; the last one when all paths are cut. Pairs are released with their cut.
TEST(MakeBody, FramesFollowTheBlade) {
  for (const Made& m : all_made()) {
    SCOPED_TRACE(m.name);
    double total = 0;
    for (const ScalpelPath& path : m.request.paths) total += path.length();
    EXPECT_NEAR(m.body.times.back(), total, 1e-9 * total);
    EXPECT_EQ(m.body.times.front(), 0);
    EXPECT_NEAR(m.body.position.front(), -m.request.paths[0].length() / 2, 1e-9);
    EXPECT_NEAR(m.body.position.back(), m.request.paths.back().length() / 2, 1e-9);
    EXPECT_EQ(m.body.length, m.request.paths[0].length());
    for (std::size_t f = 0; f + 1 < m.body.times.size(); ++f) EXPECT_LT(m.body.times[f], m.body.times[f + 1]);
    for (std::size_t p = 0; p + 1 < m.body.pairs.size(); ++p)
      EXPECT_LE(m.body.pairs[p].cut, m.body.pairs[p + 1].cut);
    // No pair is open ahead of the blade by more than its element.
    for (std::size_t f = 0; f < m.body.times.size(); ++f)
      for (int p = 0; p < m.body.released[f]; ++p) {
        double before = 0;
        for (int c = 0; c < m.body.pairs[p].cut; ++c) before += m.request.paths[c].length();
        const double s = before + m.body.pairs[p].along + m.request.paths[m.body.pairs[p].cut].length() / 2;
        EXPECT_LE(s, m.body.times[f] + m.request.parameters.mesh.element_size);
      }
  }
}

/// Beyond the skin the blade opens nothing more; its time goes on.
/// Where it leans across the path, and not where along it: half as long at 45 degrees.
TEST(MakeBody, LipsOverATiltedBladeHaveSmallElements) {
  const auto longest = [](const Vec3& blade) {
    BodyRequest r = request(testing::flat, {along});
    std::vector<ScalpelPath::Point> points;
    points.reserve(along.size());
    for (const auto& [x, y] : along) points.push_back({{x, y, 0}, blade, 2});
    r.paths = {ScalpelPath(points)};
    const Body body = make_body(r);
    std::set<int> lips;
    for (const auto& pair : body.pairs)
      if (pair.depth == 0) lips.insert(pair.left);
    double most = 0;
    for (const auto& t : body.skin)
      for (int i = 0; i < 3; ++i)
        if (lips.contains(t[i]) && lips.contains(t[(i + 1) % 3]))
          most = std::max(most, norm(body.points[t[i]] - body.points[t[(i + 1) % 3]]));
    return most;
  };
  const double upright = longest({0, 0, 1});
  EXPECT_NEAR(longest({0, 1, 1}) / upright, 0.5, 0.1);
  EXPECT_NEAR(longest({0, -1, 1}) / upright, 0.5, 0.1);
  EXPECT_NEAR(longest({0, 0.1, 1}) / upright, 1, 1e-6);
  EXPECT_NEAR(longest({0.5, 0, 1}) / upright, 1, 0.1);
}

TEST(MakeBody, APathMayLeaveTheSkin) {
  BodyRequest r = request(testing::flat, {{{30, 0}, {50, 0}}});
  const Body body = make_body(r);
  EXPECT_NEAR(body.times.back(), 20, 1e-9);
  const std::size_t last = body.times.size() - 1;
  EXPECT_LT(body.times[last - 1], 11);  // the plate ends at 40 mm
  EXPECT_EQ(body.released[last], body.released[last - 1]);
}

/// Wherever it begins near the outline, frame 0 is closed and the last one has all pairs.
TEST(MakeBody, APathMayBeginAtTheOutline) {
  for (const double begin : {39.9, 39.99, 40., 40.01, 40.05, 40.15})
    for (const double end : {20., 60.}) {
      if (begin >= 40 && end > 40) continue;  // not on the skin
      const Body body = make_body(request(testing::flat, {{{begin, 0}, {end, 0}}}));
      EXPECT_EQ(body.released.front(), 0);
      EXPECT_EQ(body.released.back(), static_cast<int>(body.pairs.size()));
      EXPECT_TRUE(std::ranges::is_sorted(body.times));
      EXPECT_GT(body.times[1], 0);
      EXPECT_NEAR(body.times.back(), std::abs(end - begin), 1e-9);
    }
}

/// The other face of a thin organ is reached around the ends of a cut, too, and is at least as far from it in
/// its coordinates as it is in space.
TEST(MakeBody, CoordinatesBehindAnEdgeAreFar) {
  const testing::Bend edge = testing::lamella(10, 4);
  for (const auto& places : {std::vector<std::pair<double, double>>{{-4, -6}, {3, 10}},
                             {{-9, 4}, {-3, 7}, {3, 7}, {9, 4}},
                             {{-8, 8}, {8, 8.5}}}) {
    BodyRequest r = request(edge, {});
    r.skin = sheet(edge, 30, 26, 1, 0.25);
    r.paths = {path_on(edge, places, 0.5)}, r.reach = 25;
    r.parameters.patch.height = 2;
    const Body body = make_body(r);
    const ScalpelPath& path = r.paths.front();
    double behind = 0;
    for (const auto& triangle : body.skin)
      for (const int n : triangle) {
        double straight = std::numeric_limits<double>::infinity();
        for (int i = 0; i <= 200; ++i)
          straight = std::min(straight, norm(body.points[n] - path.at(path.length() * i / 200).position));
        const Vec3& at = body.canonical[n];
        const double told = std::hypot(at.y, std::max(0., std::abs(at.x) - path.length() / 2));
        EXPECT_GE(told, 0.8 * straight - 0.3) << at.x << ' ' << at.y << ' ' << body.points[n].z;
        behind = std::min(behind, body.points[n].z);
      }
    EXPECT_LT(behind, -3.9);
  }
}

/// The tension lies in the triangles, along the given direction as it is seen there.
TEST(MakeBody, TheTensionLiesInTheSkin) {
  BodyRequest r = request(testing::cylinder_along(40), {along});
  const Vec3 direction{1, 1, 0.2};
  r.tension = {{{}, direction}};
  const Body body = make_body(r);
  for (std::size_t t = 0; t < body.skin.size(); ++t) {
    const auto& [a, b, c] = body.skin[t];
    const Vec3 normal = normalized(cross(body.points[b] - body.points[a], body.points[c] - body.points[a]));
    EXPECT_NEAR(dot(body.tension[t], normal), 0, 1e-12);
    EXPECT_NEAR(norm(body.tension[t]), 1, 1e-12);
    EXPECT_NEAR(dot(cross(body.tension[t], direction), normal), 0, 1e-12);
    EXPECT_GT(dot(body.tension[t], direction), 0);
  }
}

/// Lines around the z axis, whose tangents are known at each place; a line has no head.
TEST(MakeBody, TheTensionFollowsLines) {
  BodyRequest r = request(testing::flat, {along});
  for (int i = 0; i < 12; ++i)
    for (const double radius : {6, 12, 18, 24, 30, 40, 50}) {
      const double angle = std::numbers::pi * i / 6;
      const Vec3 out{std::cos(angle), std::sin(angle), 0};
      r.tension.push_back({radius * out, (i % 2 == 0 ? 3. : -1.) * cross({0, 0, 1}, out)});
    }
  const Body body = make_body(r);
  for (std::size_t t = 0; t < body.skin.size(); ++t) {
    const auto& [a, b, c] = body.skin[t];
    const Vec3 middle = (1. / 3) * (body.points[a] + body.points[b] + body.points[c]);
    if (norm(middle) < 10 || norm(middle) > 30) continue;
    const double off = std::abs(dot(body.tension[t], normalized(middle)));
    EXPECT_LT(std::asin(std::min(off, 1.)), 0.1) << middle.x << ' ' << middle.y;
    EXPECT_NEAR(norm(body.tension[t]), 1, 1e-12);
  }
}

TEST(MakeBody, LinesThatCancelOnACutAreRefused) {
  BodyRequest r = request(testing::flat, {along});
  r.tension = {{{0, 0, 0}, {1, 0, 0}}, {{0, 0, 0}, {0, 1, 0}}};
  try {
    make_body(r);
    FAIL() << "not refused";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("cancel each other there"), std::string::npos) << e.what();
  }
}

TEST(MakeBody, PathsOffTheSkinAreRefused) {
  BodyRequest r = request(testing::flat, {along});
  r.paths[0] = r.paths[0].moved({0, 0, 30});
  EXPECT_THROW(make_body(r), InputError);
}

TEST(MakeBody, MoreNodesThanFitAreRefusedBeforeTheWork) {
  BodyRequest r = request(testing::flat, {along});
  r.parameters.mesh.element_size = 0.01, r.reach = 40;
  try {
    make_body(r);
    FAIL() << "not refused";
  } catch (const InputError& e) {
    for (const char* part : {"mesh.element_size = 0.01", "million nodes", "at least 0.0"})
      EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
  }
}

TEST(ThinFrames, KeepsTheFirstOneAndThoseInWhichCutsEnd) {
  BodyRequest r = request(testing::flat, {{{-15, 0}, {15, 0}}, {{0, 3}, {0, 15}}});
  r.parameters.mesh.element_size = 0.5;
  const Body whole = make_body(r);
  ASSERT_GT(whole.times.size(), 60u);
  Body thin = whole;
  thin_frames(thin, 200);
  EXPECT_EQ(thin.times, whole.times);
  thin_frames(thin, 20);
  EXPECT_LE(thin.times.size(), 22u);
  EXPECT_GE(thin.times.size(), 15u);
  EXPECT_EQ(thin.times.front(), 0);
  EXPECT_EQ(thin.times.back(), whole.times.back());
  EXPECT_EQ(thin.released.back(), whole.released.back());
  EXPECT_NE(std::find(thin.times.begin(), thin.times.end(), r.paths[0].length()), thin.times.end());
  for (std::size_t f = 0; f < thin.times.size(); ++f) {
    const auto at = std::find(whole.times.begin(), whole.times.end(), thin.times[f]);
    ASSERT_NE(at, whole.times.end());
    const auto i = static_cast<std::size_t>(at - whole.times.begin());
    EXPECT_EQ(thin.released[f], whole.released[i]);
    EXPECT_EQ(thin.position[f], whole.position[i]);
  }
  EXPECT_NE(thin.hash, whole.hash);
  check_body(thin, "thin");
}

/// Whatever the triangles are that the cuts found. Of seeds 99 and 156 two short pieces of lines meet.
TEST(MakeBody, GoodTrianglesAtATJunction) {
  for (const unsigned seed : {0, 1, 2, 3, 4, 5, 99, 156}) {
    BodyRequest r = request(testing::flat, {{{-15, 0}, {15, 0}}, {{0, 0}, {0, 15}}});
    r.skin = sheet(testing::flat, 30, 30, 1.3 + 0.7 * (seed % 3), 0.28, seed);
    r.parameters = {}, r.reach = 5;
    BodyReport report;
    make_body(r, &report);
    EXPECT_GT(report.least_angle, 15) << seed;
  }
}

/// Tissue changes exactly where a layer ends: below the cut, within it, and where nodes were already.
TEST(BodyMaker, LayersEndWhereTheyAreSaidTo) {
  BodyRequest r = request(testing::flat, {along});
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const Body plain = make_body(r);
  r.layers = {{{"dermis", 0.08}, 0.9}, {{"fat"}, 3.7}, {{"muscle"}, infinite}};
  const Body body = make_body(r);
  ASSERT_EQ(body.materials.size(), 3U);
  EXPECT_EQ(body.pairs.size() > plain.pairs.size(), true);  // the dermis has nodes of its own below it
  std::array<double, 3> volume{};
  for (std::size_t w = 0; w < body.wedges.size(); ++w) {
    const auto p = [&](int i) { return body.points[body.wedges[w][i]]; };
    double low = p(0).z, high = p(3).z;
    EXPECT_LE(-low, (std::array{0.9, 3.7, 6.}[body.region[w]] + 1e-9));
    EXPECT_GE(-high, (std::array{0., 0.9, 3.7}[body.region[w]] - 1e-9));
    volume[body.region[w]] += (high - low) * norm(cross(p(1) - p(0), p(2) - p(0))) / 2;
  }
  EXPECT_NEAR(volume[0] / volume[1], 0.9 / 2.8, 1e-9);
  EXPECT_NEAR(volume[2] / volume[1], 2.3 / 2.8, 1e-9);
  r.layers = {{{"fat"}, 7}, {{"muscle"}, infinite}};
  EXPECT_THROW(make_body(r), InputError);
}

/// Paths that only partly lie on the skin are cut as far as it goes, and told of.
TEST(MakeBody, TellsOfPathsOffTheSkin) {
  const auto off_paths = [](const std::vector<std::pair<double, double>>& places, double above,
                            double rises = 0) {
    BodyRequest r = request(testing::flat, {});
    const auto path = [&](double x, double y) { return Vec3{x, y, above + rises * x}; };
    r.paths.push_back(path_on(path, places, 2.5));
    BodyReport report;
    make_body(r, &report);
    return report.off_paths;
  };
  EXPECT_TRUE(off_paths(along, 0).empty());
  EXPECT_TRUE(off_paths(along, 2).empty());                     // less than the cut is deep
  const std::vector<OffPath> far = off_paths(along, 3, 0.125);  // from 2 to 4 mm
  ASSERT_EQ(far.size(), 1U);
  EXPECT_TRUE(far[0].far && !far[0].leaves);
  EXPECT_GT(far[0].off, 4);
  EXPECT_LT(far[0].off, 4.5) << "a body is cut a little farther than its path";
  EXPECT_NEAR(far[0].at.z, 0, 1e-9);
  try {
    off_paths(along, 4);
    FAIL() << "not refused";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("4 mm off the skin"), std::string::npos) << e.what();
  }
  const std::vector<OffPath> out = off_paths({{30, 0}, {40, 0}, {55, 0}}, 0);  // the sheet ends at 40
  ASSERT_EQ(out.size(), 1U);
  EXPECT_TRUE(out[0].leaves && !out[0].far);
  EXPECT_NEAR(out[0].made, 10, 1e-6);
  EXPECT_NEAR(out[0].length, 25, 1e-6);
}

}  // namespace cleft
