// The simulation that a field was fitted to: its nodes, and the requested parts of its frames.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "encoder/field/field.h"
#include "solver/snapshot/snapshot.h"

namespace cleft {

class RawCase {
 public:
  /// Reads all but the displacements. Throws FileError if the snapshot is damaged, InputError if it is not
  /// that of the field.
  RawCase(const std::string& snapshot, std::shared_ptr<const Field> field);

  const Snapshot& snapshot() const { return reader_.snapshot(); }
  const Field& field() const { return *field_; }
  std::size_t nearest_frame(double t) const;
  Side side(int node) const { return sides_[node]; }
  /// The nearest node among those on that side, or uncut in the plane of the cut.
  int nearest_node(const Vec3& uvw, Side side) const;
  std::vector<int> nodes_within(const Vec3& uvw, double radius) const;  ///< at rest, mm; ascending

  /// Displacements of `nodes` (ascending) from the closed frame, mm. Reads only the slabs of rows that
  /// contain them.
  std::vector<Vec3> displacements(std::size_t frame, std::span<const int> nodes) const;
  /// Errors of the field against these displacements: Euclidean, mm.
  std::vector<double> errors(std::size_t frame, std::span<const int> nodes) const;

  std::size_t rows_read() const { return rows_read_; }  ///< rows of displacements read so far

 private:
  std::vector<Vec3> rows_of(std::size_t frame, std::span<const int> nodes) const;

  SnapshotReader reader_;
  std::shared_ptr<const Field> field_;
  std::vector<Side> sides_;
  std::vector<int> by_u_;  // nodes in the order of u
  mutable std::size_t rows_read_ = 0;
};

}  // namespace cleft
