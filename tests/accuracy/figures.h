// The figures that are watched, as a table and as differences between two tables.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace cleft {

/// What is watched: columns of accuracy.csv. The first of them are figures of `cleft encode --json`, of which
/// the last, least_volume, is the only one that is better the larger it is; then what the fit missed where it
/// saw nothing, at the cells' centroids and in frames kept from it.
inline constexpr std::array figure_names = {
    "bytes",          "relative_l2", "node_error",   "spline_error",   "gape_error",  "false_gap",
    "crease_degrees", "overlap_mm",  "least_volume", "centroid_error", "unseen_error"};
inline constexpr std::size_t bytes = 0, node_error = 2, least_volume = 8, centroid_error = 9,
                             unseen_error = 10;  ///< their places

struct AccuracyRow {
  std::string case_name;
  double tolerance = 0;
  std::array<double, figure_names.size()> figures{};
};

/// Throws FileError naming the line where a row is not as the header says.
std::vector<AccuracyRow> read_accuracy(const std::string& path);
std::string accuracy_text(const std::vector<AccuracyRow>& rows);

/// A sentence for each figure of `now` that differs from `before` by more than 1 % and more than 16 bytes, or
/// an error of 1e-9 (an overlap of 1e-9 mm, a crease of 1e-9 degrees).
struct Differences {
  std::vector<std::string> worse, better;
};
Differences compare(const AccuracyRow& before, const AccuracyRow& now);

/// The row of a case and tolerance, or null.
const AccuracyRow* find_row(const std::vector<AccuracyRow>& rows, const std::string& case_name,
                            double tolerance);

}  // namespace cleft
