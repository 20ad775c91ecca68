// The product of a block of a normal matrix with control points.
#pragma once

namespace cleft {

/// Control points of a row along the cut: four numbers each, j W + k.
struct StencilBlock {
  const double* values;  ///< as SpaceFit::Parts::Stencil
  int V, W;              ///< control points across and in height
};

/// to += block from, and, where `to_other` is not null, to_other += block^T other: what a symmetric matrix
/// adds with a block that is not on its diagonal.
void add_product(const StencilBlock& block, const double* from, double* to, const double* other,
                 double* to_other);

}  // namespace cleft
