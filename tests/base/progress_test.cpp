// What a line of progress tells besides its state.
#include <gtest/gtest.h>
#include <pty.h>
#include <unistd.h>

#include <functional>
#include <optional>

#include "base/command/command.h"

namespace cleft {

TEST(Progress, TellsThePartThatIsDoneAndTheTimeThatIsLeft) {
  EXPECT_EQ(part_and_time_left(1, 1, 10, 0), "0 %") << "the first of ten has only begun";
  EXPECT_EQ(part_and_time_left(1, 6, 10, 4.9), "50 %") << "too early for a pace";
  EXPECT_EQ(part_and_time_left(1, 6, 10, 10), "50 % (about 10 s left)") << "five in 10 s, five are left";
  EXPECT_EQ(part_and_time_left(1, 3, 62, 40), "3 % (about 20 min left)") << "20 s each, 60 are left";
  EXPECT_EQ(part_and_time_left(1, 1 + 0.25, 1, 20), "25 % (about 60 s left)") << "a quarter of the whole";
  EXPECT_EQ(part_and_time_left(4, 4, 8, 100), "37 %") << "nothing was done since the step began";
}

/// What the function writes to stderr where that is a terminal of so many columns; none where the system has
/// no terminals.
std::optional<std::string> on_a_terminal(unsigned short columns, const std::function<void()>& function) {
  winsize size{};
  size.ws_row = 24, size.ws_col = columns;
  int screen = -1, terminal = -1;
  if (openpty(&screen, &terminal, nullptr, nullptr, &size) != 0) return {};
  const int before = dup(STDERR_FILENO);
  dup2(terminal, STDERR_FILENO);
  function();
  dup2(before, STDERR_FILENO);
  close(before), close(terminal);
  std::string text;
  char bytes[4096];
  for (ssize_t count = 0; (count = read(screen, bytes, sizeof bytes)) > 0;)
    text.append(bytes, static_cast<std::size_t>(count));
  close(screen);
  return text;
}

TEST(Progress, ALineKeepsToOneRowOfTheTerminalAndIsCleared) {
  const std::optional<std::string> text = on_a_terminal(40, [] {
    Progress progress("reading");
    progress("a state that is much longer than a row of this narrow terminal can hold");
    progress("short");
  });
  if (!text) GTEST_SKIP() << "the system has no pseudoterminals (/dev/pts)";
  const std::string clear = "\r\033[K";
  EXPECT_EQ(text, clear + "reading: a state that is much longer th" + clear + "reading: short" + clear);
}

}  // namespace cleft
