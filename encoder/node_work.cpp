#include "encoder/node_work.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/parallel.h"
#include "encoder/norms.h"

namespace cleft {

namespace {

constexpr int at_once = 3;  // components of a part

/// What is left at the nodes of a block as whole multiples of a quantum, and what these leave.
class QuantisedBlock {
 public:
  QuantisedBlock(const CodedResidual& kind, std::size_t nodes)
      : kind_(kind),
        nodes_(nodes),
        numbers_(nodes * static_cast<std::size_t>(kind.components) * static_cast<std::size_t>(kind.frames)),
        largest_(static_cast<std::size_t>(kind.frames), 0) {}

  /// `frame`: of those that are kept.
  void add(int frame, Eigen::MatrixXd left) {
    for (Eigen::Index n = 0; n < left.rows(); ++n)
      for (int c = 0; c < kind_.components; ++c) {
        const auto number = static_cast<std::int32_t>(std::lround(left(n, c) / kind_.quantum));
        numbers_[static_cast<std::size_t>((n * kind_.components + c) * kind_.frames + frame)] = number;
        left(n, c) -= kind_.quantum * number;
      }
    largest_[static_cast<std::size_t>(frame)] = norms_of(left).maxCoeff();
  }

  /// Throws std::logic_error if they do not come back.
  CodedBlock coded() const {
    CodedBlock block{encode_block(numbers_, kind_.components, kind_.frames), 0};
    if (!(decode_block(block.bytes, static_cast<int>(nodes_), kind_.components, kind_.frames) ==
          SmallIntegers(numbers_)))
      throw std::logic_error("a residual is not decoded as it was coded");
    for (const double one : largest_) block.largest = std::max(block.largest, one);
    return block;
  }

 private:
  const CodedResidual& kind_;
  std::size_t nodes_;
  std::vector<std::int32_t> numbers_;
  std::vector<double> largest_;  // by frame
};

}  // namespace

Eigen::MatrixXd NodeWorkHere::left(const NodeSpline& spline, std::size_t frame, std::size_t block,
                                   Eigen::MatrixXd data) const {
  const auto nodes = nodes_.subspan(block * block_, size_of(block));
  std::vector<Place> places;
  places.reserve(nodes.size());
  for (const Sample& node : nodes) places.push_back({node.uvw, node.side, times_[frame]});
  std::vector<Vec3> values(places.size());
  for (int first = 0; first < spline.components; first += at_once) {
    spline.parts[static_cast<std::size_t>(first / at_once)].displacements(places, values);
    for (std::size_t n = 0; n < values.size(); ++n)
      for (int c = first; c < std::min(first + at_once, spline.components); ++c)
        data(static_cast<Eigen::Index>(n), c) -= values[n][c - first];
  }
  return data;
}

NodeErrors NodeWorkHere::errors_of(const NodeSpline& spline, std::size_t frame, std::size_t block) const {
  NodeErrors errors;
  Eigen::MatrixXd data = read(spline, frame, block);
  errors.data = norms_of(data).squaredNorm();
  const Eigen::VectorXd norms = norms_of(left(spline, frame, block, std::move(data)));
  errors.error = norms.squaredNorm();
  Eigen::Index worst = 0;
  errors.largest = norms.maxCoeff(&worst);
  errors.worst_node = block * block_ + static_cast<std::size_t>(worst);
  return errors;
}

std::vector<NodeErrors> NodeWorkHere::errors(const NodeSpline& spline) const {
  std::vector<NodeErrors> errors(times_.size() * blocks());
  parallel_for(static_cast<int>(errors.size()), [&](int i) {
    const auto part = static_cast<std::size_t>(i);
    errors[part] = errors_of(spline, part / blocks(), part % blocks());
  });
  return errors;
}

std::vector<CodedBlock> NodeWorkHere::code(const NodeSpline& spline, const CodedResidual& kind) const {
  std::vector<CodedBlock> coded(blocks());
  parallel_for(static_cast<int>(coded.size()), [&](int i) {
    const auto number = static_cast<std::size_t>(i);
    QuantisedBlock block(kind, size_of(number));
    const auto quantise = [&](int frame) {
      const std::size_t of_series =
          static_cast<std::size_t>(frame) + static_cast<std::size_t>(kind.first_frame);
      block.add(frame, left(spline, of_series, number, read(spline, of_series, number)));
    };
    if (coded.size() == 1)
      parallel_for(kind.frames, quantise);
    else
      for (int frame = 0; frame < kind.frames; ++frame) quantise(frame);
    coded[number] = block.coded();
  });
  return coded;
}

}  // namespace cleft
