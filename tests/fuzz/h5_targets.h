// HDF5 files whose structure is edited: a checksum would refuse random bytes before any reader of ours sees
// them.
#pragma once

#include <cstddef>
#include <cstdint>

namespace cleft::fuzz {

/// The bytes are edits of a sound snapshot (datasets and attributes removed, of other types and extents, with
/// other values), which is then read.
void read_edited_snapshot(const std::uint8_t* data, std::size_t size);

/// The same of a field, with edits of its JSON header and its coded bytes too.
void read_edited_field(const std::uint8_t* data, std::size_t size);

/// The same of a study of three cases, two of them sums of modes.
void read_edited_study(const std::uint8_t* data, std::size_t size);

}  // namespace cleft::fuzz
