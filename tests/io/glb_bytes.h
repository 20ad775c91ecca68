// A .glb of bytes and JSON, for tests.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace cleft::testing {

inline void add_word(std::string& to, std::uint32_t word) {
  for (int i = 0; i < 4; ++i) to += static_cast<char>(word >> (8 * i) & 0xff);
}

inline std::string glb_of(std::string json, std::string binary) {
  while (json.size() % 4 != 0) json += ' ';
  while (binary.size() % 4 != 0) binary += '\0';
  std::string bytes = "glTF";
  add_word(bytes, 2);
  add_word(bytes, static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + binary.size()));
  add_word(bytes, static_cast<std::uint32_t>(json.size()));
  bytes += "JSON" + json;
  add_word(bytes, static_cast<std::uint32_t>(binary.size()));
  return bytes + std::string("BIN\0", 4) + binary;
}

/// The numbers of a file's buffer, with their views and accessors.
class GltfBuffer {
 public:
  /// The number of the new accessor.
  template <class Number>
  int add(const std::vector<Number>& numbers, int components, bool normalized = false) {
    constexpr int code = std::is_same_v<Number, float>           ? 5126
                         : std::is_same_v<Number, std::uint8_t>  ? 5121
                         : std::is_same_v<Number, std::uint16_t> ? 5123
                                                                 : 5125;
    const char* types[] = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
    add_view(std::string(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number)));
    accessors_ += std::string(count_ > 0 ? "," : "") + "{\"bufferView\":" + std::to_string(views_count_ - 1) +
                  ",\"componentType\":" + std::to_string(code) +
                  ",\"count\":" + std::to_string(numbers.size() / static_cast<std::size_t>(components)) +
                  ",\"type\":\"" + types[components] + "\"" + (normalized ? ",\"normalized\":true}" : "}");
    return count_++;
  }
  /// The number of the new buffer view.
  int add_view(const std::string& bytes) {
    while (bytes_.size() % 4 != 0) bytes_ += '\0';
    views_ += std::string(views_count_ > 0 ? "," : "") +
              "{\"buffer\":0,\"byteOffset\":" + std::to_string(bytes_.size()) +
              ",\"byteLength\":" + std::to_string(bytes.size()) + "}";
    bytes_ += bytes;
    return views_count_++;
  }
  const std::string& bytes() const { return bytes_; }
  /// The file's JSON with further entries, as "\"meshes\":[...]"; `uri`: of the buffer.
  std::string json(const std::string& entries, const std::string& uri = "") const {
    return "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":" + std::to_string(bytes_.size()) +
           (uri.empty() ? "" : ",\"uri\":\"" + uri + "\"") + "}],\"bufferViews\":[" + views_ +
           "],\"accessors\":[" + accessors_ + "]," + entries + "}";
  }
  std::string glb(const std::string& entries) const { return glb_of(json(entries), bytes_); }

 private:
  std::string bytes_, views_, accessors_;
  int count_ = 0, views_count_ = 0;
};

}  // namespace cleft::testing
