// A few thousand edits of HDF5 files, in every build, within the memory that a reader may take.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <random>

#include "tests/fuzz/h5_targets.h"

namespace cleft::fuzz {
namespace {

void feed(void (*reader)(const std::uint8_t*, std::size_t), int count) {
  std::mt19937 random(4);
  for (int i = 0; i < count; ++i) {
    std::vector<std::uint8_t> edits(4 + random() % 24);
    for (std::uint8_t& byte : edits) byte = static_cast<std::uint8_t>(random());
    SCOPED_TRACE(i);
    ASSERT_NO_THROW(reader(edits.data(), edits.size()));
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  EXPECT_LT(usage.ru_maxrss, 500 * 1024) << "kB: what a file declares is not taken before it is looked at";
}

TEST(EditedFiles, SnapshotsAreReadOrRefused) { feed(read_edited_snapshot, 400); }
TEST(EditedFiles, FieldsAreReadOrRefused) { feed(read_edited_field, 400); }
TEST(EditedFiles, StudiesAreReadOrRefused) { feed(read_edited_study, 400); }

}  // namespace
}  // namespace cleft::fuzz
