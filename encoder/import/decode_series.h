// From a field back to the series of another program.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "encoder/field/field.h"
#include "encoder/field/node_residual.h"
#include "encoder/import/source_mesh.h"

namespace cleft {

/// A mesh on which a field is decoded: where its nodes are in the field, and in the source's space.
struct DecodeMesh {
  SourceMesh mesh;           ///< in the source's space
  std::vector<Place> nodes;  ///< in the field; t is not used
};

/// Any mesh in the source's space: nodes at the break belong to the side on which their cells are. Throws
/// InputError if a node is outside of the field's domain.
DecodeMesh mesh_in_source(SourceMesh mesh, const Field& field);

/// A field as kept: the spline, and what a file keeps beside it at the nodes of its own snapshot.
struct KeptField {
  const Field* field = nullptr;
  std::optional<NodeResidual> residual;  ///< of the displacement; only for the snapshot's nodes
  std::vector<std::optional<NodeResidual>> of_quantities;  ///< likewise
};

/// Writes OUT.pvd and OUT/frame_0000.vtu, ...: the displacement with what it was in frame 0, and all
/// quantities, in the source's axes, names and times. Throws InputError if one of them exists.
void write_decoded(const KeptField& kept, const DecodeMesh& mesh, const std::string& out,
                   const std::function<void(const std::string&)>& progress);

}  // namespace cleft
