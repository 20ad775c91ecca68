// A number with fewer digits.
#pragma once

#include <charconv>

namespace cleft {

/// To `digits` decimal digits, 1 to 17. What is not finite stays as it is.
inline double rounded_to_digits(double value, int digits) {
  char text[40];
  const auto end =
      std::to_chars(text, text + sizeof text, value, std::chars_format::scientific, digits - 1).ptr;
  double rounded = value;
  std::from_chars(text, end, rounded);
  return rounded;
}

}  // namespace cleft
