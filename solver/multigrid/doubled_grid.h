// A grid whose nodes are doubled along cuts, and coarser grids of some of its lines.
#pragma once

#include <array>
#include <unordered_map>
#include <utility>
#include <vector>

namespace cleft {

/// Lines of the finest grid that a coarser one has, along its three axes; increasing.
using GridLines = std::array<std::vector<int>, 3>;

/// Nodes are numbered as in the mesh: first those of the grid, (k size[1] + j) size[0] + i, then the right
/// nodes of the pairs. Coarser grids keep the lines in which cuts lie and end, so that each of their nodes
/// on a cut has the same copies there, and every node takes values from copies on its own side.
class DoubledGrid {
 public:
  struct Pair {
    int left, right;  ///< at one place; a right node is the left one of later pairs only
  };
  /// `places`: of the lines along each axis, mm. `wedges`: corners of the elements, each within one cell of
  /// the grid: they tell which copy of a node is on which side.
  DoubledGrid(std::array<std::vector<double>, 3> places, std::vector<Pair> pairs,
              const std::vector<std::array<int, 6>>& wedges);

  int nodes() const { return single_nodes() + static_cast<int>(pairs_.size()); }
  const std::vector<Pair>& pairs() const { return pairs_; }
  GridLines finest() const;
  /// About half as many lines where they are densest: neighbouring elements are joined where they are not
  /// longer together than `longest`, mm.
  GridLines coarser(const GridLines& lines, double longest) const;
  /// Number of nodes with all copies.
  std::size_t count(const GridLines& lines) const;
  bool has(const GridLines& lines, int node) const;
  /// Shortest element along any axis, mm.
  double shortest(const GridLines& lines) const;

  /// A node of a coarser grid and its share.
  using Share = std::pair<int, double>;
  /// Where values at the nodes of some grid come from in a coarser one: linear along each axis.
  class Interpolation {
   public:
    Interpolation(const DoubledGrid& grid, const GridLines& coarse);
    /// Of a node of any finer grid.
    void shares(int node, std::vector<Share>& shares) const;

   private:
    struct Bracket {
      int lower, upper;
      double share;  // of the upper one
    };
    const DoubledGrid& grid_;
    std::array<std::vector<Bracket>, 3> brackets_;
  };

  /// From how many open pairs on each pair of a coarser grid is open, given those of the finer one: when all
  /// pairs that take values from it are open, so that coarse functions keep closed pairs closed.
  std::vector<int> opens_after(const std::vector<int>& finer, const GridLines& fine,
                               const GridLines& coarse) const;

  /// All nodes at the place of a node.
  std::vector<int> copies(int node) const;
  /// The pair whose right node this is; -1 for none.
  int pair_of(int node) const { return node < single_nodes() ? -1 : pair_of_right_[node - single_nodes()]; }

 private:
  using Index = std::array<int, 3>;
  int single_nodes() const { return size_[0] * size_[1] * size_[2]; }
  int number(const Index& at) const { return (at[2] * size_[1] + at[1]) * size_[0] + at[0]; }
  int place(int node) const { return node < single_nodes() ? node : place_of_right_[node - single_nodes()]; }
  Index index(int node) const;
  /// The copy at a place that elements see from one of the four sides: 1 for larger u, plus 2 for larger v.
  int seen(int place, int side) const;
  int side_of(int node) const;
  void add_kept_lines();
  /// Pairs between two copies at a place.
  std::vector<int> pairs_between(int a, int b) const;

  Index size_;
  std::array<std::vector<double>, 3> places_;
  std::vector<Pair> pairs_;
  std::vector<int> place_of_right_, pair_of_right_;
  std::unordered_map<int, std::array<int, 4>> seen_;  // by place with copies
  std::array<std::vector<bool>, 3> kept_;             // lines of the cuts and of their ends
};

}  // namespace cleft
