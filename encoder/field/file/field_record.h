// A field as a header and bytes, which case.dffd and study.dffd share.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

#include "encoder/field/coefficient_code.h"
#include "encoder/field/field.h"

namespace cleft {

using Json = nlohmann::ordered_json;

/// docs/formats.md: all data except the coefficients by name, and the coefficients' bytes.
struct FieldRecord {
  Json header;
  std::vector<std::uint8_t> coefficients;
};

FieldRecord record_of(const Field& field);
/// What headers and reports tell of a quantity.
Json figures_of(const Quantity& quantity);
/// The knots that a quantity has of its own; and a field on them, of an entry of the header, that codes no
/// more control points than so many bytes hold.
Json knots_of(const Field& own);
std::shared_ptr<const Field> own_knots(const Json& header, const Json& entry, std::size_t bytes);
/// A header without bytes, from that of another field; its unknowns, on these bases and in this number of
/// slices of t, must be passed to field_of().
FieldRecord record_of_sum(const Json& header, const std::array<BSplineBasis, 4>& bases, int slices);

/// The record of a field file, unchanged; throws FileError.
FieldRecord read_field_record(const std::string& path);

/// Each throws InputError that names what is missing, damaged or out of range in the record.
Field field_of(const FieldRecord& record);
/// `unknowns`, mm, in the order of encode_coefficients(), for a record without its own.
Field field_of(const FieldRecord& record, std::span<const double> unknowns);
/// The places of the unknowns of the header's field, and their slices in t; `bytes` of coefficients hold
/// them.
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

/// With figures of as many digits as they mean, which take fewer bytes.
FitReport rounded_report(FitReport report);

/// All figures of a report for commands, with units in their names.
Json shown(const FitReport& report);

/// A header's bytes: text. Reading throws InputError if they are invalid.
std::vector<std::uint8_t> header_bytes(const Json& header);
Json header_from(std::span<const std::uint8_t> bytes);
/// A count in a header. Throws InputError if it is not an integer from 0 to 2^31 - 1.
int count_from(const Json& value);
std::vector<int> counts_from(const Json& list);

/// The largest number of values that the given coded bytes can hold: each needs at least one decision, of
/// which the most likely takes 4/65536 of itself, so a byte holds fewer than 90,909. Checked before memory is
/// allocated.
inline double most_values_of(std::size_t bytes) { return 1e5 * (static_cast<double>(bytes) + 16); }

}  // namespace cleft
