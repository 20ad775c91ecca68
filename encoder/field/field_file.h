// The field file case.dffd (docs/formats.md): read and write.
#pragma once

#include <map>
#include <string>

#include "encoder/field/field.h"

namespace cleft {

inline constexpr int field_format_version = 1;

/// Writes the field whole or not at all. Coefficients are stored as 32-bit floats.
void write_field(const std::string& path, const Field& field);

/// Reads and checks a field file; throws FileError naming what is missing, damaged or out of range.
Field read_field(const std::string& path);

/// The case's parameters alone, by dotted name: coefficients stay on disk.
std::map<std::string, double> read_field_parameters(const std::string& path);

}  // namespace cleft
