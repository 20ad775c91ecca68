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
/// A header alone: of the field of another one, whose unknowns, on these bases and in that many slices of t,
/// field_of() is then to be given.
FieldRecord record_of_sum(const Json& header, const std::array<BSplineBasis, 4>& bases, int slices);

/// That of a field file, as it stands there; throws FileError.
FieldRecord read_field_record(const std::string& path);

/// Each throws InputError that says what of the record is missing, damaged or out of range.
Field field_of(const FieldRecord& record);
/// `unknowns`, mm, in the order of encode_coefficients(): in place of the record's own, which has none.
Field field_of(const FieldRecord& record, std::span<const double> unknowns);
/// Where the unknowns of the header's field stand, and their slices in t; `bytes` of coefficients hold them.
struct UnknownPlaces {
  CoefficientGrid grid;
  int slices;
};
UnknownPlaces unknown_places(const Json& header, std::size_t bytes);
/// The numbers of its "parameters", and the texts of its "choices" where it has any.
RecordedParameters parameters_of(const Json& header);
/// Records the members of an object that are text.
void record_texts(const Json& object, RecordedParameters& parameters);
FitReport report_of(const Json& header);

/// All figures of a report as commands show them, with their units in their names.
Json shown(const FitReport& report);

/// A header's bytes: text. Reading throws InputError where they are none.
std::vector<std::uint8_t> header_bytes(const Json& header);
Json header_from(std::span<const std::uint8_t> bytes);
/// A count in a header. Throws InputError where it is none, or one of 2^31 or more: other numbers have no
/// value as a count.
int count_from(const Json& value);
std::vector<int> counts_from(const Json& list);

/// Values that so many coded bytes can stand for at most: each costs a decision or more, of which the most
/// likely takes 4/65536 of itself, so a byte stands for fewer than 90,909. Asked before memory is taken.
inline double most_values_of(std::size_t bytes) { return 1e5 * (static_cast<double>(bytes) + 16); }

}  // namespace cleft
