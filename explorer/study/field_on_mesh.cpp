#include "explorer/study/field_on_mesh.h"

#include <cmath>
#include <filesystem>
#include <optional>

#include "base/error.h"
#include "base/text.h"
#include "encoder/field/at_time.h"
#include "encoder/field/file/field_file.h"
#include "encoder/field/file/pieces_at_nodes.h"
#include "encoder/field/quantity_fields.h"

namespace cleft {

namespace {

constexpr const char* at_start = "displacement_at_start";  // what encode calls the displacement of frame 0

}  // namespace

struct FieldOnMesh::Values {
  explicit Values(const std::string& snapshot) : reader(snapshot) {}

  SnapshotReader reader;
  std::optional<Field> field;  // of one break, with the places of the nodes in it
  std::vector<Place> places;
  std::optional<PiecesAtNodes> pieces;
  std::optional<std::size_t> start;

  const Field& first() const { return pieces ? pieces->field().first() : *field; }

  std::vector<double> quantity(std::size_t index, double t) const {
    if (pieces) return pieces->quantity(index, t, 0);
    const QuantityFields fields(*field, index);
    std::vector<double> all(fields.components() * places.size());
    fields.at(at_time(places, t), all);
    return all;
  }
};

FieldOnMesh::~FieldOnMesh() = default;

FieldOnMesh::FieldOnMesh(const std::string& field, const std::string& snapshot) {
  auto values = std::make_unique<Values>(snapshot);
  const SnapshotReader& reader = values->reader;
  mesh_ = reader.snapshot();
  if (!mesh_.source) throw InputError(snapshot + ": is no imported snapshot");
  if (pieces_in(field) > 0) {
    std::vector<NodesOfPiece> nodes;
    for (const SnapshotPiece& piece : mesh_.pieces)
      nodes.push_back(
          counting_nodes(piece.nodes, static_cast<std::size_t>(piece.counting), piece.places, piece.pairs));
    values->pieces.emplace(
        read_pieces(field), std::move(nodes),
        places_inside_cells(mesh_.points_in_source(), mesh_.cell_offsets, mesh_.connectivity), 0);
  } else {
    values->field.emplace(read_field(field));
    values->places = places_of(reader.coordinates(), mesh_.pairs);
  }
  const Field& first = values->first();
  if (first.duration() != mesh_.times.back() || !first.source || first.source->file != mesh_.source->file)
    throw InputError(snapshot + ": is not the snapshot that " + field + " was made from");
  for (std::size_t q = 0; q < first.quantities.size(); ++q) {
    const Quantity& quantity = first.quantities[q];
    if (quantity.name == at_start) {
      values->start = q;
      continue;
    }
    quantities_.push_back({quantity.name, static_cast<std::size_t>(quantity.components), true});
    numbers_.push_back(q);
  }
  values_ = std::move(values);
}

double FieldOnMesh::duration() const { return values_->first().duration(); }

std::vector<Vec3> FieldOnMesh::displacement(double t) const {
  std::vector<Vec3> moved;
  if (values_->pieces) {
    moved = values_->pieces->displacement(t, 0);
  } else {
    const std::vector<Place> places = at_time(values_->places, t);
    moved.resize(places.size());
    values_->field->displacements(places, moved);
  }
  if (values_->start) {
    const std::vector<double> start = values_->quantity(*values_->start, t);
    for (std::size_t n = 0; n < moved.size(); ++n)
      moved[n] += Vec3{start[3 * n], start[3 * n + 1], start[3 * n + 2]};
  }
  return moved;
}

std::vector<double> FieldOnMesh::quantity(std::size_t index, double t) const {
  return values_->quantity(numbers_.at(index), t);
}

const Field* FieldOnMesh::field() const { return values_->pieces ? nullptr : &*values_->field; }
const std::vector<Place>& FieldOnMesh::places() const { return values_->places; }
std::vector<Vec3> FieldOnMesh::data(std::size_t frame) const { return values_->reader.displacement(frame); }

double magnitude_of(std::span<const double> components) {
  if (components.size() == 1) return components.front();
  double square = 0;
  for (std::size_t c = 0; c < components.size(); ++c)
    square += (components.size() == 6 && c >= 3 ? 2 : 1) * components[c] * components[c];
  return std::sqrt(square);
}

std::shared_ptr<const FieldOnMesh> field_on_own_mesh(const std::string& field) {
  namespace fs = std::filesystem;
  const std::string beside = fs::path(field).replace_extension(".h5").string();
  try {
    if (fs::exists(beside) && format_of(beside) == snapshot_format.name &&
        SnapshotReader(beside).snapshot().source)
      return std::make_shared<const FieldOnMesh>(field, beside);
  } catch (const InputError&) {  // another's, or damaged: the field is shown without it
  }
  return nullptr;
}

}  // namespace cleft
