#include "tests/truth/replay_error.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "base/error.h"
#include "explorer/scene/replay.h"
#include "tests/truth/uncut_skin.h"

namespace cleft {

ScalpelPath path_of(const Snapshot& s) {
  std::vector<ScalpelPath::Point> points;
  const auto number = [&](const char* name) { return std::get<double>(s.parameters.at(name)); };
  const double radius = number("cut.radius"), length = s.cut_length,
               tilt = number("cut.tilt") * std::numbers::pi / 180;
  // An arc has its middle at the origin, along u there, and bends toward +v.
  for (int i = 0; i <= 60; ++i) {
    const double along = -length / 2 + length * i / 60, angle = radius > 0 ? along / radius : 0;
    const Vec3 at =
        radius > 0 ? Vec3{radius * std::sin(angle), radius * (1 - std::cos(angle)), 0} : Vec3{along, 0, 0};
    const Vec3 across{-std::sin(angle), std::cos(angle), 0};
    points.push_back(
        {at, std::cos(tilt) * Vec3{0, 0, 1} - std::sin(tilt) * across, s.cut_depth / std::cos(tilt)});
  }
  return ScalpelPath(points);
}

ReplayError replay_error(const SnapshotReader& truth, const Field& field) {
  const Snapshot& s = truth.snapshot();
  const UncutSkin skin = uncut_skin(s);
  IncisionOptions options;
  options.max_edge = 0;
  Incision incision(skin.mesh, path_of(s), options);
  incision.advance_to(incision.path().length());
  const Replay replay(field, incision, 1);
  std::map<int, int> right_of;
  for (const auto& [left, right] : s.pairs) right_of[left] = right;

  ReplayError result;
  const std::vector<Vec3> closed = truth.displacement(0);
  std::vector<Vec3> moved(replay.vertex_count());
  const auto vertices = static_cast<int>(skin.node_of.size());
  for (std::size_t j = 1; j < s.frames(); ++j) {
    const std::vector<Vec3> open = truth.displacement(j);
    const auto of_node = [&](int node) {
      return open[static_cast<std::size_t>(node)] - closed[static_cast<std::size_t>(node)];
    };
    replay.positions(s.times[j], moved);
    const auto of_vertex = [&](int v) {
      return moved[static_cast<std::size_t>(v)] - replay.rest()[static_cast<std::size_t>(v)];
    };
    for (int v = 0; v < vertices; ++v) {
      const CutMesh::Vertex& vertex = incision.mesh().vertex(v);
      if (vertex.kind == VertexKind::skin)
        result.skin_error = std::max(result.skin_error,
                                     norm(of_vertex(v) - of_node(skin.node_of[static_cast<std::size_t>(v)])));
    }
    for (const Incision::ChainVertex& c : incision.chain()) {
      const int at = std::min(c.left, c.right);
      if (c.left == c.right || at >= vertices) continue;
      const int left = skin.node_of[static_cast<std::size_t>(at)];
      if (!right_of.contains(left)) continue;
      const Vec3 expected = of_node(right_of[left]) - of_node(left),
                 found = of_vertex(c.right) - of_vertex(c.left);
      result.gape = std::max(result.gape, norm(expected));
      result.gape_error = std::max(result.gape_error, norm(found - expected));
    }
  }
  return result;
}

}  // namespace cleft
