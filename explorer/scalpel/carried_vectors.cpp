#include "explorer/scalpel/carried_vectors.h"

#include <algorithm>
#include <map>
#include <utility>

namespace cleft {

namespace {

struct State {
  bool is_new = false, known = false;
  Vec3 sum;
  double weights = 0;
  void add(const Vec3& value, double distance) {
    const double weight = 1 / std::max(distance, 1e-30);
    sum += weight * value, weights += weight;
  }
};

}  // namespace

CarriedVectors::CarriedVectors(const CutMesh& mesh, std::vector<Vec3> values)
    : own_(values.size()), values_(std::move(values)) {
  for (std::size_t v = 0; v < own_; ++v) known_.push_back(mesh.position(static_cast<int>(v)));
}

std::vector<int> CarriedVectors::follow(const CutMesh& mesh) {
  if (own_ == 0) return {};
  const std::size_t before = values_.size();
  values_.resize(mesh.vertices().size());
  known_.resize(values_.size());
  std::vector<int> changed;
  for (const int t : mesh.changed())
    if (static_cast<std::size_t>(t) < mesh.triangles().size()) changed.push_back(t);
  std::map<int, State> states;
  for (const int t : changed)
    for (const int v : mesh.triangle(t).vertex) {
      const auto i = static_cast<std::size_t>(v);
      State& state = states[v];
      // Numbers of vertices that were taken back are given anew.
      state.is_new = i >= own_ && (i >= before || !(known_[i] == mesh.position(v)));
      state.known = state.known || (!state.is_new && mesh.is_skin(t));
    }
  const auto find = [&] {
    for (bool any = true; any;) {
      any = false;
      for (const int t : changed)
        for (const int v : mesh.triangle(t).vertex)
          for (const int next : mesh.triangle(t).vertex)
            if (State& state = states.at(v); v != next && !state.known && states.at(next).known)
              state.add(values_[static_cast<std::size_t>(next)],
                        norm(mesh.position(v) - mesh.position(next)));
      for (auto& [v, state] : states) {
        if (state.known || state.weights == 0) continue;
        const auto i = static_cast<std::size_t>(v);
        values_[i] = (1 / state.weights) * state.sum, known_[i] = mesh.position(v);
        state.known = any = true;
      }
    }
  };
  find();  // the walls from their lips, and not along their bottoms, where errors would add up
  for (auto& [v, state] : states) state.known = state.known || !state.is_new;
  find();
  std::vector<int> found;
  for (const auto& [v, state] : states)
    if (state.is_new) found.push_back(v);
  return found;
}

}  // namespace cleft
