// From a field back to the series of another program.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "encoder/field/field.h"
#include "encoder/field/file/pieces_at_nodes.h"
#include "encoder/field/node_residual.h"
#include "encoder/import/source_mesh.h"

namespace cleft {

/// The place of every node of a mesh, in the source's space, in a field: nodes at the break belong to the
/// side on which their cells are. Nodes outside of the field's domain are put on its border. Throws
/// InputError if one is so by more than a small part of its cells; where `asked` is given, if one of those
/// is.
std::vector<Place> nodes_in_field(const SourceMesh& mesh, const Field& field,
                                  const std::vector<char>* asked = nullptr);
/// The same in a field of several pieces.
std::vector<NodesOfPiece> nodes_in_pieces(const SourceMesh& mesh, const BlendedField& field);

/// What is decoded at the nodes of a mesh. Vectors and tensors are along the axes of the first field.
struct DecodedNodes {
  const Field* first = nullptr;  ///< the field, or the first of its pieces
  std::function<std::vector<Vec3>(double t, std::size_t frame)> displacement;
  std::function<std::vector<double>(std::size_t quantity, double t, std::size_t frame)> quantity;
  std::vector<std::size_t> loose = {};  ///< nodes that get no numbers
};
/// Nodes that no cell has, which may be anywhere; none where there are no cells.
std::vector<std::size_t> loose_nodes(const SourceMesh& mesh);

/// A field as kept: the spline, and what a file keeps beside it at the nodes of its own snapshot.
struct KeptField {
  const Field* field = nullptr;
  std::optional<NodeResidual> residual;  ///< of the displacement; only for the snapshot's nodes
  std::vector<std::optional<NodeResidual>> of_quantities;  ///< likewise
};
/// Refers to both.
DecodedNodes decoded_at(const KeptField& kept, const std::vector<Place>& nodes);
DecodedNodes decoded_at(const PiecesAtNodes& pieces);

/// A field at the nodes: its name in the source, numbers node by node, and its unit, "" where it is not told.
struct DecodedValues {
  std::string name;
  int components;
  std::vector<double> numbers;
  std::string unit = {};
};

/// Times of the frames, in the source.
std::vector<double> times_of(const Field& field);
/// All fields in a frame, in the source's axes: the displacement with what it was in frame 0, and all
/// quantities. Loose nodes have NaN.
std::vector<DecodedValues> values_at(const DecodedNodes& decoded, std::size_t frame);

/// Throws InputError if there is such a file or folder.
void refuse_existing(const std::string& path);

/// Writes the series as one .vtkhdf: the mesh once, and every frame's values beside each other. Throws
/// InputError if the file exists.
void write_vtkhdf(const DecodedNodes& decoded, const SourceMesh& mesh, const std::string& out,
                  const std::function<void(const std::string&)>& progress);

}  // namespace cleft
