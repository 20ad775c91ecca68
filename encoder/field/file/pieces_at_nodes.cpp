#include "encoder/field/file/pieces_at_nodes.h"

#include "base/error.h"
#include "encoder/field/at_time.h"
#include "encoder/field/quantity_fields.h"

namespace cleft {

std::vector<Place> places_of(const std::vector<Vec3>& places,
                             const std::vector<std::array<std::int32_t, 2>>& pairs) {
  std::vector<Place> list;
  list.reserve(places.size());
  for (const Vec3& at : places) list.push_back({at, side_of(at.y)});
  for (const auto& [left, right] : pairs) list[left].side = Side::left, list[right].side = Side::right;
  return list;
}

NodesOfPiece counting_nodes(const std::vector<std::int32_t>& nodes, std::size_t counting,
                            const std::vector<Vec3>& places,
                            const std::vector<std::array<std::int32_t, 2>>& pairs) {
  NodesOfPiece piece{nodes, places_of(places, pairs)};
  piece.nodes.resize(counting), piece.places.resize(counting);
  return piece;
}

BlendedField PiecesAtNodes::fields_of(std::vector<FieldPiece>& pieces) {
  std::vector<Field> fields;
  fields.reserve(pieces.size());
  for (FieldPiece& piece : pieces) fields.push_back(std::move(piece.field));
  return BlendedField(std::move(fields));
}

BlendedField read_blended(const std::string& path) {
  std::vector<Field> fields;
  for (FieldPiece& piece : read_pieces(path)) fields.push_back(std::move(piece.field));
  return told_of_file(path, [&] { return BlendedField(std::move(fields)); });
}

PiecesAtNodes::PiecesAtNodes(std::vector<FieldPiece> pieces, std::vector<NodesOfPiece> nodes,
                             const std::vector<Vec3>& inside_cells, std::size_t frames)
    : kept_(std::move(pieces)),
      field_(fields_of(kept_)),
      nodes_(std::move(nodes)),
      count_(inside_cells.size()),
      residuals_(frames > 0) {
  if (nodes_.size() != kept_.size())
    throw InputError("the snapshot has " + std::to_string(nodes_.size()) + " pieces, and the field " +
                     std::to_string(kept_.size()) + "; is it the snapshot that the field was made from?");
  std::vector<double> sum(count_), of_node(kept_.size());
  for (std::size_t p = 0; p < kept_.size(); ++p) {
    const auto fits = [&](const std::optional<NodeResidual>& residual) {
      return !residual || (static_cast<std::size_t>(residual->nodes) == nodes_[p].nodes.size() &&
                           static_cast<std::size_t>(residual->frames + residual->first_frame) == frames);
    };
    bool fit = fits(kept_[p].residual);
    for (const auto& residual : kept_[p].of_quantities) fit = fit && fits(residual);
    if (residuals_ && !fit)
      throw InputError("piece " + std::to_string(p) +
                       " of the field has a residual at other nodes and frames than the " +
                       std::to_string(nodes_[p].nodes.size()) + " and " + std::to_string(frames) +
                       " of the snapshot; is it the one that the field was made from?");
    auto& weights = weights_.emplace_back();
    for (const std::int32_t n : nodes_[p].nodes) {
      field_.weights(inside_cells[n], of_node);
      weights.push_back(of_node[p]), sum[n] += of_node[p];
    }
  }
  for (std::size_t n = 0; n < count_; ++n)
    if (!(sum[n] > 0)) throw InputError("node " + std::to_string(n) + " is in no piece of the field");
  for (std::size_t p = 0; p < kept_.size(); ++p)
    for (std::size_t i = 0; i < weights_[p].size(); ++i) weights_[p][i] /= sum[nodes_[p].nodes[i]];
}

std::vector<Vec3> PiecesAtNodes::displacement(double t, std::size_t frame) const {
  std::vector<Vec3> all(count_);
  for (std::size_t p = 0; p < nodes_.size(); ++p) {
    const NodesOfPiece& nodes = nodes_[p];
    const std::vector<Place> places = at_time(nodes.places, t);
    std::vector<Vec3> values(places.size());
    field_.pieces()[p].displacements(places, values);
    const NodeResidual* residual = residuals_ && kept_[p].residual ? &*kept_[p].residual : nullptr;
    for (std::size_t i = 0; i < values.size(); ++i) {
      Vec3 d = residual ? values[i] + residual->at(i, frame) : values[i];
      field_.turn_from(p, 3, {&d.x, 3});
      all[nodes.nodes[i]] += weights_[p][i] * d;
    }
  }
  return all;
}

std::vector<double> PiecesAtNodes::quantity(std::size_t index, double t, std::size_t frame) const {
  const auto components = static_cast<std::size_t>(field_.first().quantities[index].components);
  std::vector<double> all(count_ * components);
  for (std::size_t p = 0; p < nodes_.size(); ++p) {
    const NodesOfPiece& nodes = nodes_[p];
    const bool has = residuals_ && index < kept_[p].of_quantities.size() && kept_[p].of_quantities[index];
    std::vector<double> of_piece(nodes.nodes.size() * components);
    QuantityFields(field_.pieces()[p], index).at(at_time(nodes.places, t), of_piece);
    for (std::size_t i = 0; i < nodes.nodes.size(); ++i) {
      const std::span<double> values(&of_piece[i * components], components);
      for (std::size_t c = 0; has && c < components; ++c)
        values[c] += kept_[p].of_quantities[index]->at(i, static_cast<int>(c), frame);
      field_.turn_from(p, static_cast<int>(components), values);
      for (std::size_t c = 0; c < components; ++c)
        all[static_cast<std::size_t>(nodes.nodes[i]) * components + c] += weights_[p][i] * values[c];
    }
  }
  return all;
}

}  // namespace cleft
