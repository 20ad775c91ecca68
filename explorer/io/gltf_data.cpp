#include "explorer/io/gltf_data.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <utility>

#include "base/error.h"
#include "base/text.h"
#include "explorer/io/binary_text.h"

namespace cleft {

using Json = nlohmann::json;

namespace {

constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

/// Binary data of the format are little-endian.
std::uint32_t word_at(std::string_view bytes, std::size_t at) {
  return little<std::uint32_t>(bytes.data() + at);
}

/// Empty where a character is none of base64.
std::string from_base64(std::string_view text) {
  std::string bytes;
  unsigned bits = 0;
  int held = 0;
  for (const char c : text) {
    if (c == '=') break;
    const int value = c >= 'A' && c <= 'Z'   ? c - 'A'
                      : c >= 'a' && c <= 'z' ? c - 'a' + 26
                      : c >= '0' && c <= '9' ? c - '0' + 52
                      : c == '+'             ? 62
                      : c == '/'             ? 63
                                             : -1;
    if (value < 0) return "";
    bits = bits << 6 | static_cast<unsigned>(value), held += 6;
    if (held < 8) continue;
    held -= 8;
    bytes += static_cast<char>(bits >> held & 0xff);
  }
  return bytes;
}

/// "%20" as a blank.
std::string without_percents(const std::string& uri) {
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const bool code = uri[i] == '%' && i + 2 < uri.size() &&
                      std::isxdigit(static_cast<unsigned char>(uri[i + 1])) != 0 &&
                      std::isxdigit(static_cast<unsigned char>(uri[i + 2])) != 0;
    text += code ? static_cast<char>(std::stoi(uri.substr(i + 1, 2), nullptr, 16)) : uri[i];
    if (code) i += 2;
  }
  return text;
}

struct ComponentType {
  std::size_t code, bytes;
  bool has_sign;
  double whole;  // the number that is 1 where it is normalized; 0: a real number
};
constexpr ComponentType component_types[] = {{5120, 1, true, 127},          {5121, 1, false, 255},
                                             {5122, 2, true, 32767},        {5123, 2, false, 65535},
                                             {5125, 4, false, 4294967295.}, {5126, 4, true, 0}};

double number_at(const char* at, const ComponentType& type, bool normalized) {
  std::uint32_t bits = 0;
  for (std::size_t i = type.bytes; i-- > 0;) bits = bits << 8 | static_cast<unsigned char>(at[i]);
  if (type.whole == 0) {
    float real;
    std::memcpy(&real, &bits, sizeof real);
    return double{real};
  }
  double value = bits;
  if (type.has_sign && (bits >> (8 * type.bytes - 1) & 1U) != 0)
    value -= std::ldexp(1., 8 * static_cast<int>(type.bytes));
  return normalized ? std::max(value / type.whole, -1.) : value;
}

std::size_t components_of(const std::string& type) {
  const std::pair<const char*, std::size_t> types[] = {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}};
  for (const auto& [name, count] : types)
    if (type == name) return count;
  return 0;
}

}  // namespace

GltfData::GltfData(const std::string& path) : path_(path) {
  const std::string bytes = read_text_file(path);
  try {
    open_container(bytes);
  } catch (const Json::exception& e) {
    refuse(std::string("its JSON is damaged: ") + e.what());
  }
}

void GltfData::refuse(const std::string& what) const { throw FileError(path_, what); }

void GltfData::open_container(const std::string& bytes) {
  std::string binary;
  if (bytes.starts_with("glTF")) {
    if (bytes.size() < 20 || word_at(bytes, 4) != 2) refuse("is no binary glTF of version 2");
    if (word_at(bytes, 8) > bytes.size())
      refuse("is no whole binary glTF: " + std::to_string(bytes.size()) +
             " bytes, where its header promises " + std::to_string(word_at(bytes, 8)));
    constexpr std::uint32_t text = 0x4E4F534A, data = 0x004E4942;  // "JSON", "BIN"
    for (std::size_t at = 12; at + 8 <= bytes.size();) {
      const std::size_t length = word_at(bytes, at), kind = word_at(bytes, at + 4);
      if (length > bytes.size() - at - 8) refuse("has a chunk that is longer than the file");
      if (at == 12 && kind != text) refuse("does not begin with a chunk of JSON");
      if (at == 12) json_ = Json::parse(bytes.substr(at + 8, length));
      if (kind == data && binary.empty()) binary = bytes.substr(at + 8, length);
      at += 8 + length;
    }
  } else {
    json_ = Json::parse(bytes);
  }
  if (!json_.is_object() || !json_.contains("asset")) refuse("is no glTF: it has no entry 'asset'");
  if (const std::string version = json_.at("asset").value("version", ""); !version.starts_with("2."))
    refuse("is glTF of version '" + version.substr(0, 20) + "'; 2.0 is read");
  check_extensions();
  open_buffers(std::move(binary));
}

void GltfData::check_extensions() const {
  if (!json_.contains("extensionsRequired")) return;
  for (const Json& name : json_.at("extensionsRequired")) {
    const auto text = name.get<std::string>();
    if (text.starts_with("KHR_materials_") || text == "KHR_mesh_quantization") continue;
    refuse("needs the extension " + text.substr(0, 60) +
           ", which is not read: export it without (compression)");
  }
}

void GltfData::open_buffers(std::string binary) {
  for (std::size_t i = 0; i < count("buffers"); ++i) {
    const std::string where = "buffer " + std::to_string(i);
    const Json& one = entry("buffers", i);
    const std::size_t length = natural(one, "byteLength", where);
    if (one.contains("uri"))
      buffers_.push_back(resource(one.at("uri").get<std::string>(), where));
    else
      buffers_.push_back(i == 0 ? std::exchange(binary, {}) : "");
    if (buffers_.back().size() < length)
      refuse("its " + where + " has " + std::to_string(buffers_.back().size()) + " bytes; " +
             std::to_string(length) + " are promised");
  }
}

/// A data: URI, or a file beside or below this one.
std::string GltfData::resource(const std::string& uri, const std::string& where) const {
  if (uri.starts_with("data:")) {
    const std::size_t comma = uri.find(";base64,");
    if (comma == std::string::npos) refuse("its " + where + " has data that are not in base64");
    return from_base64(std::string_view(uri).substr(comma + 8));
  }
  const std::filesystem::path name = without_percents(uri);
  const bool leaves = std::find(name.begin(), name.end(), "..") != name.end();
  if (name.is_absolute() || leaves || uri.find(':') != std::string::npos)
    refuse("its " + where + " is '" + uri.substr(0, 60) + "', which is not beside it: embed it");
  const std::filesystem::path file = std::filesystem::path(path_).parent_path() / name;
  if (!std::filesystem::is_regular_file(file))
    refuse("its " + where + " is the file " + file.string() + ", which is not there");
  return read_text_file(file.string());
}

std::size_t GltfData::count(const char* list) const {
  if (!json_.contains(list)) return 0;
  if (!json_.at(list).is_array()) refuse(std::string("its '") + list + "' is no list");
  return json_.at(list).size();
}

const Json& GltfData::entry(const char* list, std::size_t i) const {
  if (i >= count(list))
    refuse(std::string("names entry ") + std::to_string(i) + " of '" + list + "'; there are " +
           std::to_string(count(list)));
  const Json& one = json_.at(list)[i];
  if (!one.is_object()) refuse(std::string("entry ") + std::to_string(i) + " of '" + list + "' is no object");
  return one;
}

std::size_t GltfData::natural(const Json& object, const char* name, const std::string& where,
                              std::size_t otherwise) const {
  if (!object.contains(name)) {
    if (otherwise == none) refuse("its " + where + " has no '" + name + "'");
    return otherwise;
  }
  const Json& value = object.at(name);
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() >> 40 != 0)
    refuse("its " + where + " has a '" + name + "' that is no natural number");
  return value.get<std::size_t>();
}

std::size_t GltfData::natural(const Json& object, const char* name, const std::string& where) const {
  return natural(object, name, where, none);
}

std::string_view GltfData::view(std::size_t i) const {
  const std::string where = "buffer view " + std::to_string(i);
  const Json& one = entry("bufferViews", i);
  const std::size_t buffer = natural(one, "buffer", where), from = natural(one, "byteOffset", where, 0),
                    length = natural(one, "byteLength", where);
  if (buffer >= buffers_.size())
    refuse("its " + where + " is of buffer " + std::to_string(buffer) + ", which is not there");
  const std::string_view bytes = buffers_[buffer];
  if (from > bytes.size() || length > bytes.size() - from)
    refuse("its " + where + " ends beyond its buffer of " + std::to_string(bytes.size()) + " bytes");
  return bytes.substr(from, length);
}

GltfData::Numbers GltfData::numbers(std::size_t i) const {
  const std::string where = "accessor " + std::to_string(i);
  const Json& one = entry("accessors", i);
  if (one.contains("sparse") || !one.contains("bufferView"))
    refuse("its " + where + " is sparse, which is not read: export it without");
  Numbers result;
  result.components = components_of(one.at("type").get<std::string>());
  const std::size_t code = natural(one, "componentType", where), count = natural(one, "count", where),
                    from = natural(one, "byteOffset", where, 0),
                    view_number = natural(one, "bufferView", where);
  const auto type = std::find_if(std::begin(component_types), std::end(component_types),
                                 [&](const ComponentType& t) { return t.code == code; });
  if (result.components == 0 || type == std::end(component_types))
    refuse("its " + where + " is of a type that has no place in a mesh");
  const std::string_view bytes = view(view_number);
  const std::size_t size = result.components * type->bytes;
  const std::size_t stride = natural(entry("bufferViews", view_number), "byteStride", where, size);
  if (stride < size) refuse("its " + where + " has elements that overlap");
  // Counts and strides are below 2^40: no product of what a file can hold overflows.
  if (count > 0 && (from > bytes.size() || size > bytes.size() - from ||
                    (count - 1) > (bytes.size() - from - size) / stride))
    refuse("its " + where + " of " + std::to_string(count) + " elements ends beyond its buffer view of " +
           std::to_string(bytes.size()) + " bytes");
  const bool normalized = one.value("normalized", false);
  result.values.reserve(count * result.components);
  for (std::size_t n = 0; n < count; ++n)
    for (std::size_t c = 0; c < result.components; ++c)
      result.values.push_back(
          number_at(bytes.data() + from + n * stride + c * type->bytes, *type, normalized));
  return result;
}

std::string GltfData::image(std::size_t i) const {
  const std::string where = "image " + std::to_string(i);
  const Json& one = entry("images", i);
  if (one.contains("uri")) return resource(one.at("uri").get<std::string>(), where);
  return std::string(view(natural(one, "bufferView", where)));
}

}  // namespace cleft
