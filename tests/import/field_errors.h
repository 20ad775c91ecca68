// What a body with a crack loses by import and encoding: errors of its field against the closed form.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "encoder/field/place.h"
#include "solver/snapshot/snapshot.h"
#include "tests/import/cracked_bodies.h"

namespace cleft {

/// Largest errors over nodes and frames, over the largest displacement.
struct Errors {
  double nodes = 0;    ///< of the file: the spline and the residual
  double spline = 0;   ///< of the spline alone
  double opening = 0;  ///< of the spline's jump at doubled nodes
  double bytes = 0;
  std::string said;  ///< by the commands
};

/// The place of each node in the field, and the directions of its displacement in the source's space.
struct FieldPlaces {
  std::vector<Vec3> uvw;
  std::vector<Side> sides;
  std::vector<std::array<Vec3, 3>> frames;

  explicit FieldPlaces(const SnapshotReader& reader);
};

/// Imports and encodes the body's series at this tolerance with no other options.
Errors measured(const CrackedBody& body, double tolerance = 0.01);

/// Prints a row of the table (cracked_bodies.md); expects the tolerance of 1 % at the nodes, and twice that
/// of the spline and of its opening.
void expect_exact(const CrackedBody& body);

}  // namespace cleft
