// Centroids of cells in which a front ends, in quadratic elements.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "encoder/cell_centres.h"

namespace cleft {

/// Between a front, which is inside an element, and the first open node, lips close as the square root of the
/// distance from the front. In linear elements, whose front is 0.42 of them from the closed node
/// (params/meshed_cut.h), the mean of a cell's nodes is near to that; in quadratic ones, whose front is 0.2
/// of the distance of two nodes from it, it is 15 % of the opening less.
class FrontCentres {
 public:
  /// Of cells that have a node on v = 0. `pairs`: left and right node.
  FrontCentres(const CellCentres& centres, const std::vector<Sample>& samples,
               const std::vector<std::array<std::int32_t, 2>>& pairs);

  /// Replaces the part of the opening in the mean of a frame's displacements, M x 3, by that of a root. `d`:
  /// of the frame, N x 3; `fronts`: u of the cut's start and tip.
  void correct(Eigen::MatrixX3d& means, const Eigen::Ref<const Eigen::MatrixX3d>& d,
               const std::array<double, 2>& fronts) const;

 private:
  /// A node of a cell, with that at the same place on the other side.
  struct Lip {
    Eigen::Index node, opposite;
    bool in_front;  // at the greatest u of the cell
  };
  struct Cell {
    Eigen::Index number;
    double u, back, front;  // of the centroid, and of the cell's ends
    double share;           // of a node in the mean
    std::vector<Lip> lips;
  };
  std::vector<Cell> cells_;
};

}  // namespace cleft
