#include "haptic/loop_statistics.h"

#include <algorithm>
#include <cmath>

namespace cleft {

void TimeHistogram::add(double seconds) {
  const double step = steps * std::log2(std::max(seconds * 1e9, 1.));
  ++counts_[std::min(step, steps * octaves - 1.)];
  ++count_;
  largest_ = std::max(largest_, seconds);
}

double TimeHistogram::quantile(double part) const {
  std::uint64_t rank = static_cast<std::uint64_t>(std::ceil(part * static_cast<double>(count_)));
  rank = std::clamp<std::uint64_t>(rank, 1, std::max<std::uint64_t>(count_, 1));
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    sum += counts_[i];
    if (sum >= rank) return std::min(largest_, 1e-9 * std::exp2(static_cast<double>(i + 1) / steps));
  }
  return 0;
}

}  // namespace cleft
