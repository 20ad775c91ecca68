// SHA-256, for identities of cases and checksums of files.
#pragma once

#include <string>
#include <string_view>

namespace cleft {

/// 64 lower-case hexadecimal digits.
std::string sha256(std::string_view bytes);

/// The same for the content of a file; throws FileError if it cannot be read.
std::string sha256_of_file(const std::string& path);

}  // namespace cleft
