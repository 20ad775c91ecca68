// A field of several pieces at the nodes of a mesh.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "encoder/field/blended_field.h"
#include "encoder/field/file/field_file.h"

namespace cleft {

/// The nodes of a mesh at which a piece may count, and their places in it (t is not used).
struct NodesOfPiece {
  std::vector<std::int32_t> nodes;
  std::vector<Place> places;
};

/// The first `counting` nodes of a snapshot's piece; nodes of pairs are on their sides of the break.
NodesOfPiece counting_nodes(const std::vector<std::int32_t>& nodes, std::size_t counting,
                            const std::vector<Vec3>& places,
                            const std::vector<std::array<std::int32_t, 2>>& pairs);

/// Places of a snapshot's nodes, likewise.
std::vector<Place> places_of(const std::vector<Vec3>& places,
                             const std::vector<std::array<std::int32_t, 2>>& pairs);

/// The pieces of a file as one field.
BlendedField read_blended(const std::string& path);

class PiecesAtNodes {
 public:
  /// `inside_cells`: of every node a point of the source's space inside its cells (places_inside_cells),
  /// which tells how much each piece counts there. `frames`: of the snapshot whose pieces the nodes are,
  /// which has the residuals; 0: of another mesh, without them. Throws InputError where residuals do not fit,
  /// or a node is in no piece.
  PiecesAtNodes(std::vector<FieldPiece> pieces, std::vector<NodesOfPiece> nodes,
                const std::vector<Vec3>& inside_cells, std::size_t frames);

  const BlendedField& field() const { return field_; }
  /// N, from frame 0, along the axes of the first piece.
  std::vector<Vec3> displacement(double t, std::size_t frame) const;
  /// Of quantities[index]: N times its components, likewise.
  std::vector<double> quantity(std::size_t index, double t, std::size_t frame) const;

 private:
  static BlendedField fields_of(std::vector<FieldPiece>& pieces);

  std::vector<FieldPiece> kept_;  // only their residuals
  BlendedField field_;
  std::vector<NodesOfPiece> nodes_;
  std::vector<std::vector<double>> weights_;  // of each piece, of its nodes
  std::size_t count_;
  bool residuals_;
};

}  // namespace cleft
