// How far a spline is off between the nodes.
#pragma once

#include <vector>

#include "encoder/field/field.h"
#include "encoder/series.h"

namespace cleft {

/// Where a spline is off most between the nodes, and by how much there.
struct BetweenNodes {
  double error = 0;
  Vec3 at;  ///< (u, v, w)
  double time = 0;
};

/// At centroids of cells and middles of edges, where elements have the mean of their nodes: the distance from
/// it, less what the values vary by within cells of the same nodes, since a smooth field differs from the
/// mean by a part of that. What is left is no curvature of the field, but a spline that goes astray where no
/// node holds it.
///
/// Sets between_nodes of the field's report, over the largest displacement, and of its quantities, over their
/// scale. Gives where it is: of the displacement, then of each quantity.
std::vector<BetweenNodes> add_between_nodes(Field& field, const Series& series);

/// The largest distance of the displacement from the mean of the nodes at centroids of cells, mm.
double error_at_centres(const Field& field, const Series& series);

}  // namespace cleft
