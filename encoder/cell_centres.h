// Centroids of cells, for collocation between the nodes.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "encoder/samples.h"
#include "solver/snapshot/snapshot.h"

namespace cleft {

/// Centroids of a snapshot's cells, at which linear elements have the mean of their nodes' displacements.
/// Cells in or across the plane v = 0 are left out, because their side is unknown.
struct CellCentres {
  std::vector<Sample> samples;      ///< M
  std::vector<bool> touches_plane;  ///< M: the cell has a node on v = 0
  std::vector<std::int64_t> nodes;  ///< of one cell after another
  std::vector<std::size_t> first;   ///< M + 1: where each begins there

  /// M rows, of a frame's N.
  Eigen::MatrixXd mean(const Eigen::Ref<const Eigen::MatrixXd>& frame) const;
  /// The centroids with the given numbers.
  CellCentres only(const std::vector<std::size_t>& some) const;
};

/// `samples`: those of the snapshot's nodes.
CellCentres cell_centres(const Snapshot& snapshot, const std::vector<Sample>& samples);
/// The same of the edges of linear cells; those in v = 0 are on the side of their nodes, and left out where
/// these are on both sides.
CellCentres edge_middles(const Snapshot& snapshot, const std::vector<Sample>& samples);
/// Adds the middles of cells' quadrilaterals that lie on a lip.
void add_quadrilaterals_on_lips(CellCentres& middles, const Snapshot& snapshot,
                                const std::vector<Sample>& samples);

}  // namespace cleft
