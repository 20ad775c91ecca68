// Small helpers for messages and text files.
#pragma once

#include <cstdio>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cleft {

/// The shortest decimal text that reads back as the same double.
std::string shortest(double value);

/// Of `names` the one with the least edit distance to `word`; empty if none is close.
std::string nearest_name(std::string_view word, const std::vector<std::string>& names);

/// " (did you mean 'x'?)", or "" if no name is close.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& names);

/// As printf writes it, of any length.
template <class... Values>
std::string formatted(const char* format, Values... values) {
  std::string text(static_cast<std::size_t>(std::snprintf(nullptr, 0, format, values...)), '\0');
  std::snprintf(text.data(), text.size() + 1, format, values...);
  return text;
}

/// The number that the whole text is, but for blanks around it and a plus before it; none where it is none,
/// or not finite.
std::optional<double> number_of(std::string_view text);

/// Reads a whole number or a decimal; throws InputError "<where>: '<text>' is not a number".
double parse_number(std::string_view text, const std::string& where);

/// Of assignments NAME=NUMBER of an option, such as --set; throws InputError for one that is none, or a name
/// that is given twice.
std::map<std::string, double> numbers_by_name(const std::vector<std::string>& assignments,
                                              const std::string& option);

/// Name and version of this program, as written into files.
std::string producer();

/// The whole text of a file; throws FileError if it cannot be read.
std::string read_text_file(const std::string& path);

/// A table of numbers with a header line of column names, as in CSV files.
struct NumberTable {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;

  /// Index of a column, or -1.
  int column(std::string_view name) const;
};

/// Reads comma-separated numbers under a header line. Empty lines and lines that begin with # are skipped.
/// Throws FileError with line and column of a text that is not a number, or of a row with too few or too many
/// columns.
NumberTable read_csv(const std::string& path);

}  // namespace cleft
