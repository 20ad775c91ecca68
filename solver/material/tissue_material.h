// The material of a region of cells: a law of linear elasticity, as a value.
#pragma once

#include <deal.II/base/tensor.h>
#include <deal.II/lac/full_matrix.h>

#include <concepts>
#include <functional>
#include <span>
#include <vector>

namespace cleft {

/// The gradients of a node's shape function at a point, 1/mm. `dilatation` gives the change of volume: the
/// same as `strain`, or its mean over the cell where the volume of a cell changes as a whole (mean
/// dilatation).
struct ShapeGradient {
  dealii::Tensor<1, 3> strain, dilatation;
};

/// A quadrature point of a cell and its weight, mm^3.
struct CellPoint {
  std::vector<ShapeGradient> nodes;
  double volume;
};

/// A law gives, for shape functions a and b at a point, the 3 x 3 block B_a^T D B_b, MPa/mm^2: the forces
/// along the three axes at node a, for each mm^3, of unit displacements of node b.
template <class Law>
concept LinearTissueLaw = requires(const Law& law, const ShapeGradient& a) {
  { law.stiffness(a, a) } -> std::convertible_to<dealii::Tensor<2, 3>>;
};

class TissueMaterial {
 public:
  /// The loop over the points and the pairs of nodes is compiled for each law: one indirect call for each
  /// cell.
  template <LinearTissueLaw Law>
  TissueMaterial(const Law& law)
      : add_stiffness_([law](std::span<const CellPoint> points, dealii::FullMatrix<double>& matrix) {
          for (const CellPoint& point : points)
            for (unsigned a = 0; a < point.nodes.size(); ++a)
              for (unsigned b = 0; b < point.nodes.size(); ++b) {
                const dealii::Tensor<2, 3> k = law.stiffness(point.nodes[a], point.nodes[b]) * point.volume;
                for (unsigned i = 0; i < 3; ++i)
                  for (unsigned j = 0; j < 3; ++j) matrix(3 * a + i, 3 * b + j) += k[i][j];
              }
        }) {}

  /// Adds the stiffness of a cell, N/mm; unknown 3 a + i is the displacement of node a along axis i.
  void add_stiffness(std::span<const CellPoint> points, dealii::FullMatrix<double>& matrix) const {
    add_stiffness_(points, matrix);
  }

 private:
  std::function<void(std::span<const CellPoint>, dealii::FullMatrix<double>&)> add_stiffness_;
};

}  // namespace cleft
