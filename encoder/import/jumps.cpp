#include "encoder/import/jumps.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cleft {

namespace {

constexpr double smallest_jump = 1e-9, smallest_single_jump = 8 * std::numeric_limits<float>::epsilon();

/// A field's size, from the frames seen.
class Size {
 public:
  void see(const std::vector<double>& values, int components) {
    for (std::size_t i = 0; i < values.size(); i += static_cast<std::size_t>(components)) {
      double square = 0;
      for (int c = 0; c < components; ++c)
        square += values[i + static_cast<std::size_t>(c)] * values[i + static_cast<std::size_t>(c)];
      largest_ = std::max(largest_, std::sqrt(square));
      low_ = std::min(low_, values[i]), high_ = std::max(high_, values[i]);
    }
  }
  double rounding(const SeriesField& field) const {
    const double exact = smallest_jump * (field.components == 1 ? high_ - low_ : largest_);
    return field.single ? std::max(exact, smallest_single_jump * largest_) : exact;
  }

 private:
  double largest_ = 0, low_ = std::numeric_limits<double>::infinity(), high_ = -low_;
};

}  // namespace

double jump_of(const std::vector<double>& values, int components, std::int32_t a, std::int32_t b) {
  const double* left = &values[static_cast<std::size_t>(a) * static_cast<std::size_t>(components)];
  const double* right = &values[static_cast<std::size_t>(b) * static_cast<std::size_t>(components)];
  double square = 0;
  for (int c = 0; c < components; ++c) square += (right[c] - left[c]) * (right[c] - left[c]);
  return std::sqrt(square);
}

std::vector<double> rounding_of(const Series& series) {
  std::vector<Size> sizes(series.fields().size());
  for (std::size_t j = 0; j < series.frames(); ++j) {
    const FieldValues values = series.frame(j);
    for (std::size_t f = 0; f < sizes.size(); ++f) sizes[f].see(values[f], series.fields()[f].components);
  }
  std::vector<double> rounding;
  for (std::size_t f = 0; f < sizes.size(); ++f) rounding.push_back(sizes[f].rounding(series.fields()[f]));
  return rounding;
}

std::size_t telling_field(const Series& series) {
  const auto& fields = series.fields();
  const auto found = std::find_if(fields.begin(), fields.end(),
                                  [](const SeriesField& field) { return field.name == "displacement"; });
  return found == fields.end() ? 0 : static_cast<std::size_t>(found - fields.begin());
}

Partings partings(const Series& series, const Groups& groups,
                  const std::function<void(std::size_t)>& progress) {
  Partings result;
  for (const auto& group : groups)
    for (std::size_t a = 0; a < group.size(); ++a)
      for (std::size_t b = a + 1; b < group.size(); ++b) result.pairs.push_back({group[a], group[b]});

  // Whether a jump is more than rounding shows when all frames are seen: jumps are kept, the fields are not.
  const std::size_t field = telling_field(series);
  const int components = series.fields()[field].components;
  Size size;
  std::vector<std::vector<double>> jumps;
  for (std::size_t j = 0; j < series.frames(); ++j) {
    if (progress) progress(j);
    const std::vector<double> values = series.frame(j)[field];
    size.see(values, components);
    auto& now = jumps.emplace_back();
    for (const auto& [a, b] : result.pairs) now.push_back(jump_of(values, components, a, b));
  }
  const double rounding = size.rounding(series.fields()[field]);
  result.first_frame.assign(result.pairs.size(), static_cast<std::int32_t>(series.frames()));
  for (std::size_t j = series.frames(); j-- > 0;)
    for (std::size_t p = 0; p < result.pairs.size(); ++p)
      if (jumps[j][p] > rounding) result.first_frame[p] = static_cast<std::int32_t>(j);
  return result;
}

}  // namespace cleft
