#include "base/sealed_json.h"

#include <boost/crc.hpp>

#include "base/error.h"
#include "base/text.h"

namespace cleft {

using Json = nlohmann::ordered_json;

namespace {

constexpr int first_sealed_version = 2;

std::uint32_t checksum(const std::string& text) {
  boost::crc_32_type crc;  // finds every change of up to 32 neighbouring bits
  crc.process_bytes(text.data(), text.size());
  return crc.checksum();
}

}  // namespace

std::string sealed_text(Json object) {
  object.erase("seal");
  object["seal"] = checksum(object.dump());
  return object.dump(1) + "\n";
}

Json read_sealed(const std::string& path) {
  const std::string text = read_text_file(path);
  Json object;
  try {
    object = Json::parse(text);
  } catch (const Json::exception& e) {
    throw FileError(path, std::string("is damaged: ") + e.what());
  }
  if (!object.is_object()) throw FileError(path, "is damaged: it is no JSON object");
  const Json version = object.value("version", Json(0));
  if (!version.is_number_integer()) throw FileError(path, "is damaged: its version is no number");
  if (!object.contains("seal") && version.get<int>() < first_sealed_version) return object;
  try {
    if (sealed_text(object) != text) throw FileError(path, "is damaged: it differs from what was written");
  } catch (const Json::exception& e) {  // text that is not UTF-8
    throw FileError(path, std::string("is damaged: ") + e.what());
  }
  object.erase("seal");
  return object;
}

}  // namespace cleft
