// Messages quote whatever a user's files and arguments hold, and stay readable.
#include "base/message.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "base/command/command.h"
#include "base/error.h"

namespace cleft {
namespace {

TEST(Message, BytesThatAreNoTextAreWrittenAsCodes) {
  EXPECT_EQ(printable("a path, 3.5 mm\nand \u00e4\u20ac\U0001f600"),
            "a path, 3.5 mm\nand \u00e4\u20ac\U0001f600");
  EXPECT_EQ(printable("\x1b[31mred\a"), "\\x1b[31mred\\x07");
  EXPECT_EQ(printable("\xff\xc3(\xe2\x82"), "\\xff\\xc3(\\xe2\\x82") << "cut off, or no UTF-8";
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            "\\xc2\\x9b31m")
      << "a control character of 8 bits";
  const std::string shortened = printable(std::string(100000, 'x') + "end");
  EXPECT_LT(shortened.size(), 4000u);
  EXPECT_TRUE(shortened.ends_with("end"));
}

TEST(Message, ErrorsOfTheFileSystemNameTheFileAndTheReason) {
  const std::string name(300, 'a');
  try {
    static_cast<void>(std::filesystem::file_size(name));
    FAIL();
  } catch (const std::exception& e) {
    EXPECT_EQ(message_of(e), name + ": File name too long");
    EXPECT_TRUE(is_users_mistake(e));
  }
  const std::filesystem::filesystem_error full("cannot copy", "out",
                                               std::make_error_code(std::errc::no_space_on_device));
  EXPECT_EQ(message_of(full), "out: No space left on device");
  EXPECT_FALSE(is_users_mistake(full));
  EXPECT_FALSE(is_users_mistake(std::runtime_error("broken")));
  EXPECT_TRUE(is_users_mistake(InputError("a")));
}

TEST(Message, CommandsTellErrorsSo) {
  char name[] = "cleft-try";
  char* argv[] = {name, nullptr};
  const auto told = [&](const std::function<void()>& body) {
    CommandLine line("Tries", "cleft try");
    testing::internal::CaptureStderr();
    const int code = run_command(line, 1, argv, body);
    return std::to_string(code) + " " + testing::internal::GetCapturedStderr();
  };
  EXPECT_EQ(told([] { throw InputError("\x1b[2J.stl: no such file"); }),
            "2 cleft try: error: \\x1b[2J.stl: no such file\n");
  EXPECT_EQ(told([] { static_cast<void>(std::filesystem::file_size(std::string(300, 'b'))); }),
            "2 cleft try: error: " + std::string(300, 'b') + ": File name too long\n");
  EXPECT_EQ(told([] { throw std::runtime_error("broken"); }), "1 cleft try: failed: broken\n");
}

}  // namespace
}  // namespace cleft
