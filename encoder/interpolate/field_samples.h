// Places at which fields of a study are compared.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "encoder/interpolate/common_cases.h"

namespace cleft {

/// Where a simulation with elements of that size (`spacing`, mm) has nodes, and when it has frames; closer
/// together toward the cut and its tip. What splines do between nodes, most of all where start and tip are
/// still close, no simulation has told them.
std::vector<Place> sample_places(const FieldGeometry& geometry, double spacing);

/// A column for each case: x, y, z of its displacements, mm, at these places of a body that all have in
/// common.
Eigen::MatrixXd sample_cases(const CommonCases& cases, const FieldGeometry& body,
                             const std::vector<Place>& places);

/// The largest displacement at these places, mm.
double largest_displacement(const Field& field, const std::vector<Place>& places);

}  // namespace cleft
