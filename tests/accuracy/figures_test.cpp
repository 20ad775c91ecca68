// The comparison by itself, and that the table is whole.
#include "tests/accuracy/figures.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "tests/accuracy/references.h"
#include "tests/support/temporary_folder.h"

namespace cleft {

namespace {

const AccuracyRow before{"deep", 0.01, {10000, 0.005, 0.01, 0.02, 0.004, 0, 0, 0.001, 0.9, 0.02, 0.03}};

AccuracyRow with(std::size_t figure, double value) {
  AccuracyRow row = before;
  row.figures[figure] = value;
  return row;
}

}  // namespace

TEST(AccuracyFigures, WhatIsWorseByMoreThanOnePercentIsToldByName) {
  const Differences d = compare(before, with(1, 0.00506));
  ASSERT_EQ(d.worse.size(), 1);
  EXPECT_EQ(d.worse[0], "deep at tolerance 0.01: relative_l2 0.005 -> 0.00506 (+1.2 %)");
  EXPECT_TRUE(d.better.empty());
  EXPECT_TRUE(compare(before, with(1, 0.00504)).worse.empty());
}

TEST(AccuracyFigures, EveryFigureIsWatched) {
  for (std::size_t i = 0; i < figure_names.size(); ++i) {
    const double sign = i == least_volume ? -1 : 1;  // the larger, the better
    const Differences worse =
        compare(before, with(i, (1 + 0.1 * sign) * before.figures[i] + sign * 1e-6 + (i == bytes ? 17 : 0)));
    ASSERT_EQ(worse.worse.size(), 1) << figure_names[i];
    EXPECT_NE(worse.worse[0].find(figure_names[i]), std::string::npos);
    EXPECT_EQ(compare(before, with(i, NAN)).worse.size(), 1) << figure_names[i];
    if (before.figures[i] == 0) continue;
    const Differences better = compare(before, with(i, (1 - 0.1 * sign) * before.figures[i]));
    EXPECT_EQ(better.better.size(), 1) << figure_names[i];
    EXPECT_TRUE(better.worse.empty());
  }
}

TEST(AccuracyFigures, SmallestDifferencesDoNotCount) {
  EXPECT_TRUE(compare(before, with(bytes, 10115)).worse.empty());
  EXPECT_FALSE(compare(before, with(bytes, 10117)).worse.empty());
  EXPECT_TRUE(compare(before, with(5, 0.9e-9)).worse.empty());
  EXPECT_FALSE(compare(before, with(5, 1.1e-9)).worse.empty());
}

TEST(AccuracyFigures, ATableReadsBackAndDamageIsTold) {
  const TemporaryFolder folder;
  const std::string text = accuracy_text({before, with(bytes, 12)});
  const std::vector<AccuracyRow> rows = read_accuracy(folder.write("a.csv", text));
  ASSERT_EQ(rows.size(), 2);
  EXPECT_EQ(rows[0].figures, before.figures);
  EXPECT_EQ(rows[1].figures[0], 12);
  EXPECT_EQ(find_row(rows, "deep", 0.01), &rows[0]);
  EXPECT_EQ(find_row(rows, "deep", 0.02), nullptr);
  EXPECT_THROW(read_accuracy(folder.write("b.csv", text + "deep,0.01\n")), FileError);
  EXPECT_THROW(read_accuracy(folder.write("c.csv", "case,bytes\n")), FileError);
}

TEST(AccuracyFigures, TheTableHasARowForEveryCaseAndTolerance) {
  const std::vector<AccuracyRow> rows = read_accuracy(accuracy_file());
  for (const std::string& name : references())
    for (const double tolerance : reference_tolerances)
      EXPECT_TRUE(find_row(rows, name, tolerance)) << name << " at tolerance " << tolerance;
  EXPECT_EQ(rows.size(), references().size() * reference_tolerances.size());
}

}  // namespace cleft
