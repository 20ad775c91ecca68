#include "tradeoff/replays/replay_error.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "base/error.h"
#include "base/quantiles.h"
#include "base/stopwatch.h"
#include "explorer/wound/cut_fields.h"
#include "explorer/wound/replayed_wounds.h"
#include "tradeoff/replays/uncut_skin.h"

namespace cleft {

ScalpelPath path_of(const Snapshot& s, int cut) {
  std::vector<ScalpelPath::Point> points;
  const Parameters::Cut& p = s.parameters->cut;
  const double radius = p.radius, length = s.cut_length, tilt = p.tilt * std::numbers::pi / 180;
  const double aside = (cut - (p.count - 1) / 2) * p.spacing;
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

/// From the lip of the first cut toward +v; it begins so little beyond it that it begins on it.
ScalpelPath branch_of(const Snapshot& s) {
  std::vector<ScalpelPath::Point> points;
  constexpr int pieces = 60;
  const double length = s.parameters->cut.branch;
  for (int i = 0; i <= pieces; ++i)
    points.push_back({{0, i == 0 ? 1e-6 : length * i / pieces, 0}, {0, 0, 1}, s.cut_depth});
  return ScalpelPath(points);
}

SkinTension tension_of(const Snapshot& s) {
  const auto [uu, vv, uv] = s.parameters->skin.prestress;
  CLEFT_CHECK(uv, ==, 0);
  return {uu > vv ? Vec3{1, 0, 0} : Vec3{0, 1, 0}, std::max(uu, vv), std::min(uu, vv)};
}

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

  /// Along a path toward +v the left lip is the one with u > 0, which is the right one of the snapshot's
  /// pairs.
  struct Cut {
    const Incision* incision;
    bool turned = false;
  };

  void add(std::size_t frame, const CutMesh& mesh, const std::vector<Cut>& cuts,
           const std::vector<Vec3>& moved) {
    const std::vector<Vec3> open = truth_.displacement(frame);
    const auto of_node = [&](int node) { return open[node] - closed_[node]; };
    const auto of_vertex = [&](int v) { return moved[v] - mesh.position(v); };
    const auto vertices = static_cast<int>(skin_.node_of.size());
    for (int v = 0; v < vertices; ++v)
      if (mesh.vertex(v).kind == VertexKind::skin)
        result.skin_error = std::max(result.skin_error, norm(of_vertex(v) - of_node(skin_.node_of[v])));
    for (const auto& [incision, turned] : cuts)
      for (const Incision::ChainVertex& c : incision->chain()) {
        const int at = std::min(c.left, c.right);
        if (c.left == c.right || at >= vertices) continue;
        const int left = skin_.node_of[at];
        if (!right_of_.contains(left)) continue;
        const Vec3 parted = of_vertex(c.right) - of_vertex(c.left), found = turned ? -1. * parted : parted;
        Vec3 expected = of_node(right_of_[left]) - of_node(left);
        if (const auto third = right_of_.find(right_of_[left]); third != right_of_.end()) {
          // Where a branch leaves there are two right lips: whichever of them c.right is.
          const Vec3 other = of_node(third->second) - of_node(left);
          if (norm(found - other) < norm(found - expected)) expected = other;
        }
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

ReplayError compare(const SnapshotReader& truth, const UncutSkin& skin, const Wound& wound,
                    double detail = 0) {
  const Replay replay(wound, detail);
  Comparison comparison(truth, skin);
  std::vector<Vec3> moved(replay.vertex_count());
  std::vector<double> seconds;
  constexpr int repeats = 50;
  for (std::size_t j = 1; j < truth.snapshot().frames(); ++j) {
    seconds.push_back(least_seconds(repeats, [&] { replay.positions(truth.snapshot().times[j], moved); }));
    comparison.add(j, wound.incision->mesh(), {{wound.incision}}, moved);
  }
  comparison.result.frame_seconds = median(seconds), comparison.result.vertices = moved.size();
  return comparison.result;
}

}  // namespace

ReplayError replay_error(const SnapshotReader& truth, const Field& field, double detail) {
  const UncutSkin skin = uncut_skin(truth.snapshot());
  const Incision incision = cut_as(truth.snapshot(), skin);
  return compare(truth, skin, Wound(incision, field, 1), detail);
}

ReplayError replay_error(const SnapshotReader& truth, const PrestressFields& fields) {
  const UncutSkin skin = uncut_skin(truth.snapshot());
  const Incision incision = cut_as(truth.snapshot(), skin);
  return compare(truth, skin, wound_in_tension(incision, fields, tension_of(truth.snapshot()), 1));
}

namespace {

/// Two cuts of one mesh, while the second is made.
template <class WoundOf>
ReplayError second_cut_error(const SnapshotReader& truth, const ScalpelPath& one, const ScalpelPath& other,
                             bool turned, const WoundOf& wound_of) {
  const Snapshot& s = truth.snapshot();
  const UncutSkin skin = uncut_skin(s);
  CutMesh mesh(skin.mesh);
  IncisionOptions options;
  options.max_edge = 0;
  Incision first(mesh, one, options);
  first.advance_to(one.length());
  Incision second(mesh, other, options);
  second.advance_to(other.length());
  const ReplayedWounds wounds({wound_of(first), wound_of(second)});
  Comparison comparison(truth, skin);
  std::vector<Vec3> moved(wounds.vertex_count());
  for (std::size_t j = 1; j < s.frames(); ++j) {
    if (s.times[j] <= s.cut_length) continue;
    wounds.positions(s.times[j], moved);
    comparison.add(j, mesh, {{&first}, {&second, turned}}, moved);
  }
  return comparison.result;
}

}  // namespace

ReplayError parallel_error(const SnapshotReader& truth, const Field& field) {
  return second_cut_error(truth, path_of(truth.snapshot(), 0), path_of(truth.snapshot(), 1), false,
                          [&](const Incision& cut) { return Wound(cut, field, 1); });
}

ReplayError branch_error(const SnapshotReader& truth, const PrestressFields& fields) {
  const Snapshot& s = truth.snapshot();
  return second_cut_error(truth, path_of(s), branch_of(s), true, [&](const Incision& cut) {
    return wound_in_tension(cut, fields, tension_of(s), 1);
  });
}

}  // namespace cleft
