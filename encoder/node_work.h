// Splines against the data at all nodes: errors, and what is left, coded. Work over all nodes and frames, in
// blocks of nodes.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <span>
#include <vector>

#include "encoder/field/encoded.h"
#include "encoder/samples.h"

namespace cleft {

/// The spline of one of a series' fields: a field for every three components.
struct NodeSpline {
  static constexpr int displacement = -1;

  int field = displacement;  ///< or the number of a further quantity
  int components = 3;
  std::vector<Field> parts;
};

/// Of the nodes of a block in a frame.
struct NodeErrors {
  double error = 0, data = 0;  ///< sums of squares: of the difference from the data, and of these
  double largest = 0;          ///< norm of the difference (norms_of)
  std::size_t worst_node = 0;  ///< where it is
};

/// What a spline leaves at the nodes of a block.
struct CodedBlock {
  std::vector<std::uint8_t> bytes;
  double largest = 0;  ///< norm of what spline and code together leave, at any node and frame
};

/// Work over all nodes of a series, here or in other processes.
class NodeWork {
 public:
  virtual ~NodeWork() = default;

  /// Of each frame, blocks of nodes one after another.
  virtual std::vector<NodeErrors> errors(const NodeSpline& spline) const = 0;
  /// Of every block. `kind` tells quantum, components, and the first frame that is coded.
  virtual std::vector<CodedBlock> code(const NodeSpline& spline, const CodedResidual& kind) const = 0;
};

/// In this process, on all cores.
class NodeWorkHere : public NodeWork {
 public:
  /// Values of a field at nodes first .. first + count - 1 in a frame, count x components.
  using Read =
      std::function<Eigen::MatrixXd(int field, std::size_t frame, std::size_t first, std::size_t count)>;

  /// `block`: nodes of each block but the last. Keeps references to samples and times.
  NodeWorkHere(std::span<const Sample> nodes, std::span<const double> times, std::size_t block, Read read)
      : nodes_(nodes), times_(times), block_(block), read_(std::move(read)) {}

  std::vector<NodeErrors> errors(const NodeSpline& spline) const override;
  std::vector<CodedBlock> code(const NodeSpline& spline, const CodedResidual& kind) const override;

 private:
  std::size_t blocks() const { return (nodes_.size() + block_ - 1) / block_; }
  std::size_t size_of(std::size_t block) const { return std::min(block_, nodes_.size() - block * block_); }
  NodeErrors errors_of(const NodeSpline& spline, std::size_t frame, std::size_t block) const;
  /// Takes the spline from the data of a block.
  Eigen::MatrixXd left(const NodeSpline& spline, std::size_t frame, std::size_t block,
                       Eigen::MatrixXd data) const;
  Eigen::MatrixXd read(const NodeSpline& spline, std::size_t frame, std::size_t block) const {
    return read_(spline.field, frame, block * block_, size_of(block));
  }

  std::span<const Sample> nodes_;
  std::span<const double> times_;
  std::size_t block_;
  Read read_;
};

}  // namespace cleft
