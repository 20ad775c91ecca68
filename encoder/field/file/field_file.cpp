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

Json read_header(const std::string& path) {
  const h5::File file = h5::File::open(path);
  require_format(file, field_format);
  return header_from(file.read<std::uint8_t>("/header", {0}));
}

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

void write_field(const std::string& path, const Field& field, const NodeResidual* residual,
                 std::span<const std::int32_t> residual_order,
                 std::span<const std::optional<NodeResidual>> of_quantities) {
  const FieldRecord record = record_of(field);
  OutputFile out(path);
  h5::File file = h5::File::create(out.path(), h5::Growth::none);
  write_format(file, field_format);
  file.write_text("/", "units", "mm N MPa");
  const auto write = [&](const char* name, const std::vector<std::uint8_t>& bytes) {
    file.write<std::uint8_t>(name, bytes, {bytes.size()}, h5::Packing::deflate);
  };
  write("/header", header_bytes(record.header));
  write("/coefficients", record.coefficients);
  if (residual) write_residual(file, "/residual", *residual, residual_order);
  for (std::size_t q = 0; q < of_quantities.size(); ++q)
    if (of_quantities[q]) write_residual(file, residual_of_quantity(q), *of_quantities[q], residual_order);
  file.close();
  out.commit();
}

FieldRecord read_field_record(const std::string& path) {
  return told_of_file(path, [&] {
    const h5::File file = h5::File::open(path);
    require_format(file, field_format);
    return FieldRecord{header_from(file.read<std::uint8_t>("/header", {0})),
                       file.read<std::uint8_t>("/coefficients", {0})};
  });
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
  return told_of_file(path, [&]() -> std::optional<NodeResidual> {
    const h5::File file = h5::File::open(path);
    require_format(file, field_format);
    return residual_in(file, "/residual", {}, residual_order);
  });
}

std::optional<NodeResidual> read_quantity_residual(const std::string& path, std::size_t index,
                                                   std::span<const std::int32_t> residual_order) {
  return told_of_file(path, [&]() -> std::optional<NodeResidual> {
    const h5::File file = h5::File::open(path);
    require_format(file, field_format);
    const std::string name = residual_of_quantity(index);
    if (!file.has(name)) return std::nullopt;
    const Json list = header_from(file.read<std::uint8_t>("/header", {0})).value("quantities", Json::array());
    if (index >= list.size() || !list[index].contains("components"))
      throw FileError(path, name + " is of no quantity");
    NodeResidual kind;
    kind.components = std::clamp(count_from(list[index]["components"]), 1, 100), kind.first_frame = 0;
    return residual_in(file, name, kind, residual_order);
  });
}

}  // namespace cleft
