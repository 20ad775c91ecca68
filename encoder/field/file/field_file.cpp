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

const FileFormat field_format{"cleft-field",
                              field_version,
                              "field file",
                              "cleft encode",
                              {field_version_of_blocks, field_version_of_own_knots}};
const FileFormat pieces_format{"cleft-field",
                               field_version_of_pieces,
                               "field file",
                               "cleft encode",
                               {field_version_of_blocks, field_version_of_own_knots}};

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

constexpr const char* sizes_of_blocks = "_block_sizes";  // after the residual's name
constexpr double most_values = 1e11;                     // of a residual that is read

int count_in(const h5::File& file, const std::string& name, const char* attribute) {
  const double value = file.read_number(name, attribute);
  if (!(value >= 0 && value < 1e9 && value == std::floor(value)))
    throw FileError(file.path(), std::string("attribute ") + attribute + " of " + name + " is no count");
  return static_cast<int>(value);
}

void write_residual(h5::File& file, const std::string& name, const CodedResidual& residual) {
  std::vector<std::uint8_t> bytes;
  std::vector<std::int64_t> sizes;
  bytes.reserve(residual.bytes());
  for (const auto& block : residual.blocks)
    bytes.insert(bytes.end(), block.begin(), block.end()),
        sizes.push_back(static_cast<std::int64_t>(block.size()));
  file.write<std::uint8_t>(name, bytes, {bytes.size()});
  file.write_number(name, "quantum", residual.quantum);
  file.write_number(name, "nodes", residual.nodes);
  file.write_number(name, "frames", residual.frames);
  if (sizes.size() == 1) return;
  file.write_number(name, "block", residual.block);
  file.write<std::int64_t>(name + sizes_of_blocks, sizes, {sizes.size()});
}

/// The blocks of coded bytes.
void divide(CodedResidual& residual, const h5::File& file, const std::string& name,
            std::vector<std::uint8_t> bytes) {
  const auto damaged = [&] {
    return FileError(file.path(), name + sizes_of_blocks + " does not divide the bytes of " + name);
  };
  if (!file.has_attribute(name, "block")) {
    residual.block = std::max(residual.nodes, 1);
    residual.blocks.push_back(std::move(bytes));
    return;
  }
  residual.block = count_in(file, name, "block");
  const auto sizes = file.read<std::int64_t>(name + sizes_of_blocks, {0});
  const int count = residual.block < 1 ? 0 : (residual.nodes - 1) / residual.block + 1;
  if (residual.nodes < 1 || sizes.size() != static_cast<std::size_t>(count)) throw damaged();
  auto at = bytes.begin();
  for (const std::int64_t size : sizes) {
    if (size < 0 || size > bytes.end() - at) throw damaged();
    residual.blocks.emplace_back(at, at + size);
    at += size;
  }
  if (at != bytes.end()) throw damaged();
}

std::optional<CodedResidual> residual_in(const h5::File& file, const std::string& name, int components = 3,
                                         int first_frame = 1) {
  if (!file.has(name)) return std::nullopt;
  CodedResidual residual;
  residual.components = components, residual.first_frame = first_frame;
  residual.quantum = file.read_number(name, "quantum");
  residual.nodes = count_in(file, name, "nodes"), residual.frames = count_in(file, name, "frames");
  const double values = static_cast<double>(residual.components) * residual.nodes * residual.frames;
  if (values > most_values) throw FileError(file.path(), name + " is too large");
  if (!(residual.quantum > 0 && std::isfinite(residual.quantum)))
    throw FileError(file.path(), "attribute quantum of " + name + " is not above 0");
  auto bytes = file.read<std::uint8_t>(name, {0});
  if (values > most_values_of(bytes.size()))
    throw FileError(file.path(), name + " has fewer bytes than its nodes and frames take");
  divide(residual, file, name, std::move(bytes));
  return residual;
}

}  // namespace

namespace {

using Residuals = std::span<const std::optional<CodedResidual>>;

bool in_blocks(const std::optional<CodedResidual>& residual) {
  return residual && residual->blocks.size() > 1;
}

bool any_in_blocks(const CodedResidual* residual, Residuals of_quantities) {
  return (residual && residual->blocks.size() > 1) ||
         std::any_of(of_quantities.begin(), of_quantities.end(), in_blocks);
}

bool has_own_knots(const Field& field) {
  return std::any_of(field.quantities.begin(), field.quantities.end(),
                     [](const Quantity& quantity) { return quantity.own != nullptr; });
}

h5::File created(const std::string& path, FileFormat format, bool blocks, bool own_knots) {
  h5::File file = h5::File::create(path, h5::Growth::none);
  if (own_knots)
    format.version = field_version_of_own_knots;
  else if (blocks)
    format.version = field_version_of_blocks;
  write_format(file, format);
  file.write_text("/", "units", "mm N MPa");
  return file;
}

/// `group`: "" for a file of one field.
void write_into(h5::File& file, const std::string& group, const Field& field, const CodedResidual* residual,
                Residuals of_quantities) {
  const FieldRecord record = record_of(field);
  const auto write = [&](const char* name, const std::vector<std::uint8_t>& bytes, h5::Packing packing) {
    file.write<std::uint8_t>(group + name, bytes, {bytes.size()}, packing);
  };
  const bool coded = field.quantum > 0;  // so that deflate would add some bytes
  write("/header", header_bytes(record.header), h5::Packing::deflate);
  write("/coefficients", record.coefficients, coded ? h5::Packing::plain : h5::Packing::deflate);
  if (residual) write_residual(file, group + "/residual", *residual);
  for (std::size_t q = 0; q < of_quantities.size(); ++q)
    if (of_quantities[q]) write_residual(file, group + residual_of_quantity(q), *of_quantities[q]);
}

FieldRecord record_in(const h5::File& file, const std::string& group) {
  return {header_from(file.read<std::uint8_t>(group + "/header", {0})),
          file.read<std::uint8_t>(group + "/coefficients", {0})};
}

std::optional<CodedResidual> quantity_residual_in(const h5::File& file, const std::string& group,
                                                  const Json& header, std::size_t index) {
  const std::string name = group + residual_of_quantity(index);
  if (!file.has(name)) return std::nullopt;
  const Json list = header.value("quantities", Json::array());
  if (index >= list.size() || !list[index].contains("components"))
    throw FileError(file.path(), name + " is of no quantity");
  return residual_in(file, name, std::clamp(count_from(list[index]["components"]), 1, 100), 0);
}

Encoded encoded_in(const h5::File& file, const std::string& group) {
  const FieldRecord record = record_in(file, group);
  Encoded result{field_of(record)};
  result.residual = residual_in(file, group + "/residual");
  for (std::size_t q = 0; q < result.field.quantities.size(); ++q)
    result.of_quantities.push_back(quantity_residual_in(file, group, record.header, q));
  return result;
}

std::optional<NodeResidual> decoded_if_any(const std::optional<CodedResidual>& residual) {
  if (!residual) return std::nullopt;
  return decoded(*residual);
}

}  // namespace

void write_field(const std::string& path, const Field& field, const CodedResidual* residual,
                 Residuals of_quantities) {
  OutputFile out(path);
  h5::File file =
      created(out.path(), field_format, any_in_blocks(residual, of_quantities), has_own_knots(field));
  write_into(file, "", field, residual, of_quantities);
  file.close();
  out.commit();
}

void write_field(const std::string& path, const Encoded& encoded) {
  write_field(path, encoded.field, encoded.residual ? &*encoded.residual : nullptr, encoded.of_quantities);
}

void write_pieces(const std::string& path, const std::vector<Encoded>& pieces, std::size_t nodes) {
  OutputFile out(path);
  const bool blocks = std::any_of(pieces.begin(), pieces.end(), [](const Encoded& piece) {
    return any_in_blocks(piece.residual ? &*piece.residual : nullptr, piece.of_quantities);
  });
  const bool own_knots = std::any_of(pieces.begin(), pieces.end(),
                                     [](const Encoded& piece) { return has_own_knots(piece.field); });
  h5::File file = created(out.path(), pieces_format, blocks, own_knots);
  file.write_number("/", "pieces", static_cast<double>(pieces.size()));
  file.write_number("/", "nodes", static_cast<double>(nodes));
  for (std::size_t p = 0; p < pieces.size(); ++p)
    write_into(file, piece_folder(p), pieces[p].field, pieces[p].residual ? &*pieces[p].residual : nullptr,
               pieces[p].of_quantities);
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

std::vector<Encoded> read_encoded(const std::string& path) {
  const std::size_t pieces = pieces_in(path);
  return told_of_file(path, [&] {
    const h5::File file = pieces > 0 ? h5::File::open(path) : open_field(path);
    std::vector<Encoded> all;
    for (std::size_t p = 0; p < std::max<std::size_t>(pieces, 1); ++p)
      all.push_back(encoded_in(file, pieces > 0 ? piece_folder(p) : ""));
    return all;
  });
}

std::vector<FieldPiece> read_pieces(const std::string& path) {
  return told_of_file(path, [&] {
    std::vector<FieldPiece> pieces;
    for (Encoded& one : read_encoded(path)) {
      FieldPiece& piece = pieces.emplace_back(FieldPiece{std::move(one.field)});
      piece.residual = decoded_if_any(one.residual);
      for (const auto& residual : one.of_quantities) piece.of_quantities.push_back(decoded_if_any(residual));
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

std::optional<NodeResidual> read_residual(const std::string& path) {
  return told_of_file(path, [&] { return decoded_if_any(residual_in(open_field(path), "/residual")); });
}

std::optional<NodeResidual> read_quantity_residual(const std::string& path, std::size_t index) {
  return told_of_file(path, [&]() -> std::optional<NodeResidual> {
    const h5::File file = open_field(path);
    if (!file.has(residual_of_quantity(index))) return std::nullopt;
    return decoded_if_any(
        quantity_residual_in(file, "", header_from(file.read<std::uint8_t>("/header", {0})), index));
  });
}

}  // namespace cleft
