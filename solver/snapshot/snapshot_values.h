// Values at a snapshot's nodes, read in slabs, without its mesh.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/h5/h5.h"
#include "base/turned.h"

namespace cleft {

/// The group of all arrays of the points.
inline const std::string point_data_group = "/VTKHDF/PointData";

/// A further array of the points: /VTKHDF/PointData/<name>, one for all frames or one for each frame.
struct SnapshotArray {
  std::string name;
  std::size_t components = 1;  ///< numbers for each point
  bool varies = false;         ///< F N rows instead of N
};

/// Some of a snapshot's nodes, whose vectors and tensors are read along other axes.
struct TakenNodes {
  std::vector<std::int32_t> nodes;
  AxesInSpace axes = same_axes;
};

/// What a snapshot holds at its nodes, or at those that are taken: numbers `first` and on count these.
class SnapshotValues {
 public:
  /// `points`: of the snapshot.
  SnapshotValues(h5::File file, std::size_t points, std::optional<TakenNodes> taken = {});

  const h5::File& file() const { return file_; }
  std::size_t points() const { return points_; }
  const std::optional<TakenNodes>& taken() const { return taken_; }
  void take(TakenNodes taken) { taken_ = std::move(taken); }

  /// Displacements in a frame. Throws FileError that names frame and node if one is not finite.
  std::vector<Vec3> displacement(std::size_t frame, std::size_t first, std::size_t count) const;
  /// Numbers of a further array, node by node; those of `frame` if the array varies.
  std::vector<double> array(const SnapshotArray& array, std::size_t frame, std::size_t first,
                            std::size_t count) const;

 private:
  /// Of nodes, in a dataset whose row `row` is that of the file's first node.
  std::vector<double> rows(const std::string& dataset, std::size_t row, std::size_t components,
                           std::size_t first, std::size_t count) const;

  h5::File file_;
  std::size_t points_;
  std::optional<TakenNodes> taken_;
};

}  // namespace cleft
