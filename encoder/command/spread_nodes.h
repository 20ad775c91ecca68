// A series' nodes in the memory of several processes, one range of blocks in each. The first process fits;
// errors at all nodes are measured, and what is left is coded, where the nodes are.
#pragma once

#include <memory>
#include <span>

#include "base/ranks/ranks.h"
#include "encoder/node_values.h"
#include "encoder/node_work.h"

namespace cleft {

class SpreadNodes : public NodeWork {
 public:
  /// On the first rank, while serve() runs on the others. Keeps references to all but `times`; blocks of
  /// `block` nodes. Throws what goes wrong there: InputError, or std::runtime_error.
  SpreadNodes(const Ranks& ranks, std::shared_ptr<const NodeValues> values, std::span<const Sample> nodes,
              std::span<const double> times, std::size_t block);
  ~SpreadNodes() override;
  SpreadNodes(const SpreadNodes&) = delete;
  SpreadNodes& operator=(const SpreadNodes&) = delete;

  std::vector<NodeErrors> errors(const NodeSpline& spline) const override;
  std::vector<CodedBlock> code(const NodeSpline& spline, const CodedResidual& kind) const override;

 private:
  std::size_t first_block(int rank) const;

  const Ranks& ranks_;
  std::size_t block_, blocks_, frames_;
  std::vector<double> times_;
  int number_;  // by which the others know these nodes
  std::unique_ptr<const NodeWorkHere> here_;
};

/// SeriesStorage::spread.
inline auto spread_over(const Ranks& ranks) {
  return [&ranks](std::shared_ptr<const NodeValues> values, std::span<const Sample> nodes,
                  std::span<const double> times, std::size_t block) -> std::shared_ptr<const NodeWork> {
    return std::make_shared<SpreadNodes>(ranks, std::move(values), nodes, times, block);
  };
}

/// What all ranks but the first do as long as its OtherRanks live.
void serve_nodes(const Ranks& ranks);

/// Reads a series' fields for work in this process.
NodeWorkHere::Read reading(std::shared_ptr<const NodeValues> values);

}  // namespace cleft
