// A field of imported data on the mesh that it was fitted to.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "encoder/field/field.h"
#include "solver/snapshot/snapshot.h"

namespace cleft {

/// Of one value or of several: the value, the length of a vector, or the norm of a symmetric tensor
/// XX YY ZZ XY YZ XZ, which does not depend on the axes.
double magnitude_of(std::span<const double> components);

/// The spline alone, of one break or of several, at the nodes of its snapshot, along the snapshot's axes.
class FieldOnMesh {
 public:
  /// Throws InputError where the snapshot is not that of the field, or is a simulation.
  FieldOnMesh(const std::string& field, const std::string& snapshot);
  ~FieldOnMesh();

  const Snapshot& mesh() const { return mesh_; }
  double duration() const;
  /// The field, where it is of one break; its places of the nodes.
  const Field* field() const;
  const std::vector<Place>& places() const;
  /// The further quantities, without the displacement of frame 0, which is part of the displacement.
  const std::vector<SnapshotArray>& quantities() const { return quantities_; }
  /// N: what the data have, from the points.
  std::vector<Vec3> displacement(double t) const;
  /// N times its components, of quantities()[index].
  std::vector<double> quantity(std::size_t index, double t) const;
  /// N: of a frame of the snapshot, from the points.
  std::vector<Vec3> data(std::size_t frame) const;

 private:
  struct Values;

  Snapshot mesh_;
  std::unique_ptr<const Values> values_;
  std::vector<SnapshotArray> quantities_;
  std::vector<std::size_t> numbers_;  // of each of them, in the field
};

/// Of a field and the snapshot beside it that has its name, with the ending .h5; null where there is none.
std::shared_ptr<const FieldOnMesh> field_on_own_mesh(const std::string& field);

}  // namespace cleft
