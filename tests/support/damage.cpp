#include "tests/support/damage.h"

#include <gtest/gtest.h>

#include <fstream>

#include "base/error.h"
#include "base/text.h"

int unnoticed_damages(const std::string& file, int places,
                      const std::function<void(const std::string&)>& read,
                      const std::function<bool()>& same) {
  const std::string sound = cleft::read_text_file(file), copy = file + ".damaged";
  int unnoticed = 0, noticed = 0;
  const auto attempt = [&](const std::string& bytes, const std::string& what) {
    std::ofstream(copy, std::ios::binary) << bytes;
    try {
      read(copy);
      if (same()) return;
      ++unnoticed;
      ADD_FAILURE() << what << " went unnoticed";
    } catch (const cleft::InputError&) {
      ++noticed;
    }
  };
  for (int i = 0; i < places; ++i) {
    const std::size_t at = sound.size() * static_cast<std::size_t>(i) / static_cast<std::size_t>(places);
    std::string bytes = sound;
    bytes[at] = static_cast<char>(bytes[at] ^ (1 << i % 8));
    attempt(bytes, "a bit flipped in byte " + std::to_string(at));
    attempt(sound.substr(0, at), "a file cut to " + std::to_string(at) + " bytes");
  }
  EXPECT_GT(noticed, places) << "every shortened file, and many flipped bits, must be noticed";
  return unnoticed;
}
