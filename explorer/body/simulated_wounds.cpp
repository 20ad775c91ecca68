#include "explorer/body/simulated_wounds.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "explorer/body/body_lips.h"
#include "explorer/guard/guard_search.h"

namespace cleft {

namespace {
/// At how many frames of the series the guard looks at the skin.
constexpr std::size_t most_looks = 48;
/// Of the vertices that move: a guard that changes more of them is not taken.
constexpr double most_changed = 0.05;
}  // namespace

SimulatedWounds::SimulatedWounds(const std::vector<const Incision*>& cuts, double scale, const Body& body,
                                 const SnapshotReader& series)
    : scale_(scale),
      reach_of_ends_(EndShift(body, cuts, scale).reach() / scale),
      times_(series.snapshot().times),
      pairs_(body.pairs) {
  if (series.snapshot().body != body.hash || series.snapshot().points.size() != body.points.size())
    throw InputError("the simulation is of another body (" + series.snapshot().body + ", not " + body.hash +
                     "): solve this one with cleft solve --mesh");
  for (std::size_t f = 0; f < times_.size(); ++f) {
    auto& frame = frames_.emplace_back();
    for (const Vec3& d : series.displacement(f))
      frame.push_back({static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)});
  }
  for (const CutMesh::Vertex& v : cuts.front()->mesh().vertices()) rest_.push_back(v.position);
  places_ = places_in(body, cuts, scale);
  find_guard(cuts.front()->mesh());
}

/// Skin may be stretched, and lips may press, as far as the simulation has them. Where no triangle turns over
/// nothing is changed, nor where the guard would hold back the wound itself.
void SimulatedWounds::find_guard(const CutMesh& mesh) {
  const auto excused = [](int, int, double) { return true; };
  GuardSearch search(mesh, GuardSearch::least_jump_mm / scale_,
                     {[](int, std::size_t) { return false; }, excused, excused, {}});
  const std::size_t last = times_.size() - 1, count = std::min(most_looks, last);
  std::vector<Vec3> now(rest_.size());
  bool turns = false;
  for (std::size_t i = 1; i <= count; ++i) {
    bare_positions(times_[i * last / count], now);
    turns = turns || !turned_triangles(mesh, now).empty();
    std::vector<std::pair<int, Vec3>> moved;
    moved.reserve(places_.size());
    for (const Place& place : places_)
      moved.emplace_back(place.vertex, now[place.vertex] - rest_[place.vertex]);
    search.add(std::move(moved), true);
  }
  if (!turns || !search.find()) return;
  Guard guard = search.result();
  if (static_cast<double>(guard.changes().size()) < most_changed * static_cast<double>(places_.size()))
    guard_ = std::move(guard);
}

SimulatedWounds::Moment SimulatedWounds::moment(double t) const {
  const auto next = std::upper_bound(times_.begin(), times_.end(), t) - times_.begin();
  const std::size_t frame = std::clamp<std::size_t>(next, 1, times_.size() - 1) - 1;
  return {frame, std::clamp((t - times_[frame]) / (times_[frame + 1] - times_[frame]), 0., 1.)};
}

Vec3 SimulatedWounds::of_node(int node, const Moment& at) const {
  const auto &before = frames_[at.frame][node], &after = frames_[at.frame + 1][node];
  Vec3 sum;
  for (int axis = 0; axis < 3; ++axis) sum[axis] = (1 - at.part) * before[axis] + at.part * after[axis];
  return sum;
}

Vec3 SimulatedWounds::displacement(const Place& place, double t) const {
  const Moment at = moment(t);
  Vec3 sum;
  for (int i = 0; i < 3; ++i) sum += place.weights[i] * of_node(place.nodes[i], at);
  return sum;
}

double SimulatedWounds::gape(double t) const {
  const Moment at = moment(t);
  double widest = 0;
  for (const BodyPair& pair : pairs_)
    widest = std::max(widest, dot(pair.normal, of_node(pair.right, at) - of_node(pair.left, at)));
  return widest;
}

void SimulatedWounds::positions(double t, std::span<Vec3> out) const {
  bare_positions(t, out);
  guard_.apply(0, t, rest_.data(), out.data());
}

void SimulatedWounds::bare_positions(double t, std::span<Vec3> out) const {
  CLEFT_CHECK(out.size(), ==, rest_.size());
  std::copy(rest_.begin(), rest_.end(), out.begin());
  for (const Place& place : places_) out[place.vertex] += 1 / scale_ * displacement(place, t);
}

ReplayOff SimulatedWounds::off(const std::vector<const Incision*>& cuts, std::span<const Vec3> replayed,
                               double t) const {
  std::vector<Vec3> simulated(rest_.size());
  bare_positions(t, simulated);
  return replay_off(cuts, replayed, simulated, reach_of_ends_);
}

std::vector<int> turned_triangles(const CutMesh& mesh, std::span<const Vec3> positions) {
  std::vector<int> turned;
  for (int t = 0; t < static_cast<int>(mesh.triangles().size()); ++t) {
    if (!mesh.is_skin(t)) continue;
    const auto [a, b, c] = mesh.triangle(t).vertex;
    if (is_turned_over({mesh.position(a), mesh.position(b), mesh.position(c)},
                       {positions[a], positions[b], positions[c]}))
      turned.push_back(t);
  }
  return turned;
}

ReplayOff replay_off(const std::vector<const Incision*>& cuts, std::span<const Vec3> replayed,
                     std::span<const Vec3> simulated, double end) {
  const CutMesh& mesh = cuts.front()->mesh();
  std::vector<Vec3> ends;
  for (const Incision* cut : cuts)
    for (const double s : {0., cut->path().length()}) ends.push_back(cut->path().at(s).position);
  const auto at_end = [&](int v) {
    return std::any_of(ends.begin(), ends.end(),
                       [&](const Vec3& x) { return norm(mesh.position(v) - x) < end; });
  };
  ReplayOff off;
  for (int v = 0; v < static_cast<int>(simulated.size()); ++v) {
    off.largest = std::max(off.largest, norm(simulated[v] - mesh.position(v)));
    if (const double by = norm(simulated[v] - replayed[v]); by > off.displacement && !at_end(v))
      off.displacement = by;
  }
  for (const Incision* cut : cuts)
    for (const Incision::ChainVertex& c : cut->chain()) {
      const Vec3 open = simulated[c.right] - simulated[c.left];
      off.gape = std::max(off.gape, norm(open));
      if (const double by = norm(open - (replayed[c.right] - replayed[c.left]));
          by > off.opening && !at_end(c.left))
        off.opening = by;
    }
  return off;
}

}  // namespace cleft
