#include "encoder/field/field_file.h"

#include <cmath>

#include "base/error.h"
#include "base/file_versions.h"
#include "base/h5.h"
#include "base/output_file.h"
#include "encoder/field/field_record.h"

namespace cleft {

namespace {

const FileFormat format{"cleft-field", field_version, "field file", "cleft encode"};

}  // namespace

void write_field(const std::string& path, const Field& field, const NodeResidual* residual,
                 std::span<const std::int32_t> residual_order) {
  const FieldRecord record = record_of(field);
  OutputFile out(path);
  h5::File file = h5::File::create(out.path(), h5::Growth::none);
  write_format(file, format);
  file.write_text("/", "units", "mm N MPa");
  const auto write = [&](const char* name, const std::vector<std::uint8_t>& bytes) {
    file.write<std::uint8_t>(name, bytes, {bytes.size()}, h5::Packing::deflate);
  };
  write("/header", header_bytes(record.header));
  write("/coefficients", record.coefficients);
  if (residual) {
    write("/residual", encode_residual(*residual, residual_order));
    file.write_number("/residual", "quantum", residual->quantum);
    file.write_number("/residual", "nodes", residual->nodes);
    file.write_number("/residual", "frames", residual->frames);
  }
  file.close();
  out.commit();
}

FieldRecord read_field_record(const std::string& path) {
  return told_of_file(path, [&] {
    const h5::File file = h5::File::open(path);
    require_format(file, format);
    return FieldRecord{header_from(file.read<std::uint8_t>("/header", {0})),
                       file.read<std::uint8_t>("/coefficients", {0})};
  });
}

Field read_field(const std::string& path) {
  return told_of_file(path, [&] { return field_of(read_field_record(path)); });
}

bool is_older_field(const std::string& path) {
  const h5::File file = h5::File::open(path);
  return file.has_attribute("/", "format") && file.read_text("/", "format") == format.name &&
         file.read_number("/", "version") < format.version;
}

std::map<std::string, double> read_field_parameters(const std::string& path) {
  return told_of_file(path, [&] {
    const h5::File file = h5::File::open(path);
    require_format(file, format);
    return parameters_of(header_from(file.read<std::uint8_t>("/header", {0})));
  });
}

std::optional<NodeResidual> read_residual(const std::string& path,
                                          std::span<const std::int32_t> residual_order) {
  return told_of_file(path, [&]() -> std::optional<NodeResidual> {
    const h5::File file = h5::File::open(path);
    require_format(file, format);
    if (!file.has("/residual")) return std::nullopt;
    const auto count = [&](const char* name) {
      const double value = file.read_number("/residual", name);
      if (!(value >= 0 && value < 1e9 && value == std::floor(value)))
        throw FileError(path, std::string("attribute ") + name + " of /residual is no count");
      return static_cast<int>(value);
    };
    NodeResidual residual{file.read_number("/residual", "quantum"), count("nodes"), count("frames"), {}};
    if (3. * residual.nodes * residual.frames > 4e9) throw FileError(path, "/residual is too large");
    if (!(residual.quantum > 0 && std::isfinite(residual.quantum)))
      throw FileError(path, "attribute quantum of /residual is not above 0");
    if (!residual_order.empty() && residual_order.size() != static_cast<std::size_t>(residual.nodes))
      throw FileError(path, "/residual is of " + std::to_string(residual.nodes) + " nodes, not " +
                                std::to_string(residual_order.size()));
    const auto bytes = file.read<std::uint8_t>("/residual", {0});
    if (3. * residual.nodes * residual.frames > most_values_of(bytes.size()))
      throw FileError(path, "/residual has fewer bytes than its nodes and frames take");
    residual.values = decode_residual(residual.nodes, residual.frames, bytes, residual_order);
    return residual;
  });
}

}  // namespace cleft
