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

/// mm: of the solver's meshes; a guess for those of others.
double node_spacing(const CommonCase& one);

/// Places of a body that all cases have in common: of the case with the fewest nodes along its cut. Where it
/// has some, all have.
struct CommonPlaces {
  FieldGeometry body;
  std::vector<Place> places;
};
CommonPlaces places_in_common(const CommonCases& cases);

/// x, y, z one after another of the displacements of control points on the common bases, mm.
Eigen::VectorXd sample(const CommonCases& cases, const std::vector<Vec3>& points, const CommonPlaces& at);
/// A column for each case, and for each of some cases.
Eigen::MatrixXd sample_cases(const CommonCases& cases, const CommonPlaces& at);
Eigen::MatrixXd sample_cases(const CommonCases& cases, const CommonPlaces& at, const std::vector<int>& some);
/// A column for each of their derivatives.
Eigen::MatrixXd sample_derivatives(const CommonCases& cases, const CommonPlaces& at);

/// Largest norm of the points (x, y, z one after another) in a column.
double largest_point(const Eigen::Ref<const Eigen::VectorXd>& column);

/// The largest displacement at these places, mm.
double largest_displacement(const Field& field, const std::vector<Place>& places);

}  // namespace cleft
