// A level of the multigrid: nodes, matrix, and which copies of nodes are tied.
#pragma once

#include <mpi.h>

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "solver/multigrid/doubled_grid.h"
#include "solver/multigrid/halo.h"
#include "solver/multigrid/lanes.h"

namespace cleft {

/// This rank's rows of a symmetric matrix of 3 x 3 blocks.
struct NodeMatrix {
  std::vector<std::int64_t> start = {0};
  std::vector<int> column;   ///< local node
  std::vector<float> value;  ///< nine a block, by rows
  BlockRows rows() const {
    return {static_cast<int>(start.size()) - 1, start.data(), column.data(), value.data()};
  }
};

/// The shares of a level's own nodes in the nodes of the next coarser one.
struct Prolongation {
  std::vector<std::int64_t> start = {0};
  std::vector<int> column;  ///< local node of the coarser level
  std::vector<float> weight;
  WeightRows rows() const {
    return {static_cast<int>(start.size()) - 1, start.data(), column.data(), weight.data()};
  }
};

/// Where the cut's nodes are tied, for a block of lanes: by place with copies and lane.
struct Ties {
  struct Place {
    std::vector<int> nodes;  ///< local copies
    std::vector<int> pairs;  ///< by copy: of the mesh, whose right node it is; -1 for none
    std::vector<int> left;   ///< by copy: that pair's left node, as an index into `nodes`
    /// By lane and copy: the first copy that it is tied to.
    std::array<std::vector<int>, most_lanes> first;
  };
  std::vector<Place> places;

  /// Of lanes with so many open pairs, of which pair p is open if there are more than opens_after[p].
  void set(const std::vector<int>& opens_after, const int* open, int lanes);
};

struct Level {
  std::vector<int> numbers;  ///< of local nodes in the mesh: this rank's, then copies of others'
  int owned = 0;
  GridLines lines;
  Halo halo;      ///< of all copies
  Halo cut_halo;  ///< of the copies at the places of this rank's nodes
  NodeMatrix matrix;
  std::vector<float> diagonal, inverse;  ///< nine a local node; of own ones
  Prolongation up;                       ///< to the next coarser level, if there is one
  Ties ties;
  float largest = 0;  ///< eigenvalue of D^-1 A, a little more

  std::vector<float> x, b, r, d;  ///< of the block that is being solved

  int local() const { return static_cast<int>(numbers.size()); }
  /// Values of the vectors for so many lanes.
  void resize(int lanes);
  /// Adds r over tied copies, so that relaxing each copy by its own diagonal moves all of them as that of
  /// their sum would.
  void tie(std::vector<float>& residual, int lanes) const;
};

/// Makes the coarser level of some lines: P^T A P, distributed as the nodes that both have. Collective.
Level coarser_level(Level& fine, const DoubledGrid& grid, GridLines lines, MPI_Comm communicator,
                    const std::function<int(int)>& owner);

/// Halos, the places of the cut and the diagonal, of a level with nodes and matrix; copies are added to the
/// nodes. Collective.
void finish_level(Level& level, const DoubledGrid& grid, MPI_Comm communicator,
                  const std::function<int(int)>& owner);

}  // namespace cleft
