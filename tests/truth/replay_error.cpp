#include "tests/truth/replay_error.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "base/error.h"
#include "explorer/scene/replay.h"
#include "explorer/scene/wounds.h"
#include "tests/truth/uncut_skin.h"

namespace cleft {

ScalpelPath path_of(const Snapshot& s, int cut) {
  std::vector<ScalpelPath::Point> points;
  const auto number = [&](const char* name) { return std::get<double>(s.parameters.at(name)); };
  const double radius = number("cut.radius"), length = s.cut_length,
               tilt = number("cut.tilt") * std::numbers::pi / 180;
  const double aside = (cut - (number("cut.count") - 1) / 2) * number("cut.spacing");
  // An arc has its middle at the origin, along u there, and bends toward +v.
  for (int i = 0; i <= 60; ++i) {
    const double along = -length / 2 + length * i / 60, angle = radius > 0 ? along / radius : 0;
    const Vec3 at = radius > 0 ? Vec3{radius * std::sin(angle), radius * (1 - std::cos(angle)), 0}
                               : Vec3{along, aside, 0};
    const Vec3 across{-std::sin(angle), std::cos(angle), 0};
    points.push_back(
        {at, std::cos(tilt) * Vec3{0, 0, 1} - std::sin(tilt) * across, s.cut_depth / std::cos(tilt)});
  }
  return ScalpelPath(points);
}

namespace {

Incision cut_as(const Snapshot& s, const UncutSkin& skin) {
  IncisionOptions options;
  options.max_edge = 0;
  Incision incision(skin.mesh, path_of(s), options);
  incision.advance_to(incision.path().length());
  return incision;
}

/// What a frame of the truth and the replay of it make of the same mesh.
class Comparison {
 public:
  Comparison(const SnapshotReader& truth, const UncutSkin& skin)
      : truth_(truth), skin_(skin), closed_(truth.displacement(0)) {
    for (const auto& [left, right] : truth.snapshot().pairs) right_of_[left] = right;
  }

  void add(std::size_t frame, const CutMesh& mesh, const std::vector<const Incision*>& cuts,
           const std::vector<Vec3>& moved) {
    const std::vector<Vec3> open = truth_.displacement(frame);
    const auto of_node = [&](int node) {
      return open[static_cast<std::size_t>(node)] - closed_[static_cast<std::size_t>(node)];
    };
    const auto of_vertex = [&](int v) { return moved[static_cast<std::size_t>(v)] - mesh.position(v); };
    const auto vertices = static_cast<int>(skin_.node_of.size());
    for (int v = 0; v < vertices; ++v)
      if (mesh.vertex(v).kind == VertexKind::skin)
        result.skin_error = std::max(
            result.skin_error, norm(of_vertex(v) - of_node(skin_.node_of[static_cast<std::size_t>(v)])));
    for (const Incision* cut : cuts)
      for (const Incision::ChainVertex& c : cut->chain()) {
        const int at = std::min(c.left, c.right);
        if (c.left == c.right || at >= vertices) continue;
        const int left = skin_.node_of[static_cast<std::size_t>(at)];
        if (!right_of_.contains(left)) continue;
        const Vec3 expected = of_node(right_of_[left]) - of_node(left),
                   found = of_vertex(c.right) - of_vertex(c.left);
        result.gape = std::max(result.gape, norm(expected));
        result.gape_error = std::max(result.gape_error, norm(found - expected));
      }
  }

  ReplayError result;

 private:
  const SnapshotReader& truth_;
  const UncutSkin& skin_;
  std::vector<Vec3> closed_;
  std::map<int, int> right_of_;
};

ReplayError compare(const SnapshotReader& truth, const UncutSkin& skin, const Incision& incision,
                    const VaryingField& field) {
  const Replay replay(field, incision, 1);
  Comparison comparison(truth, skin);
  std::vector<Vec3> moved(replay.vertex_count());
  for (std::size_t j = 1; j < truth.snapshot().frames(); ++j) {
    replay.positions(truth.snapshot().times[j], moved);
    comparison.add(j, incision.mesh(), {&incision}, moved);
  }
  return comparison.result;
}

}  // namespace

ReplayError replay_error(const SnapshotReader& truth, const Field& field) {
  const UncutSkin skin = uncut_skin(truth.snapshot());
  return compare(truth, skin, cut_as(truth.snapshot(), skin), field);
}

ReplayError replay_error(const SnapshotReader& truth, const PrestressFields& fields) {
  const Snapshot& s = truth.snapshot();
  const auto number = [&](const char* name) { return std::get<double>(s.parameters.at(name)); };
  const double u = number("skin.prestress_u"), v = number("skin.prestress_v");
  CLEFT_CHECK(number("skin.prestress_uv"), ==, 0);
  const UncutSkin skin = uncut_skin(s);
  const Incision incision = cut_as(s, skin);
  const SkinTension tension{u > v ? Vec3{1, 0, 0} : Vec3{0, 1, 0}, std::max(u, v), std::min(u, v)};
  const IncisionVolume volume(incision, fields.shape(), 1);
  return compare(truth, skin, incision,
                 fields.along(prestress_along(volume, incision.path().length(), tension)));
}

ReplayError parallel_error(const SnapshotReader& truth, const Field& field) {
  const Snapshot& s = truth.snapshot();
  const UncutSkin skin = uncut_skin(s);
  CutMesh mesh(skin.mesh);
  IncisionOptions options;
  options.max_edge = 0;
  Incision first(mesh, path_of(s, 0), options);
  first.advance_to(first.path().length());
  Incision second(mesh, path_of(s, 1), options);
  second.advance_to(second.path().length());
  const Wounds wounds({{&first, field}, {&second, field}}, 1);
  Comparison comparison(truth, skin);
  std::vector<Vec3> moved(wounds.vertex_count());
  for (std::size_t j = 1; j < s.frames(); ++j) {
    if (s.times[j] <= s.cut_length) continue;
    wounds.positions(s.times[j], moved);
    comparison.add(j, mesh, {&first, &second}, moved);
  }
  return comparison.result;
}

}  // namespace cleft
