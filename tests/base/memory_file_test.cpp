// Files in memory that a library writes, and their way to the disk.
#include "base/memory_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>

#include "base/error.h"
#include "base/process.h"
#include "base/text.h"
#include "tests/support/temporary_folder.h"

namespace cleft {
namespace {

TEST(MemoryFile, IsCopiedToItsName) {
  const TemporaryFolder place;
  const std::string text(3'000'000, 'x');
  write_through_memory(place / "a.txt", [&](const std::string& path) { std::ofstream(path) << text; });
  EXPECT_EQ(read_text_file(place / "a.txt"), text);
  EXPECT_EQ(place.entries(), 1);
}

TEST(MemoryFile, ChildrenCanWriteIt) {
  const TemporaryFolder place;
  const MemoryFile file;
  EXPECT_TRUE(run_process({"sh", "-c", "echo words > " + file.path()}, place / "log", {}).success());
  file.copy_to(place / "a.txt");
  EXPECT_EQ(read_text_file(place / "a.txt"), "words\n");
}

TEST(MemoryFile, AFullDiskIsToldAndLeavesTheOlderFile) {
  const TemporaryFolder place;
  place.write("a.txt", "old");
  const auto before = signal(SIGXFSZ, SIG_IGN);
  rlimit kept{};
  getrlimit(RLIMIT_FSIZE, &kept);
  const MemoryFile file;
  std::ofstream(file.path()) << std::string(100'000, 'x');
  const rlimit small{1000, kept.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  std::string said;
  try {
    file.copy_to(place / "a.txt");
  } catch (const std::runtime_error& e) {
    said = e.what();
  }
  setrlimit(RLIMIT_FSIZE, &kept);
  signal(SIGXFSZ, before);
  EXPECT_EQ(said, place / "a.txt" + ": could not be written: File too large");
  EXPECT_EQ(read_text_file(place / "a.txt"), "old");
  EXPECT_EQ(place.entries(), 1);
}

TEST(MemoryFile, BadNamesAreToldBeforeTheWork) {
  const TemporaryFolder place;
  EXPECT_THROW(write_through_memory(place / "absent/a.txt", [](const std::string&) { FAIL(); }), InputError);
}

}  // namespace
}  // namespace cleft
