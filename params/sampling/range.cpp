// Values along ranges, and what methods that draw from them share.
#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/rounded.h"
#include "params/parameters/table.h"
#include "params/sampling/sampling.h"

namespace cleft {

namespace {

double rounded_within(const Range& range, double value) {
  const auto [least, greatest] = std::minmax(range.from, range.to);
  return std::clamp(rounded_to_digits(value, 12), least, greatest);
}

}  // namespace

double Range::at(double part, double whole) const {
  if (part == 0) return from;
  if (part == whole) return to;
  if (!logarithmic) return from + (to - from) * part / whole;
  return rounded_within(*this, std::exp(std::log(from) + (std::log(to) - std::log(from)) * part / whole));
}

std::vector<Variation> ranges_by_name(const Study& study) {
  std::vector<Variation> ranges = study.vary;
  std::sort(ranges.begin(), ranges.end(),
            [](const Variation& a, const Variation& b) { return a.name < b.name; });
  for (const Variation& variation : ranges) CLEFT_CHECK(variation.range.has_value(), ==, true);
  return ranges;
}

double unit_fraction(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-53; }

void set_drawn(Case& one, const Variation& variation, double part, double whole) {
  const Range& range = *variation.range;
  set_parameter(one.parameters, variation.name, rounded_within(range, range.at(part, whole)), variation.name);
}

}  // namespace cleft
