#include "solver/bending.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <numeric>

#include "solver/skin_triangle.h"

namespace cleft {

namespace {

/// A triangle at an edge.
struct Side {
  int triangle, opposite;   // the corner that is not on the edge
  std::array<int, 2> edge;  // nodes of the edge; on both sides the same place first
};

/// The triangles of the skin at each edge, one or two: across a cut too.
std::vector<std::vector<Side>> sides_of_edges(const PatchMesh& mesh) {
  std::vector<int> place(mesh.points.size());  // by node: the first node there
  std::iota(place.begin(), place.end(), 0);
  for (const NodePair& pair : mesh.pairs) place[pair.right] = place[pair.left];
  std::map<std::pair<int, int>, std::vector<Side>> sides;
  for (std::size_t t = 0; t < mesh.skin.size(); ++t)
    for (int c = 0; c < 3; ++c) {
      int a = mesh.skin[t][(c + 1) % 3], b = mesh.skin[t][(c + 2) % 3];
      if (place[a] > place[b]) std::swap(a, b);
      sides[{place[a], place[b]}].push_back({static_cast<int>(t), c, {a, b}});
    }
  std::vector<std::vector<Side>> edges;
  edges.reserve(sides.size());
  for (auto& [edge, both] : sides) edges.push_back(std::move(both));
  return edges;
}

/// Of two sides; its edge has the first one's nodes.
Hinge hinge_of(const PatchMesh& mesh, const std::vector<Side>& both) {
  Hinge hinge{{both[0].edge[0], both[0].edge[1]}, {}, 0};
  const Vec3 &a = mesh.points[hinge.nodes[0]], &b = mesh.points[hinge.nodes[1]];
  double areas = 0;
  for (int s = 0; s < 2; ++s) {
    const Side& side = both[s];
    const auto& corners = mesh.skin[side.triangle];
    const SkinTriangle triangle(mesh.points[corners[0]], mesh.points[corners[1]], mesh.points[corners[2]]);
    areas += triangle.area();
    hinge.nodes[2 + s] = corners[side.opposite];
    // The edge turned by a right angle: the length times the unit normal.
    const Eigen::RowVector3d slope =
        Eigen::RowVector2d(b.y - a.y, a.x - b.x) * triangle.gradients() * (s == 0 ? 1 : -1);
    for (int c = 0; c < 3; ++c)
      hinge.bend[c == side.opposite ? 2 + s : corners[c] == side.edge[0] ? 0 : 1] += slope[c];
  }
  hinge.weight = 1 / areas;
  return hinge;
}

/// The pairs over which two nodes at one place are tied: each node leads over left nodes to the same one.
std::vector<int> pairs_between(const PatchMesh& mesh, const std::map<int, int>& pair_of_right, int one,
                               int other) {
  const auto chain = [&](int node) {
    std::vector<int> pairs;
    for (auto found = pair_of_right.find(node); found != pair_of_right.end();
         found = pair_of_right.find(mesh.pairs[found->second].left))
      pairs.push_back(found->second);
    std::sort(pairs.begin(), pairs.end());
    return pairs;
  };
  const std::vector<int> a = chain(one), b = chain(other);
  std::vector<int> between;
  std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(between));
  return between;
}

}  // namespace

std::vector<Hinge> skin_hinges(const PatchMesh& mesh) {
  std::vector<Hinge> hinges;
  for (const std::vector<Side>& both : sides_of_edges(mesh))
    if (both.size() == 2 && both[0].edge == both[1].edge) hinges.push_back(hinge_of(mesh, both));
  return hinges;
}

std::vector<Joint> skin_joints(const PatchMesh& mesh) {
  std::map<int, int> pair_of_right;
  for (std::size_t p = 0; p < mesh.pairs.size(); ++p)
    pair_of_right[mesh.pairs[p].right] = static_cast<int>(p);
  std::vector<Joint> joints;
  for (const std::vector<Side>& both : sides_of_edges(mesh)) {
    if (both.size() != 2 || both[0].edge == both[1].edge) continue;
    Joint& joint = joints.emplace_back(Joint{hinge_of(mesh, both), {}});
    for (int end = 0; end < 2; ++end) {
      const std::vector<int> pairs = pairs_between(mesh, pair_of_right, both[0].edge[end], both[1].edge[end]);
      joint.pairs.insert(joint.pairs.end(), pairs.begin(), pairs.end());
    }
    std::sort(joint.pairs.begin(), joint.pairs.end());
  }
  return joints;
}

void add_hinge(const Hinge& hinge, double factor, const std::vector<int>& first_unknown, int first, int end,
               dealii::TrilinosWrappers::SparseMatrix& matrix) {
  for (int a = 0; a < 4; ++a)
    for (int axis = 0; axis < 3; ++axis) {
      const int row = first_unknown[hinge.nodes[a]] + axis;
      for (int b = 0; b < 4 && first <= row && row < end; ++b)
        matrix.add(row, first_unknown[hinge.nodes[b]] + axis,
                   factor * hinge.weight * hinge.bend[a] * hinge.bend[b]);
    }
}

void add_bending(const PatchElements& elements, double stiffness,
                 dealii::TrilinosWrappers::SparseMatrix& matrix) {
  if (stiffness == 0) return;
  const int first = elements.offsets[elements.rank], end = elements.offsets[elements.rank + 1];
  for (const Hinge& hinge : skin_hinges(elements.mesh))
    add_hinge(hinge, stiffness, elements.first_unknown, first, end, matrix);
}

void add_bending_pattern(const PatchMesh& mesh, const std::vector<int>& first_unknown,
                         const dealii::IndexSet& owned, dealii::TrilinosWrappers::SparsityPattern& pattern) {
  std::vector<Hinge> hinges = skin_hinges(mesh);
  for (const Joint& joint : skin_joints(mesh)) hinges.push_back(joint.hinge);
  for (const Hinge& hinge : hinges)
    for (const int a : hinge.nodes)
      for (int axis = 0; axis < 3; ++axis)
        for (const int b : hinge.nodes)
          if (owned.is_element(first_unknown[a] + axis))
            pattern.add(first_unknown[a] + axis, first_unknown[b] + axis);
}

}  // namespace cleft
