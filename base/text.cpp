#include "base/text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numeric>
#include <sstream>

#include "base/error.h"
#include "base/version.h"

namespace cleft {

namespace {

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t substitution = diagonal + (a[i] != b[j]);
      diagonal = row[j + 1];
      row[j + 1] = std::min({row[j] + 1, row[j + 1] + 1, substitution});
    }
  }
  return row.back();
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string_view> split(std::string_view line, char separator) {
  std::vector<std::string_view> parts;
  for (;;) {
    const auto end = line.find(separator);
    parts.push_back(trimmed(line.substr(0, end)));
    if (end == std::string_view::npos) return parts;
    line.remove_prefix(end + 1);
  }
}

}  // namespace

std::string shortest(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

std::string nearest_name(std::string_view word, const std::vector<std::string>& names) {
  std::string best;
  std::size_t least = std::max<std::size_t>(2, word.size() / 2) + 1;
  for (const std::string& name : names) {
    // A word without its group ("young_modulus") counts as near to the name that ends with it.
    const bool is_tail =
        name.size() > word.size() && name.ends_with(word) && name[name.size() - word.size() - 1] == '.';
    const std::size_t distance = is_tail ? 1 : edit_distance(word, name);
    if (distance < least) least = distance, best = name;
  }
  return best;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& names) {
  const std::string near = nearest_name(word, names);
  return near.empty() ? "" : " (did you mean '" + near + "'?)";
}

std::optional<double> number_of(std::string_view text) {
  double value = 0;
  std::string_view digits = trimmed(text);
  if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.remove_prefix(1);
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size() || !std::isfinite(value)) return {};
  return value;
}

double parse_number(std::string_view text, const std::string& where) {
  const std::optional<double> value = number_of(text);
  if (!value) throw InputError(where + ": '" + std::string(text) + "' is not a number");
  return *value;
}

static std::string given_to(const std::string& option, const std::string& text) {
  return option + ' ' + text;
}

std::map<std::string, double> numbers_by_name(const std::vector<std::string>& assignments,
                                              const std::string& option) {
  std::map<std::string, double> numbers;
  for (const std::string& assignment : assignments) {
    const auto equals = assignment.find('=');
    const std::string name = assignment.substr(0, equals), where = given_to(option, name);
    if (equals == std::string::npos) throw InputError(where + ": expected NAME=VALUE");
    if (!numbers.emplace(name, parse_number(assignment.substr(equals + 1), where)).second)
      throw InputError(where + ": given twice");
  }
  return numbers;
}

std::string producer() { return "cleft " CLEFT_VERSION; }

std::string read_text_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path))
    throw FileError(path, "cannot be read: does it exist, and is it a file?");
  return {std::istreambuf_iterator<char>(file), {}};
}

int NumberTable::column(std::string_view name) const {
  const auto at = std::find(columns.begin(), columns.end(), name);
  return at == columns.end() ? -1 : static_cast<int>(at - columns.begin());
}

NumberTable read_csv(const std::string& path) {
  std::string bytes = read_text_file(path);
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.erase(0, 3);  // the mark some editors put first
  std::istringstream text(bytes);
  NumberTable table;
  std::string line;
  for (int number = 1; std::getline(text, line); ++number) {
    if (trimmed(line).empty() || trimmed(line).front() == '#') continue;
    const auto parts = split(line, ',');
    const std::string where = path + ", line " + std::to_string(number);
    if (table.columns.empty()) {
      table.columns.assign(parts.begin(), parts.end());
      continue;
    }
    if (parts.size() != table.columns.size())
      throw InputError(where + ": " + std::to_string(parts.size()) + " values for " +
                       std::to_string(table.columns.size()) + " columns");
    std::vector<double>& row = table.rows.emplace_back();
    for (std::size_t i = 0; i < parts.size(); ++i)
      row.push_back(parse_number(parts[i], where + ", column '" + table.columns[i] + "'"));
  }
  if (table.columns.empty()) throw FileError(path, "is empty: the first line must name the columns");
  return table;
}

}  // namespace cleft
