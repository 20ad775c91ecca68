// A row of docs/stability.md, written by the test that measures it.
#pragma once

#include <string>

/// One limit of a method, in a few words each. Numbers come from the test, rounded by the functions below so
/// that they are the same in every run.
struct Limit {
  std::string method;
  std::string limit;    ///< where it fails
  std::string shown;    ///< what the test measured
  std::string noticed;  ///< by what, or that it is not
  std::string then;     ///< what Cleft does
};

/// Writes the row of the running test into the folder that CLEFT_STABILITY_ROWS names; nothing where it is
/// not set. At most once in a test.
void record_limit(const Limit& limit);

/// With two significant digits.
std::string rounded(double value);

/// The next power of ten above it: for what rounding of the machine decides.
std::string power_of_ten(double value);

/// A message's text between quotes, as a row shows it: without what stands before `from`.
std::string quoted(const std::string& message, const std::string& from);
