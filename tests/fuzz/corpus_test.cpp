// The corpus through the fuzzed readers once: what was found stays mended.
#include <gtest/gtest.h>

#include <filesystem>

#include "base/text.h"
#include "tests/fuzz/targets.h"

namespace cleft::fuzz {
namespace {

int feed(const std::string& folder, void (*reader)(const std::uint8_t*, std::size_t)) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(CLEFT_SOURCE "/tests/fuzz/corpus/" + folder)) {
    SCOPED_TRACE(entry.path().string());
    const std::string bytes = read_text_file(entry.path().string());
    EXPECT_NO_THROW(reader(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()));
    ++count;
  }
  return count;
}

TEST(Corpus, PathsAreReadOrRefused) { EXPECT_GT(feed("path", read_path), 3); }
TEST(Corpus, MeshesAreReadAndCutOrRefused) { EXPECT_GT(feed("mesh", read_and_cut_mesh), 3); }

}  // namespace
}  // namespace cleft::fuzz
