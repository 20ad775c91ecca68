#include "tests/accuracy/figures.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "base/error.h"
#include "base/text.h"

namespace cleft {

namespace {

std::string formatted(const char* format, double value) {
  char text[40];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string header() {
  std::string line = "case,tolerance";
  for (const char* name : figure_names) line += std::string(",") + name;
  return line;
}

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> parts;
  std::istringstream stream(line);
  for (std::string part; std::getline(stream, part, ',');) parts.push_back(part);
  return parts;
}

}  // namespace

std::vector<AccuracyRow> read_accuracy(const std::string& path) {
  std::istringstream lines(read_text_file(path));
  std::string line;
  if (!std::getline(lines, line) || line != header()) throw FileError(path, "line 1 must be " + header());
  std::vector<AccuracyRow> rows;
  for (int number = 2; std::getline(lines, line); ++number) {
    const std::vector<std::string> parts = split(line);
    const std::string where = "line " + std::to_string(number);
    if (parts.size() != figure_names.size() + 2)
      throw FileError(path, where + " has " + std::to_string(parts.size()) + " columns");
    AccuracyRow row{parts[0], parse_number(parts[1], path + ": " + where), {}};
    for (std::size_t i = 0; i < row.figures.size(); ++i)
      row.figures[i] = parse_number(parts[i + 2], path + ": " + where);
    rows.push_back(row);
  }
  return rows;
}

std::string accuracy_text(const std::vector<AccuracyRow>& rows) {
  std::string text = header() + "\n";
  for (const AccuracyRow& row : rows) {
    text += row.case_name + "," + shortest(row.tolerance);
    for (std::size_t i = 0; i < row.figures.size(); ++i)
      text += "," + formatted(i == bytes ? "%.0f" : "%.6g", row.figures[i]);
    text += "\n";
  }
  return text;
}

Differences compare(const AccuracyRow& before, const AccuracyRow& now) {
  Differences differences;
  for (std::size_t i = 0; i < figure_names.size(); ++i) {
    const double was = before.figures[i], is = now.figures[i], floor = i == bytes ? 16 : 1e-9;
    const std::string what = now.case_name + " at tolerance " + shortest(now.tolerance) + ": " +
                             figure_names[i] + " " + formatted("%.6g", was) + " -> " + formatted("%.6g", is) +
                             (was > 0 ? " (" + formatted("%+.1f", 100 * (is / was - 1)) + " %)" : "");
    const double margin = 0.01 * std::abs(was) + floor, gain = i == least_volume ? is - was : was - is;
    if (!(gain >= -margin)) differences.worse.push_back(what);  // no number is worse too
    if (gain > margin) differences.better.push_back(what);
  }
  return differences;
}

const AccuracyRow* find_row(const std::vector<AccuracyRow>& rows, const std::string& case_name,
                            double tolerance) {
  const auto row = std::find_if(rows.begin(), rows.end(), [&](const AccuracyRow& one) {
    return one.case_name == case_name && one.tolerance == tolerance;
  });
  return row == rows.end() ? nullptr : &*row;
}

}  // namespace cleft
