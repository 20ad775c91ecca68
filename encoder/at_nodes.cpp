#include "encoder/at_nodes.h"

#include <algorithm>
#include <utility>

namespace cleft {

namespace {

/// Calls work(work over all nodes), which is done elsewhere or here.
template <class Work>
auto over_nodes(const Series& series, const Work& work) {
  if (series.elsewhere) return work(*series.elsewhere);
  return work(NodeWorkHere(series.node_samples(), series.times, series.block,
                           [&series](int field, std::size_t frame, std::size_t first, std::size_t count) {
                             return series.values(field, frame, first, count);
                           }));
}

/// The largest norm of a change by 1 of each component, each way.
double norm_of_ones(int components) { return norms_of(Eigen::MatrixXd::Ones(1, components))(0); }

}  // namespace

double step_within(double bound, int components, double share) {
  return share * 2 / norm_of_ones(components) * bound;
}

std::vector<NodeErrors> node_errors(const Series& series, const NodeSpline& spline) {
  const std::vector<NodeErrors> parts =
      over_nodes(series, [&](const NodeWork& work) { return work.errors(spline); });
  std::vector<NodeErrors> frames(series.times.size());
  const std::size_t blocks = parts.size() / frames.size();
  for (std::size_t part = 0; part < parts.size(); ++part) {
    NodeErrors& frame = frames[part / blocks];
    frame.error += parts[part].error, frame.data += parts[part].data;
    if (parts[part].largest > frame.largest)
      frame.largest = parts[part].largest, frame.worst_node = parts[part].worst_node;
  }
  return frames;
}

CodedResidual code_left(const Series& series, const NodeSpline& spline, int first_frame, double bound,
                        double& largest) {
  CodedResidual coded;
  coded.components = spline.components, coded.first_frame = first_frame;
  // A little less, for rounding.
  coded.quantum = step_within(bound, spline.components, 1 - 1e-9);
  coded.nodes = static_cast<int>(series.node_samples().size());
  coded.frames = static_cast<int>(series.times.size()) - first_frame;
  coded.block = static_cast<int>(series.block);
  std::vector<CodedBlock> blocks =
      over_nodes(series, [&](const NodeWork& work) { return work.code(spline, coded); });
  largest = 0;
  for (CodedBlock& block : blocks) {
    largest = std::max(largest, block.largest);
    coded.blocks.push_back(std::move(block.bytes));
  }
  return coded;
}

}  // namespace cleft
