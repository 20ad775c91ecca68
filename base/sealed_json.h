// JSON files that tell when a bit of them has changed.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace cleft {

/// The text of a JSON file whose last member, "seal", is a checksum of all before it.
std::string sealed_text(nlohmann::ordered_json object);

/// What a file of sealed_text() holds, without its seal. Throws FileError where the file is no JSON object,
/// or is not, byte for byte, what was written. An object without a version, or of version 1, need not be
/// sealed.
nlohmann::ordered_json read_sealed(const std::string& path);

}  // namespace cleft
