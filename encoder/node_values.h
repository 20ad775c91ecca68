// The fields of a series at its nodes, read from its snapshot in slabs.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "base/turned.h"
#include "solver/snapshot/snapshot_values.h"

namespace cleft {

/// A row a node.
using NodeRows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Which nodes of which snapshot a series has, and how their displacements become those of the field.
struct NodesInFile {
  std::string file;
  std::size_t points = 0;           ///< of the file
  std::optional<TakenNodes> taken;  ///< nodes of the file, in the order of the series; none: all of them
  /// Of each node, the field's axes; none: those of `taken`.
  std::vector<AxesInSpace> axes;
  /// The further quantities, by number. One without a name is the displacement of frame 0, in all frames.
  std::vector<SnapshotArray> quantities;

  std::size_t size() const { return taken ? taken->nodes.size() : points; }
  /// Those of count nodes from `first` on.
  NodesInFile part(std::size_t first, std::size_t count) const;
};

/// All functions may be called from several threads at once.
class NodeValues {
 public:
  /// Opens the file, and reads its frame 0. Throws FileError if it is damaged.
  explicit NodeValues(NodesInFile nodes);

  const NodesInFile& nodes() const { return nodes_; }
  /// Of nodes first .. first + count - 1: of NodeSpline::displacement that from frame 0 along the field's
  /// axes, mm; else of the further quantity of this number.
  NodeRows values(int field, std::size_t frame, std::size_t first, std::size_t count) const;
  /// A further quantity's own values.
  NodeRows quantity(std::size_t number, std::size_t frame, std::size_t first, std::size_t count) const;

 private:
  NodeRows displacement(std::size_t frame, std::size_t first, std::size_t count) const;

  NodesInFile nodes_;
  SnapshotValues values_;
  mutable std::mutex one_at_a_time_;  // HDF5 serves one thread
  NodeRows closed_;                   // displacement in frame 0, along the axes of `taken`
};

}  // namespace cleft
