// Quantiles of values that were measured.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace cleft {

/// The `part` quantile, 0 to 1: one of the values. NaN if there are none.
inline double quantile(std::vector<double> values, double part) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1) + 0.5);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// The median; of an even number of values the upper one.
inline double median(std::vector<double> values) { return quantile(std::move(values), 0.5); }

}  // namespace cleft
