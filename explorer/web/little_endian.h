// Numbers of four bytes in the pieces of a page.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

namespace cleft {

inline void append(std::vector<std::uint8_t>& bytes, std::uint32_t bits) {
  for (int byte = 0; byte < 4; ++byte) bytes.push_back(static_cast<std::uint8_t>(bits >> (8 * byte)));
}

inline void append(std::vector<std::uint8_t>& bytes, float number) {
  append(bytes, std::bit_cast<std::uint32_t>(number));
}

}  // namespace cleft
