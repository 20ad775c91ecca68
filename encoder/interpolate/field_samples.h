// Places at which fields of a study are compared.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "encoder/interpolate/common_cases.h"

namespace cleft {

/// Nodes and frames of a simulation with elements of the size `spacing`, mm; denser toward the cut and its
/// tip. Between nodes the splines are not determined by a simulation, least of all where start and tip are
/// close.
std::vector<Place> sample_places(const FieldGeometry& geometry, double spacing);

/// mm: for meshes of the solver; a guess for other meshes.
double node_spacing(const RecordedParameters& parameters, const FieldGeometry& geometry);

/// Places that exist in the bodies of all cases: those of the case with the fewest nodes along its cut.
struct CommonPlaces {
  FieldGeometry body;
  std::vector<Place> places;
};
CommonPlaces places_in_common(const CommonCases& cases);

/// x, y, z one after another of the displacements of control points on the common bases, mm.
Eigen::VectorXd sample(const CommonCases& cases, const std::vector<Vec3>& points, const CommonPlaces& at);
/// One column for each case, or for each of the given cases.
Eigen::MatrixXd sample_cases(const CommonCases& cases, const CommonPlaces& at);
Eigen::MatrixXd sample_cases(const CommonCases& cases, const CommonPlaces& at, const std::vector<int>& some);
/// One column for each of their derivatives.
Eigen::MatrixXd sample_derivatives(const CommonCases& cases, const CommonPlaces& at);

/// Largest norm of the points (x, y, z one after another) in a column.
double largest_point(const Eigen::Ref<const Eigen::VectorXd>& column);

/// The largest displacement at these places, mm.
double largest_displacement(const Field& field, const std::vector<Place>& places);

}  // namespace cleft
