// Geometric multigrid for a grid of wedges with a growing cut.
#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <map>
#include <memory>
#include <stdexcept>
#include <vector>

#include "solver/multigrid/level.h"

namespace cleft {

/// The matrix is not positive definite; what() tells what has shown it, as "by ...". Thrown on all ranks.
struct IndefiniteLevel : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// One V-cycle from zero approximates the inverse of P K P, where P ties the closed pairs, for several
/// vectors that may have different open pairs. Coarser levels join the shortest elements along each axis, so
/// that graded meshes become even, and their matrices are P^T K P with linear interpolation on the own side
/// of the cut. The smoother is a Chebyshev polynomial of the fourth kind (Lottes 2023) in the blocks of
/// nodes. Matrices and vectors have single precision.
class Multigrid {
 public:
  /// `finest`: nodes, owned, matrix, and the grid's finest lines. Collective, as all calls.
  Multigrid(const DoubledGrid& grid, Level finest, MPI_Comm communicator,
            const std::function<int(int)>& owner);

  /// The order in which pairs open: pair p is open with more than opens_after[p] open pairs.
  void set_release(std::vector<int> opens_after);
  /// The block to solve next: by lane the open pairs; 1 or most_lanes of them.
  void set_lanes(std::vector<int> open);

  /// The finest level: b is what apply() reads, x what it writes, of this rank's nodes.
  Level& finest() { return levels_.front(); }
  /// x = V-cycle(b)
  void apply();

 private:
  void cycle(std::size_t level);
  void smooth(Level& level, bool from_zero);
  void residual(Level& level);
  void solve_coarsest();
  void estimate_eigenvalues();
  float largest_eigenvalue(Level& level);  ///< of D^-1 A with the ties of the lane

  using Factor = Eigen::SimplicialLLT<Eigen::SparseMatrix<double>>;

  const DoubledGrid& grid_;
  MPI_Comm communicator_;
  std::vector<Level> levels_;
  std::vector<std::vector<int>> opens_after_;  // by level and pair
  const LaneTable* lanes_ = nullptr;
  std::vector<int> open_;

  // Of the coarsest level, on every rank.
  std::vector<int> coarse_numbers_;                  // of the mesh, of all ranks
  std::vector<int> coarse_counts_, coarse_offsets_;  // by rank: nodes
  std::vector<Eigen::Triplet<double, int>> coarse_matrix_;
  struct TiedFactor {
    std::vector<int> unknown_of;  // by node: the number of its group
    int groups = 0;
    Factor factor;
  };
  std::map<std::vector<int>, std::unique_ptr<TiedFactor>> factors_;  // by group of each node
  std::vector<const TiedFactor*> lane_factors_;
  /// Of the coarsest matrix with the pairs tied as with so many open ones.
  const TiedFactor& tied_factor(int open);
};

}  // namespace cleft
