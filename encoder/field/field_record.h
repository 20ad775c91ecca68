// A field as its file holds it: a header and bytes. What case.dffd and study.dffd share.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

#include "encoder/field/coefficient_code.h"
#include "encoder/field/field.h"

namespace cleft {

using Json = nlohmann::ordered_json;

/// docs/formats.md: everything but the coefficients by name, and the coefficients' bytes.
struct FieldRecord {
  Json header;
  std::vector<std::uint8_t> coefficients;
};

FieldRecord record_of(const Field& field);
/// The header alone, of a field whose unknowns field_of() is then to be given, in that many slices of t.
FieldRecord record_of_sum(const Field& field, int slices);

/// That of a field file, as it stands there; throws FileError.
FieldRecord read_field_record(const std::string& path);

/// Each throws InputError that says what of the record is missing, damaged or out of range.
Field field_of(const FieldRecord& record);
/// `unknowns`, mm, in the order of encode_coefficients(): in place of the record's own, which has none.
Field field_of(const FieldRecord& record, std::span<const double> unknowns);
/// Where the unknowns of the record's field stand, and their slices in t.
struct UnknownPlaces {
  CoefficientGrid grid;
  int slices;
};
UnknownPlaces unknown_places(const Json& header);
std::map<std::string, double> parameters_of(const Json& header);
FitReport report_of(const Json& header);

/// A header's bytes: text. Reading throws InputError where they are none.
std::vector<std::uint8_t> header_bytes(const Json& header);
Json header_from(std::span<const std::uint8_t> bytes);

}  // namespace cleft
