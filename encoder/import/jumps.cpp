#include "encoder/import/jumps.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/text.h"

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

constexpr double nearly_closed = 5e-3;  // of the largest jump
constexpr double of_gradients = 2;      // times the largest difference within a cell

/// The largest difference between the first and another corner of a cell.
double largest_in_cells(const SourceMesh& mesh, const std::vector<double>& values, int components) {
  double largest = 0;
  for (std::size_t c = 0; c < mesh.cell_types.size(); ++c) {
    const auto first = static_cast<std::int32_t>(mesh.connectivity[mesh.cell_offsets[c]]);
    for (auto i = mesh.cell_offsets[c] + 1; i < mesh.cell_offsets[c + 1]; ++i)
      largest = std::max(largest,
                         jump_of(values, components, first, static_cast<std::int32_t>(mesh.connectivity[i])));
  }
  return largest;
}

/// The jumps of pairs, frame after frame.
class Jumps {
 public:
  Jumps(const std::vector<NodePair>& pairs, int components) : pairs_(pairs), components_(components) {}

  void see(const std::vector<double>& values) {
    auto& jumps = jumps_.emplace_back();
    for (const auto& [a, b] : pairs_)
      for (int c = 0; c < components_; ++c) jumps.push_back(at(values, b, c) - at(values, a, c));
    for (std::size_t p = 0; p < pairs_.size(); ++p) largest_ = std::max(largest_, size(jumps_.size() - 1, p));
  }

  double size(std::size_t frame, std::size_t pair) const { return std::sqrt(product(frame, frame, pair)); }
  double largest() const { return largest_; }

  /// A bound of the jumps of closed pairs; 0 where there is no noise.
  double noise(double rounding) const {
    constexpr double margin = 2, most = 0.02;  // of the largest jump: more is no noise
    double of_first = 0;
    for (std::size_t p = 0; p < pairs_.size(); ++p) of_first = std::max(of_first, size(0, p));
    if (of_first > rounding && of_first < most * largest_) return margin * of_first;
    const double turning = ever_closed(rounding) ? 0 : largest_turning(rounding);
    return turning < most * largest_ ? margin * turning : 0;
  }

  /// Whether no pair is closed in a frame but the first, though in one in which others are open a tenth of
  /// them nearly are.
  bool nearly_close(double rounding) const {
    constexpr double open = 0.1;  // of the largest jump
    if (ever_closed(rounding)) return false;
    for (std::size_t j = 1; j < jumps_.size(); ++j) {
      std::size_t nearly = 0;
      double of_frame = 0;
      for (std::size_t p = 0; p < pairs_.size(); ++p)
        nearly += size(j, p) <= nearly_closed * largest_, of_frame = std::max(of_frame, size(j, p));
      if (10 * nearly >= pairs_.size() && of_frame > open * largest_) return true;
    }
    return false;
  }

 private:
  bool ever_closed(double rounding) const {
    for (std::size_t j = 1; j < jumps_.size(); ++j)
      for (std::size_t p = 0; p < pairs_.size(); ++p)
        if (size(j, p) <= rounding) return true;
    return false;
  }

  double at(const std::vector<double>& values, std::int32_t node, int c) const {
    return values[static_cast<std::size_t>(node) * static_cast<std::size_t>(components_) +
                  static_cast<std::size_t>(c)];
  }
  double product(std::size_t i, std::size_t j, std::size_t pair) const {
    double sum = 0;
    for (int c = 0; c < components_; ++c) {
      const std::size_t k = pair * static_cast<std::size_t>(components_) + static_cast<std::size_t>(c);
      sum += jumps_[i][k] * jumps_[j][k];
    }
    return sum;
  }

  /// The largest jump up to which a quarter of the jumps and more turn around from one frame to the next.
  /// An opening keeps its direction; of noise, half of the jumps turn.
  double largest_turning(double rounding) const {
    constexpr std::size_t fewest = 50;
    std::vector<std::pair<double, bool>> jumps;
    for (std::size_t j = 1; j + 1 < jumps_.size(); ++j)
      for (std::size_t p = 0; p < pairs_.size(); ++p)
        if (const double least = std::min(size(j, p), size(j + 1, p)); least > rounding)
          jumps.emplace_back(least, product(j, j + 1, p) < 0);
    std::sort(jumps.begin(), jumps.end());
    double found = 0;
    for (std::size_t i = 0, turned = 0; i < jumps.size(); ++i) {
      turned += jumps[i].second;
      if (i >= fewest && 4 * turned >= i) found = jumps[i].first;
    }
    return found;
  }

  const std::vector<NodePair>& pairs_;
  int components_;
  double largest_ = 0;
  std::vector<std::vector<double>> jumps_;
};

}  // namespace

double jump_of(const std::vector<double>& values, int components, std::int32_t a, std::int32_t b) {
  const double* left = &values[static_cast<std::size_t>(a) * static_cast<std::size_t>(components)];
  const double* right = &values[static_cast<std::size_t>(b) * static_cast<std::size_t>(components)];
  double square = 0;
  for (int c = 0; c < components; ++c) square += (right[c] - left[c]) * (right[c] - left[c]);
  return std::sqrt(square);
}

std::vector<double> rounding_of(const ImportedSeries& series) {
  std::vector<Size> sizes(series.fields().size());
  series.for_each_frame([&](std::size_t, const FieldValues& values) {
    for (std::size_t f = 0; f < sizes.size(); ++f) sizes[f].see(values[f], series.fields()[f].components);
  });
  std::vector<double> rounding;
  for (std::size_t f = 0; f < sizes.size(); ++f)
    rounding.push_back(series.fields()[f].of_means ? std::numeric_limits<double>::infinity()
                                                   : sizes[f].rounding(series.fields()[f]));
  return rounding;
}

std::size_t telling_field(const ImportedSeries& series) {
  const auto& fields = series.fields();
  const auto first_that = [&](const auto& is_it) {
    return static_cast<std::size_t>(std::find_if(fields.begin(), fields.end(), is_it) - fields.begin());
  };
  std::size_t found = first_that([](const SeriesField& field) { return field.name == "displacement"; });
  if (found == fields.size()) found = first_that([](const SeriesField& field) { return !field.of_means; });
  return found == fields.size() ? 0 : found;
}

OpenAt parse_open_at(const std::string& text) {
  const bool share = !text.empty() && text.back() == '%';
  const double number = parse_number(share ? text.substr(0, text.size() - 1) : text, "--open-at");
  if (!(number >= 0) || !std::isfinite(number) || (share && number >= 100))
    throw InputError("--open-at '" + text +
                     "': must be a jump in units of the field, such as 0.002, or a share of the largest one, "
                     "such as 0.5%");
  return {share ? number / 100 : number, share};
}

Partings partings(const ImportedSeries& series, const Groups& groups, const std::optional<OpenAt>& given,
                  const std::function<void(std::size_t)>& progress) {
  Partings result;
  for (const auto& group : groups)
    for (std::size_t a = 0; a < group.size(); ++a)
      for (std::size_t b = a + 1; b < group.size(); ++b) result.pairs.push_back({group[a], group[b]});

  // What counts as a jump shows when all frames are seen: jumps are kept, the fields are not.
  const std::size_t field = telling_field(series);
  Jumps jumps(result.pairs, series.fields()[field].components);
  Size size;
  const int components = series.fields()[field].components;
  const bool of_means = series.fields()[field].of_means;
  std::vector<double> in_cells;  // of each frame
  series.for_each_frame([&](std::size_t j, const FieldValues& values) {
    if (progress) progress(j);
    size.see(values[field], components);
    jumps.see(values[field]);
    if (of_means) in_cells.push_back(largest_in_cells(series.mesh(), values[field], components));
  });
  const double rounding = size.rounding(series.fields()[field]);
  result.open_at = rounding, result.largest_jump = jumps.largest();
  if (given) {
    result.open_at = std::max(rounding, given->is_share ? given->value * jumps.largest() : given->value);
  } else if (of_means) {
    result.open_at = of_gradients * *std::max_element(in_cells.begin(), in_cells.end());
    if (jumps.largest() > result.open_at)
      result.because = "means of cells jump by as much where all is closed";
  } else if (const double noise = jumps.noise(rounding); noise > rounding) {
    result.open_at = noise, result.because = "the jumps of closed pairs are noise up to about this";
  } else if (jumps.nearly_close(rounding)) {
    result.open_at = nearly_closed * jumps.largest();
    result.because = "no pair is ever closed, and many are nearly closed";
  }
  result.first_frame.assign(result.pairs.size(), static_cast<std::int32_t>(series.frames()));
  for (std::size_t j = series.frames(); j-- > 0;) {
    const double open = of_means && !given ? std::max(rounding, of_gradients * in_cells[j]) : result.open_at;
    for (std::size_t p = 0; p < result.pairs.size(); ++p)
      if (jumps.size(j, p) > open) result.first_frame[p] = static_cast<std::int32_t>(j);
  }
  return result;
}

}  // namespace cleft
