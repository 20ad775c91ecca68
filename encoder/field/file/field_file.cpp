#include "encoder/field/file/field_file.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/file_versions.h"
#include "base/h5/h5.h"
#include "base/output_file.h"
#include "encoder/field/file/field_record.h"

namespace cleft {

namespace {

const FileFormat field_format{"cleft-field", field_version, "field file", "cleft encode"};
const FileFormat pieces_format{"cleft-field", field_version_of_pieces, "field file", "cleft encode"};

/// A file of one field, open.
h5::File open_field(const std::string& path) {
  h5::File file = h5::File::open(path);
  if (file.has_attribute("/", "pieces"))
    throw FileError(path,
                    "is the field of a body with several breaks, which cleft eval, decode, check and info "
                    "read, and cleft.open in Python; this command needs a field with one");
  require_format(file, field_format);
  return file;
}

Json read_header(const std::string& path) {
  return header_from(open_field(path).read<std::uint8_t>("/header", {0}));
}

/// Names within a piece's group.
std::string piece_folder(std::size_t piece) { return "/piece_" + std::to_string(piece); }

std::string residual_of_quantity(std::size_t index) {
  return "/residual_of_quantity_" + std::to_string(index);
}

void write_residual(h5::File& file, const std::string& name, const NodeResidual& residual,
                    std::span<const std::int32_t> order) {
  const std::vector<std::uint8_t> bytes = encode_residual(residual, order);
  file.write<std::uint8_t>(name, bytes, {bytes.size()}, h5::Packing::deflate);
  file.write_number(name, "quantum", residual.quantum);
  file.write_number(name, "nodes", residual.nodes);
  file.write_number(name, "frames", residual.frames);
}

std::optional<NodeResidual> residual_in(const h5::File& file, const std::string& name,
                                        const NodeResidual& kind, std::span<const std::int32_t> order) {
  if (!file.has(name)) return std::nullopt;
  const auto count = [&](const char* attribute) {
    const double value = file.read_number(name, attribute);
    if (!(value >= 0 && value < 1e9 && value == std::floor(value)))
      throw FileError(file.path(), std::string("attribute ") + attribute + " of " + name + " is no count");
    return static_cast<int>(value);
  };
  NodeResidual residual = kind;
  residual.quantum = file.read_number(name, "quantum");
  residual.nodes = count("nodes"), residual.frames = count("frames");
  const double values = static_cast<double>(residual.components) * residual.nodes * residual.frames;
  if (values > 4e9) throw FileError(file.path(), name + " is too large");
  if (!(residual.quantum > 0 && std::isfinite(residual.quantum)))
    throw FileError(file.path(), "attribute quantum of " + name + " is not above 0");
  if (!order.empty() && order.size() != static_cast<std::size_t>(residual.nodes))
    throw FileError(file.path(), name + " is of " + std::to_string(residual.nodes) + " nodes, not " +
                                     std::to_string(order.size()));
  const auto bytes = file.read<std::uint8_t>(name, {0});
  if (values > most_values_of(bytes.size()))
    throw FileError(file.path(), name + " has fewer bytes than its nodes and frames take");
  residual.values = decode_residual(residual.nodes, residual.frames, bytes, order, residual.components);
  return residual;
}

}  // namespace

namespace {

/// `group`: "" for a file of one field.
void write_into(h5::File& file, const std::string& group, const Field& field, const NodeResidual* residual,
                std::span<const std::int32_t> residual_order,
                std::span<const std::optional<NodeResidual>> of_quantities) {
  const FieldRecord record = record_of(field);
  const auto write = [&](const char* name, const std::vector<std::uint8_t>& bytes) {
    file.write<std::uint8_t>(group + name, bytes, {bytes.size()}, h5::Packing::deflate);
  };
  write("/header", header_bytes(record.header));
  write("/coefficients", record.coefficients);
  if (residual) write_residual(file, group + "/residual", *residual, residual_order);
  for (std::size_t q = 0; q < of_quantities.size(); ++q)
    if (of_quantities[q])
      write_residual(file, group + residual_of_quantity(q), *of_quantities[q], residual_order);
}

FieldRecord record_in(const h5::File& file, const std::string& group) {
  return {header_from(file.read<std::uint8_t>(group + "/header", {0})),
          file.read<std::uint8_t>(group + "/coefficients", {0})};
}

std::optional<NodeResidual> quantity_residual_in(const h5::File& file, const std::string& group,
                                                 const Json& header, std::size_t index,
                                                 std::span<const std::int32_t> order) {
  const std::string name = group + residual_of_quantity(index);
  if (!file.has(name)) return std::nullopt;
  const Json list = header.value("quantities", Json::array());
  if (index >= list.size() || !list[index].contains("components"))
    throw FileError(file.path(), name + " is of no quantity");
  NodeResidual kind;
  kind.components = std::clamp(count_from(list[index]["components"]), 1, 100), kind.first_frame = 0;
  return residual_in(file, name, kind, order);
}

}  // namespace

void write_field(const std::string& path, const Field& field, const NodeResidual* residual,
                 std::span<const std::int32_t> residual_order,
                 std::span<const std::optional<NodeResidual>> of_quantities) {
  OutputFile out(path);
  h5::File file = h5::File::create(out.path(), h5::Growth::none);
  write_format(file, field_format);
  file.write_text("/", "units", "mm N MPa");
  write_into(file, "", field, residual, residual_order, of_quantities);
  file.close();
  out.commit();
}

void write_pieces(const std::string& path, const std::vector<FieldPiece>& pieces, std::size_t nodes) {
  OutputFile out(path);
  h5::File file = h5::File::create(out.path(), h5::Growth::none);
  write_format(file, pieces_format);
  file.write_text("/", "units", "mm N MPa");
  file.write_number("/", "pieces", static_cast<double>(pieces.size()));
  file.write_number("/", "nodes", static_cast<double>(nodes));
  for (std::size_t p = 0; p < pieces.size(); ++p)
    write_into(file, piece_folder(p), pieces[p].field, pieces[p].residual ? &*pieces[p].residual : nullptr,
               {}, pieces[p].of_quantities);
  file.close();
  out.commit();
}

std::size_t pieces_in(const std::string& path) {
  return told_of_file(path, [&]() -> std::size_t {
    const h5::File file = h5::File::open(path);
    if (!file.has_attribute("/", "pieces")) return 0;
    require_format(file, pieces_format);
    const double count = file.read_number("/", "pieces");
    if (!(count >= 1 && count <= 1000 && count == std::floor(count)))
      throw FileError(path, "attribute pieces is no count from 1 to 1000");
    return static_cast<std::size_t>(count);
  });
}

std::size_t nodes_in(const std::string& path) {
  const double nodes = h5::File::open(path).read_number("/", "nodes");
  if (!(nodes >= 1 && nodes < 1e10)) throw FileError(path, "attribute nodes is no count");
  return static_cast<std::size_t>(nodes);
}

std::vector<FieldPiece> read_pieces(const std::string& path) {
  const std::size_t count = pieces_in(path);
  return told_of_file(path, [&] {
    const h5::File file = h5::File::open(path);
    std::vector<FieldPiece> pieces;
    for (std::size_t p = 0; p < count; ++p) {
      const std::string group = piece_folder(p);
      const FieldRecord record = record_in(file, group);
      FieldPiece piece{field_of(record)};
      piece.residual = residual_in(file, group + "/residual", {}, {});
      for (std::size_t q = 0; q < piece.field.quantities.size(); ++q)
        piece.of_quantities.push_back(quantity_residual_in(file, group, record.header, q, {}));
      pieces.push_back(std::move(piece));
    }
    return pieces;
  });
}

FieldRecord read_field_record(const std::string& path) {
  return told_of_file(path, [&] { return record_in(open_field(path), ""); });
}

Field read_field(const std::string& path) {
  return told_of_file(path, [&] { return field_of(read_field_record(path)); });
}

bool is_older_field(const std::string& path) {
  const h5::File file = h5::File::open(path);
  return file.has_attribute("/", "format") && file.read_text("/", "format") == field_format.name &&
         file.read_number("/", "version") < field_format.version;
}

RecordedParameters read_field_parameters(const std::string& path) {
  return told_of_file(path, [&] { return parameters_of(read_header(path)); });
}

FitReport read_field_report(const std::string& path) {
  return told_of_file(path, [&] { return report_of(read_header(path)); });
}

std::optional<NodeResidual> read_residual(const std::string& path,
                                          std::span<const std::int32_t> residual_order) {
  return told_of_file(path, [&] { return residual_in(open_field(path), "/residual", {}, residual_order); });
}

std::optional<NodeResidual> read_quantity_residual(const std::string& path, std::size_t index,
                                                   std::span<const std::int32_t> residual_order) {
  return told_of_file(path, [&]() -> std::optional<NodeResidual> {
    const h5::File file = open_field(path);
    if (!file.has(residual_of_quantity(index))) return std::nullopt;
    return quantity_residual_in(file, "", header_from(file.read<std::uint8_t>("/header", {0})), index,
                                residual_order);
  });
}

}  // namespace cleft
