// JSON files with a checksum.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace cleft {

/// The text of a JSON file whose last member, "seal", is a checksum of all before it.
std::string sealed_text(nlohmann::ordered_json object);

/// The content of a file made by sealed_text(), without its seal. Throws FileError if the file is not a JSON
/// object, or differs from what was written in any byte. An object without a version, or of version 1, need
/// not be sealed.
nlohmann::ordered_json read_sealed(const std::string& path);

}  // namespace cleft
