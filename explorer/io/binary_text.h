// Numbers in binary files: little-endian. Private to this folder.
#pragma once

#include <algorithm>
#include <bit>
#include <cstring>
#include <string>

namespace cleft {

template <class T>
void append_little(std::string& bytes, T value) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  if constexpr (std::endian::native == std::endian::big) std::reverse(raw, raw + sizeof value);
  bytes.append(raw, sizeof value);
}

template <class T>
T little(const char* from) {
  char raw[sizeof(T)];
  std::memcpy(raw, from, sizeof raw);
  if constexpr (std::endian::native == std::endian::big) std::reverse(raw, raw + sizeof raw);
  T value;
  std::memcpy(&value, raw, sizeof value);
  return value;
}

}  // namespace cleft
