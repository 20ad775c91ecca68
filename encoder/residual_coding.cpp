#include "encoder/residual_coding.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/parallel.h"

namespace cleft {

namespace {

/// A block's numbers, and the largest norm of what they leave.
class Block {
 public:
  Block(const CodedResidual& kind, int number)
      : kind_(kind),
        first_(static_cast<std::size_t>(kind.first_of(number))),
        nodes_(static_cast<std::size_t>(kind.nodes_of(number))),
        numbers_(nodes_ * static_cast<std::size_t>(kind.components) * static_cast<std::size_t>(kind.frames)),
        largest_(static_cast<std::size_t>(kind.frames), 0) {}

  /// `frame`: of those that are kept.
  void quantise(int frame, const Left& left) {
    const int of_series = frame + kind_.first_frame;
    Eigen::MatrixXd rest = left(static_cast<std::size_t>(of_series), first_, nodes_);
    for (Eigen::Index n = 0; n < rest.rows(); ++n)
      for (int c = 0; c < kind_.components; ++c) {
        const auto number = static_cast<std::int32_t>(std::lround(rest(n, c) / kind_.quantum));
        numbers_[static_cast<std::size_t>((n * kind_.components + c) * kind_.frames + frame)] = number;
        rest(n, c) -= kind_.quantum * number;
      }
    largest_[frame] = norms_of(rest).maxCoeff();
  }

  double largest() const {
    return largest_.empty() ? 0 : *std::max_element(largest_.begin(), largest_.end());
  }

  /// Throws std::logic_error if they do not come back.
  std::vector<std::uint8_t> coded() const {
    std::vector<std::uint8_t> bytes = encode_block(numbers_, kind_.components, kind_.frames);
    if (!(decode_block(bytes, static_cast<int>(nodes_), kind_.components, kind_.frames) ==
          SmallIntegers(numbers_)))
      throw std::logic_error("a residual is not decoded as it was coded");
    return bytes;
  }

 private:
  const CodedResidual& kind_;
  std::size_t first_, nodes_;
  std::vector<std::int32_t> numbers_;
  std::vector<double> largest_;  // by frame
};

}  // namespace

std::vector<Vec3> spline_at(const Field& field, std::span<const Sample> nodes, double t) {
  std::vector<Place> places;
  places.reserve(nodes.size());
  for (const Sample& node : nodes) places.push_back({node.uvw, node.side, t});
  std::vector<Vec3> values(places.size());
  field.displacements(places, values);
  return values;
}

CodedResidual code_residual(CodedResidual kind, const Left& left, double& largest) {
  kind.blocks.resize(static_cast<std::size_t>(std::max(1, (kind.nodes - 1) / kind.block + 1)));
  const int blocks = static_cast<int>(kind.blocks.size());
  std::vector<double> of_blocks(kind.blocks.size());
  parallel_for(blocks, [&](int b) {
    Block block(kind, b);
    const auto quantise = [&](int frame) { block.quantise(frame, left); };
    if (blocks == 1)
      parallel_for(kind.frames, quantise);
    else
      for (int frame = 0; frame < kind.frames; ++frame) quantise(frame);
    of_blocks[b] = block.largest();
    kind.blocks[b] = block.coded();
  });
  largest = *std::max_element(of_blocks.begin(), of_blocks.end());
  return kind;
}

}  // namespace cleft
