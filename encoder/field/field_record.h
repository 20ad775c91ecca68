// A field as its file holds it: a header and bytes. What case.dffd and study.dffd share.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

#include "encoder/field/field.h"

namespace cleft {

using Json = nlohmann::ordered_json;

/// docs/formats.md: everything but the coefficients by name, and the coefficients' bytes.
struct FieldRecord {
  Json header;
  std::vector<std::uint8_t> coefficients;
};

FieldRecord record_of(const Field& field);

/// That of a field file, as it stands there; throws FileError.
FieldRecord read_field_record(const std::string& path);

/// Each throws InputError that says what of the record is missing, damaged or out of range.
Field field_of(const FieldRecord& record);
std::map<std::string, double> parameters_of(const Json& header);
FitReport report_of(const Json& header);

/// All figures of a report as commands show them, with their units in their names.
Json shown(const FitReport& report);

/// A header's bytes: text. Reading throws InputError where they are none.
std::vector<std::uint8_t> header_bytes(const Json& header);
Json header_from(std::span<const std::uint8_t> bytes);

}  // namespace cleft
