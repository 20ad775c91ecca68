// The samples of a series among its snapshot's nodes.
#pragma once

#include <memory>
#include <vector>

#include "encoder/node_values.h"
#include "encoder/own_coordinates.h"
#include "encoder/samples.h"
#include "encoder/series.h"

namespace cleft {

/// Samples are nodes of the snapshot or, with coordinates of their own, places at which a node is seen; all
/// of them, or a part (fitted_nodes.h).
class SeriesSamples {
 public:
  using Pairs = std::vector<std::array<std::int32_t, 2>>;

  /// `places`: all; the first `nodes` of them are of nodes, one for each.
  SeriesSamples(const Snapshot& s, const std::vector<Sample>& places,
                std::shared_ptr<const OwnCoordinates> own, std::size_t nodes, std::size_t most);

  bool has_axes() const { return own_ != nullptr; }
  bool in_part() const { return !fitted_.empty(); }
  std::size_t size() const { return in_part() ? fitted_.size() : places_; }
  std::size_t nodes() const;  ///< of the samples, the first ones
  std::size_t place(std::size_t sample) const { return in_part() ? fitted_[sample] : sample; }
  std::size_t node_of(std::size_t place) const { return own_ ? own_->node[own_->kept[place]] : place; }
  /// A displacement at a place, in the field's axes.
  Vec3 in_axes(std::size_t place, const Vec3& d) const {
    return own_ ? own_->components(own_->kept[place], d) : d;
  }

  /// Values at the samples, of those at all nodes.
  Eigen::MatrixXd at_samples(const Eigen::MatrixXd& values) const;
  /// Pairs of places as pairs of samples.
  Pairs pairs_of(const Pairs& pairs) const;
  /// Connectivity of the cells whose nodes are all samples.
  Snapshot cells_of(const Snapshot& s) const;

  /// Where the nodes of the series are in its file, with the quantities, and the displacement of frame 0.
  NodesInFile nodes_in_file(const SnapshotValues& values, std::vector<SnapshotArray> quantities) const;

 private:
  std::shared_ptr<const OwnCoordinates> own_;
  std::size_t nodes_, places_;
  std::vector<std::int32_t> fitted_;  // empty: all
};

}  // namespace cleft
