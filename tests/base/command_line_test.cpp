// What a command line says of what it does not know.
#include "base/command/command_line.h"

#include <gtest/gtest.h>

namespace cleft {
namespace {

TEST(CommandLine, AnUnknownOptionIsNamedEvenWhereAnotherIsMissing) {
  CommandLine line("Cuts", "cleft cut");
  std::string mesh;
  line.add_option("--mesh", mesh, "a mesh")->required();
  char name[] = "cleft-cut", bogus[] = "--mehs", file[] = "a.stl";
  char* argv[] = {name, bogus, file, nullptr};
  testing::internal::CaptureStderr();
  EXPECT_EQ(line.parse(3, argv, "1"), 2);
  const std::string told = testing::internal::GetCapturedStderr();
  EXPECT_NE(told.find("not expected: --mehs"), std::string::npos) << told;
  EXPECT_NE(told.find("--mesh is required"), std::string::npos) << told;
}

}  // namespace
}  // namespace cleft
