#include "tradeoff/model_error.h"

#include <algorithm>

#include "base/text.h"
#include "params/consistency.h"
#include "tradeoff/advice.h"
#include "tradeoff/chain.h"

namespace cleft {

namespace {

constexpr double compared_elements[] = {8, 16};  // between them the difference changes by a tenth
constexpr double compared_margin = 1;            // of the patch, over the cut's length

/// Of the last frame.
double largest_rise(const SnapshotReader& reader) {
  const Snapshot& s = reader.snapshot();
  const std::vector<Vec3> d = reader.displacement(s.times.size() - 1);
  double most = 0;
  for (const auto& pair : s.pairs)
    for (const int node : pair)
      if (s.points[node].z == 0) most = std::max(most, d[node].z);
  return most;
}

}  // namespace

ModelError model_error(const Parameters& parameters, const std::string& work,
                       const std::function<void(const std::string&)>& progress) {
  const double length = parameters.cut.length;
  const auto coarse = [&](double elements, Model model) {
    Parameters p =
        applied({.element_size = length / elements, .margin = compared_margin * length}, parameters);
    p.model = model, p.mesh.cut_length = p.mesh.cut_depth = 0;
    if (model == Model::finite) p.skin.initial_stress_stiffness = false, p.skin.turning_stiffness = 0;
    check_consistency(p, "model = \"finite\"");
    progress("solving with " + std::string(model == Model::small ? "small" : "finite") + " strains and " +
             shortest(elements) + " elements along the cut");
    return p;
  };
  const auto samples = [&](const Opening& opening) {
    return sampled(length, [&](double s, double t) { return opening.at(s, t); });
  };
  ModelError result;
  Samples finite;
  double largest = 0;
  for (const double elements : compared_elements) {
    const Chain chain(coarse(elements, Model::finite), work);
    const Opening opening = chain.opening();
    finite = samples(opening), largest = opening.largest();
    result.finite_rise = largest_rise(SnapshotReader(chain.snapshot()));
    result.finite.push_back({chain.nodes(), chain.solve_seconds() + chain.encoded(0.01).seconds});
  }
  const Chain chain(coarse(compared_elements[std::size(compared_elements) - 1], Model::small), work);
  const Opening small = chain.opening();
  result.small_rise = largest_rise(SnapshotReader(chain.snapshot()));
  result.error = difference(samples(small), finite);
  for (Vec3& x : result.error) x *= 1 / largest;
  result.ratio = largest / small.largest();
  return result;
}

}  // namespace cleft
