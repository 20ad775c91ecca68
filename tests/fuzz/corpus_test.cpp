// The corpus through the fuzzed readers once: what was found stays mended.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <filesystem>
#include <random>

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
TEST(Corpus, SeriesAreReadOrRefused) { EXPECT_GT(feed("series", read_series), 3); }
TEST(Corpus, MeshesAreReadAndCutOrRefused) { EXPECT_GT(feed("mesh", read_and_cut_mesh), 3); }

/// Some bytes replaced, digits by digits as often as not, or the file cut.
TEST(Corpus, SeriesThatAreEditedAreReadOrRefused) {
  std::mt19937 random(7);
  for (const auto& entry : std::filesystem::directory_iterator(CLEFT_SOURCE "/tests/fuzz/corpus/series")) {
    const std::string sound = read_text_file(entry.path().string());
    for (int i = 0; i < 3000; ++i) {
      SCOPED_TRACE(entry.path().string() + " " + std::to_string(i));
      std::string bytes = sound;
      for (unsigned edits = 1 + random() % 6; edits > 0; --edits) {
        char& byte = bytes[1 + random() % (bytes.size() - 1)];
        byte = static_cast<char>(random() % 2 == 0 && byte >= '0' && byte <= '9' ? '0' + random() % 10
                                                                                 : random());
      }
      if (random() % 8 == 0) bytes.resize(1 + random() % bytes.size());
      ASSERT_NO_THROW(read_series(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()));
    }
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  EXPECT_LT(usage.ru_maxrss, 500 * 1024) << "kB: what a file declares is not taken before it is looked at";
}

}  // namespace
}  // namespace cleft::fuzz
