// A field of imported data on the mesh that it was fitted to.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "solver/snapshot/snapshot.h"

namespace cleft {

/// The spline alone, of one break or of several, at the nodes of its snapshot, along the snapshot's axes.
class FieldOnMesh {
 public:
  /// Throws InputError where the snapshot is not that of the field, or is a simulation.
  FieldOnMesh(const std::string& field, const std::string& snapshot);
  ~FieldOnMesh();

  const Snapshot& mesh() const { return mesh_; }
  double duration() const;
  /// The further quantities, without the displacement of frame 0, which is part of the displacement.
  const std::vector<SnapshotArray>& quantities() const { return quantities_; }
  /// N: what the data have, from the points.
  std::vector<Vec3> displacement(double t) const;
  /// N times its components, of quantities()[index].
  std::vector<double> quantity(std::size_t index, double t) const;

 private:
  struct Values;

  Snapshot mesh_;
  std::unique_ptr<const Values> values_;
  std::vector<SnapshotArray> quantities_;
  std::vector<std::size_t> numbers_;  // of each of them, in the field
};

}  // namespace cleft
