#include "tests/support/stability_row.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "base/error.h"
#include "base/output_file.h"
#include "base/text.h"

void record_limit(const Limit& limit) {
  const char* folder = std::getenv("CLEFT_STABILITY_ROWS");
  if (!folder) return;
  const testing::TestInfo& test = *testing::UnitTest::GetInstance()->current_test_info();
  std::string row = "|";
  for (const std::string& cell : {limit.method, limit.limit, limit.shown, limit.noticed, limit.then}) {
    CLEFT_CHECK(cell.find_first_of("|\n"), ==, std::string::npos);
    row += " " + cell + " |";
  }
  const std::string name = std::string(test.test_suite_name()) + "." + test.name();
  cleft::write_text_file(std::string(folder) + "/" + name, row + " `" + name + "` |\n");
}

std::string rounded(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1e", value);
  return cleft::shortest(std::strtod(text, nullptr));
}

std::string power_of_ten(double value) {
  return "1e" + std::to_string(static_cast<int>(std::ceil(std::log10(std::abs(value)))));
}

std::string quoted(const std::string& message, const std::string& from) {
  const auto at = message.find(from);
  EXPECT_NE(at, std::string::npos) << message;
  if (at == std::string::npos) return "";
  std::string text = message.substr(at);
  if (const auto end = text.find('\n'); end != std::string::npos) text.resize(end);
  return "\"" + text + "\"";
}
