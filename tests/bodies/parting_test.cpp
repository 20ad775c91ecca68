#include "explorer/body/parting.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <set>

namespace cleft {

namespace {

constexpr int layers = 3;

/// Triangles about point 0 at the origin, seen from z; the others are 1, 2, ... counter-clockwise from the
/// x axis. An open fan goes from -x over y to x... its first neighbour is 1 and its last one count + 1.
struct Fan {
  explicit Fan(int triangles, bool is_closed = true) : count(triangles), closed(is_closed) {
    mesh.points.push_back({});
    const int around = closed ? count : count + 1;
    for (int i = 0; i < around; ++i) {
      const double angle = (closed ? 2 : 1) * std::numbers::pi * i / count;
      mesh.points.push_back({std::cos(angle), std::sin(angle), 0});
    }
    for (int i = 0; i < count; ++i) mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % around});
    // Neither the order of triangles nor their first corners matter.
    std::shuffle(mesh.triangles.begin(), mesh.triangles.end(), std::mt19937_64(3));
    for (std::size_t t = 0; t < mesh.triangles.size(); t += 2)
      std::rotate(mesh.triangles[t].begin(), mesh.triangles[t].begin() + 1, mesh.triangles[t].end());
    nodes = layers * static_cast<int>(mesh.points.size());
    above.assign(nodes, -1);
    original = nodes;
  }

  Parting parting() {
    const int points = static_cast<int>(mesh.points.size());
    return Parting(
        mesh, layers, [points](int point, int layer) { return layer * points + point; },
        [this](int node, int skin) {
          EXPECT_LT(node, nodes);
          above.push_back(skin);
          return nodes++;
        });
  }
  int corner(int t) const {
    const auto& c = mesh.triangles[t];
    return static_cast<int>(std::find(c.begin(), c.end(), 0) - c.begin());
  }
  int node(const Parting& parting, int t, int layer) const { return parting.node(t, corner(t), layer); }
  Vec3 middle(int t) const {
    Vec3 sum;
    for (const int p : mesh.triangles[t]) sum += 1. / 3 * mesh.points[p];
    return sum;
  }
  std::set<int> nodes_at(const Parting& parting, int layer) const {
    std::set<int> all;
    for (int t = 0; t < count; ++t) all.insert(node(parting, t, layer));
    return all;
  }
  /// Triangles that can be reached from each other without crossing the edges to these neighbours.
  std::vector<int> connected(const std::set<int>& opened) const {
    std::vector<int> part(count);
    std::iota(part.begin(), part.end(), 0);
    const auto joined = [&](int s, int t) {
      for (const int p : mesh.triangles[s])
        for (const int q : mesh.triangles[t])
          if (p == q && p != 0 && !opened.contains(p)) return true;
      return false;
    };
    for (int round = 0; round < count; ++round)
      for (int s = 0; s < count; ++s)
        for (int t = 0; t < count; ++t)
          if (joined(s, t)) part[s] = part[t] = std::min(part[s], part[t]);
    return part;
  }

  SurfaceMesh mesh;
  int count;
  bool closed;
  int nodes = 0, original = 0;
  std::vector<int> above;
};

}  // namespace

/// Left is v < 0, with across = N x T: for a cut along x, y < 0. It keeps its node.
TEST(Parting, ALinePartsItsSidesAsFarAsItIsDeep) {
  Fan fan(8);
  Parting parting = fan.parting();
  const auto pairs = parting.open({.point = 0, .from = 5, .to = 1, .layers = 2});
  ASSERT_EQ(pairs.size(), 2u);
  for (int k = 0; k < 2; ++k) {
    EXPECT_EQ(pairs[k].layer, k);
    EXPECT_FALSE(pairs[k].reversed);
    EXPECT_EQ(pairs[k].left, k * 9);
    EXPECT_GE(pairs[k].right, fan.original);
    for (int t = 0; t < fan.count; ++t)
      EXPECT_EQ(fan.node(parting, t, k), fan.middle(t).y < 0 ? pairs[k].left : pairs[k].right);
  }
  EXPECT_EQ(fan.nodes_at(parting, 2).size(), 1u);
  EXPECT_EQ(fan.above[pairs[0].right], -1);
  EXPECT_EQ(fan.above[pairs[1].right], pairs[0].right);
}

TEST(Parting, AnEndPartsNothingUntilAnotherCutArrives) {
  Fan fan(8);
  Parting parting = fan.parting();
  EXPECT_TRUE(parting.open({.point = 0, .from = -1, .to = 1, .layers = 3}).empty());
  EXPECT_EQ(fan.nodes_at(parting, 0).size(), 1u);
  EXPECT_EQ(parting.open({.point = 0, .from = 4, .to = -1, .layers = 3}).size(), 3u);
}

/// The second cut begins on the line of the first, at its right.
TEST(Parting, ATPartsOneSideAgain) {
  Fan fan(8);
  Parting parting = fan.parting();
  const auto first = parting.open({.point = 0, .from = 5, .to = 1, .layers = 1});
  const auto second = parting.open({.point = 0, .from = -1, .to = 3, .layers = 1});  // along y
  ASSERT_EQ(second.size(), 1u);
  EXPECT_EQ(second[0].left, first[0].right);
  EXPECT_FALSE(second[0].reversed);
  for (int t = 0; t < fan.count; ++t) {
    const Vec3 at = fan.middle(t);  // across is -x: left is x > 0
    const int expected = at.y < 0 ? first[0].left : at.x > 0 ? second[0].left : second[0].right;
    EXPECT_EQ(fan.node(parting, t, 0), expected);
  }
}

TEST(Parting, AnXHasFourNodes) {
  Fan fan(8);
  Parting parting = fan.parting();
  parting.open({.point = 0, .from = 5, .to = 1, .layers = 3});
  const auto second = parting.open({.point = 0, .from = 7, .to = 3, .layers = 2});  // along y
  ASSERT_EQ(second.size(), 4u);
  for (const auto& pair : second) {
    EXPECT_FALSE(pair.reversed);
    for (int t = 0; t < fan.count; ++t) {
      if (fan.node(parting, t, pair.layer) == pair.left) EXPECT_GT(fan.middle(t).x, 0);
      if (fan.node(parting, t, pair.layer) == pair.right) EXPECT_LT(fan.middle(t).x, 0);
    }
  }
  for (int k = 0; k < layers; ++k) EXPECT_EQ(fan.nodes_at(parting, k).size(), k < 2 ? 4u : 2u);
  for (const auto& pair : second)  // each hangs from the node of its own quarter
    if (pair.layer == 1) {
      int skin = -1;
      for (int t = 0; t < fan.count; ++t)
        if (fan.node(parting, t, 1) == pair.right) skin = fan.node(parting, t, 0);
      EXPECT_EQ(fan.above[pair.right], skin);
    }
}

TEST(Parting, ThreeCutsThroughAPointHaveSixNodes) {
  Fan fan(12);
  Parting parting = fan.parting();
  for (const int to : {1, 3, 5}) parting.open({.point = 0, .from = to + 6, .to = to, .layers = 1});
  EXPECT_EQ(fan.nodes_at(parting, 0).size(), 6u);
}

/// A cut that begins at the outline of the skin parts at once.
TEST(Parting, AtAnOutlineAnEndParts) {
  Fan fan(6, false);
  Parting parting = fan.parting();
  const auto pairs = parting.open({.point = 0, .from = -1, .to = 4, .layers = 1});  // along y
  ASSERT_EQ(pairs.size(), 1u);
  for (int t = 0; t < fan.count; ++t)
    EXPECT_EQ(fan.node(parting, t, 0), fan.middle(t).x > 0 ? pairs[0].left : pairs[0].right);
}

/// Any cuts, in any order: triangles have one node where they are still connected. A right node is new, and
/// the left one of later pairs only.
TEST(Parting, NodesAreThoseOfConnectedParts) {
  std::mt19937_64 random(11);
  const auto below = [&](int n) { return static_cast<int>(random() % n); };
  for (int trial = 0; trial < 400; ++trial) {
    Fan fan(3 + below(8), below(3) > 0);
    const int around = static_cast<int>(fan.mesh.points.size()) - 1;
    Parting parting = fan.parting();
    std::vector<std::set<int>> opened(layers);
    std::set<int> known, was_left;
    for (int k = 0; k < layers; ++k) known.insert(k * (around + 1));
    for (int cut = 0; cut < 4; ++cut) {
      Parting::Visit visit{
          .point = 0, .from = 1 + below(around), .to = 1 + below(around), .layers = 1 + below(3)};
      if (visit.from == visit.to || below(4) == 0) (below(2) ? visit.from : visit.to) = -1;
      for (int k = 0; k < visit.layers; ++k)
        for (const int end : {visit.from, visit.to})
          if (end >= 0) opened[k].insert(end);
      for (const auto& pair : parting.open(visit)) {
        ASSERT_TRUE(known.contains(pair.left));
        ASSERT_TRUE(known.insert(pair.right).second);
        ASSERT_LT(pair.layer, visit.layers);
      }
      for (int k = 0; k < layers; ++k) {
        const std::vector<int> part = fan.connected(opened[k]);
        for (int s = 0; s < fan.count; ++s)
          for (int t = 0; t < fan.count; ++t)
            ASSERT_EQ(part[s] == part[t], fan.node(parting, s, k) == fan.node(parting, t, k))
                << trial << " " << cut << " " << k;
      }
    }
    ASSERT_EQ(known.size(), static_cast<std::size_t>(layers + fan.nodes - fan.original));
  }
}

}  // namespace cleft
