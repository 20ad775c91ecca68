// Lines and words.
#include "explorer/session/command_table.h"

#include <gtest/gtest.h>

#include <set>

namespace cleft {
namespace {

using Words = std::vector<std::string>;

TEST(CommandTable, LinesAreSplitAtBlanksOutsideQuotes) {
  EXPECT_EQ(split_line("  open  a\tb "), (Words{"open", "a", "b"}));
  EXPECT_EQ(split_line("open 'a b' \"it's\""), (Words{"open", "a b", "it's"}));
  EXPECT_EQ(split_line("open a'b c'd"), (Words{"open", "ab cd"}));
  EXPECT_EQ(split_line("# nothing"), Words{});
  EXPECT_EQ(split_line("time 3 # later"), (Words{"time", "3"}));
  EXPECT_EQ(split_line("open ''"), (Words{"open", ""}));
  EXPECT_THROW(split_line("open 'a"), InputError);
}

TEST(CommandTable, QuotedWordsAreReadAsTheyWere) {
  for (const std::string word : {"a", "", "a b", "it's here", "say \"so\"", "#1", "a\tb"})
    EXPECT_EQ(split_line("open " + quoted(word)), (Words{"open", word}));
}

TEST(CommandTable, EveryCommandHasOneNameAndHelp) {
  std::set<std::string> names;
  const std::string sheet = help_sheet();
  for (const CommandGroup& group : command_groups())
    for (const Command& c : group.commands) {
      EXPECT_TRUE(names.insert(c.name).second) << c.name;
      EXPECT_NE(c.help, "") << c.name;
      EXPECT_NE(sheet.find("  " + c.name), std::string::npos);
      EXPECT_EQ(&find_command(c.name), &c);
    }
  EXPECT_GT(names.size(), 30u);
}

TEST(CommandTable, AnUnknownNameGetsTheNearest) {
  try {
    find_command("scrnshot");
    ADD_FAILURE();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("'screenshot'"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace cleft
