#include "base/message.h"

#include <cstdint>
#include <cstdio>
#include <filesystem>

#include "base/error.h"

namespace cleft {

namespace {

constexpr std::size_t longest_message = 4000, kept_of_long = 1500;  // bytes; at either end

/// Bytes of the UTF-8 character at the start of the text; 0: there is none.
std::size_t bytes_of_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
  const std::size_t count = byte(0) < 0x80                       ? 1
                            : byte(0) >= 0xc2 && byte(0) <= 0xdf ? 2
                            : byte(0) >= 0xe0 && byte(0) <= 0xef ? 3
                            : byte(0) >= 0xf0 && byte(0) <= 0xf4 ? 4
                                                                 : 0;
  if (count == 0 || count > text.size()) return 0;
  for (std::size_t i = 1; i < count; ++i)
    if ((byte(i) & 0xc0) != 0x80) return 0;
  const bool control_of_latin1 = count == 2 && byte(0) == 0xc2 && byte(1) < 0xa0;
  return control_of_latin1 ? 0 : count;
}

const std::filesystem::filesystem_error* of_file_system(const std::exception& error) {
  return dynamic_cast<const std::filesystem::filesystem_error*>(&error);
}

}  // namespace

std::string printable(std::string_view text) {
  if (text.size() > longest_message)
    return printable(text.substr(0, kept_of_long)) + " [...] " +
           printable(text.substr(text.size() - kept_of_long));
  std::string out;
  while (!text.empty()) {
    const auto first = static_cast<std::uint8_t>(text[0]);
    std::size_t count = bytes_of_character(text);
    if (first == 0x7f || (first < 0x20 && first != '\n' && first != '\t')) count = 0;
    if (count > 0) {
      out += text.substr(0, count);
    } else {
      char code[8];
      std::snprintf(code, sizeof code, "\\x%02x", first);
      out += code;
    }
    text.remove_prefix(count > 0 ? count : 1);
  }
  return out;
}

std::string message_of(const std::exception& error) {
  if (const auto* e = of_file_system(error))
    return printable(e->path1().string() + ": " + e->code().message());
  return printable(error.what());
}

bool is_users_mistake(const std::exception& error) {
  if (dynamic_cast<const InputError*>(&error)) return true;
  const auto* e = of_file_system(error);
  return e && e->code() != std::errc::no_space_on_device && e->code() != std::errc::io_error;
}

std::string last_error(std::string written, const std::string& nothing) {
  while (!written.empty() && written.back() == '\n') written.pop_back();
  for (const char* mark : {"error: ", "failed: "})
    if (const auto at = written.rfind(mark); at != std::string::npos)
      return written.substr(at + std::string(mark).size());
  return written.empty() ? nothing : written;
}

}  // namespace cleft
