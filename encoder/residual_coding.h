// What splines leave at the nodes, coded.
#pragma once

#include <algorithm>
#include <functional>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "encoder/field/encoded.h"
#include "encoder/series.h"

namespace cleft {

/// What work(frame, first, count) returns for ranges of all nodes in all frames of a series, on all cores: of
/// each frame as many, one frame after another.
template <class Work>
auto of_node_ranges(const Series& series, const Work& work) {
  constexpr std::size_t at_once = CodedResidual::most_nodes;
  const std::size_t nodes = series.node_samples().size(), ranges = (nodes - 1) / at_once + 1;
  std::vector<decltype(work(0, 0, 0))> results(series.times.size() * ranges);
  parallel_for(static_cast<int>(results.size()), [&](int i) {
    const std::size_t part = i, first = part % ranges * at_once;
    results[part] = work(part / ranges, first, std::min(at_once, nodes - first));
  });
  return results;
}

/// The spline at the nodes.
std::vector<Vec3> spline_at(const Field& field, std::span<const Sample> nodes, double t);

/// What a spline leaves of data at nodes first .. first + count - 1 in a frame: count x components.
using Left = std::function<Eigen::MatrixXd(std::size_t frame, std::size_t first, std::size_t count)>;

/// `kind` tells quantum, nodes, frames, components and the first frame. Sets `largest` to the largest norm
/// (norms_of) of what field and residual together then leave at any node and frame.
CodedResidual code_residual(CodedResidual kind, const Left& left, double& largest);

}  // namespace cleft
