#include "benchmarks/encoder/unseen.h"

#include <algorithm>

#include "base/parallel.h"

namespace cleft {

namespace {

/// Largest of what `error(i)` gives, in parallel.
template <class Function>
double largest_of(std::size_t count, const Function& error) {
  std::vector<double> errors(count);
  parallel_for(static_cast<int>(count), [&](int i) { errors[i] = error(static_cast<std::size_t>(i)); });
  return errors.empty() ? 0 : *std::max_element(errors.begin(), errors.end());
}

Vec3 displacement_of(const Series& series, std::size_t frame, std::int64_t node) {
  const auto row = series.frames[frame].row(node);
  return {row(0), row(1), row(2)};
}

}  // namespace

double error_at_centroids(const Field& field, const Series& series, const Snapshot& s) {
  const double worst = largest_of(s.cell_types.size(), [&](std::size_t c) {
    const auto corners = std::span(s.connectivity)
                             .subspan(static_cast<std::size_t>(s.cell_offsets[c]),
                                      static_cast<std::size_t>(s.cell_offsets[c + 1] - s.cell_offsets[c]));
    const double part = 1. / static_cast<double>(corners.size());
    Vec3 centre;
    for (const std::int64_t node : corners) centre += part * series.samples[node].uvw;
    double error = 0;
    if (centre.y == 0) return error;  // a face in the cut's plane: on which side is not said
    for (std::size_t j = 1; j < series.frames.size(); ++j) {
      Vec3 mean;
      for (const std::int64_t node : corners) mean += part * displacement_of(series, j, node);
      error = std::max(error, norm(field.displacement(centre, Side::both, series.times[j]) - mean));
    }
    return error;
  });
  return worst / series.largest_displacement;
}

std::map<std::size_t, double> errors_unseen(const Series& series, const EncodeOptions& options) {
  Series seen = series;
  seen.times.clear(), seen.frames.clear(), seen.largest.clear();
  std::vector<std::size_t> left_out;
  for (std::size_t j = 0; j < series.times.size(); ++j) {
    if (j % 2 == 1 && j + 1 < series.times.size()) {
      left_out.push_back(j);
      continue;
    }
    seen.times.push_back(series.times[j]), seen.frames.push_back(series.frames[j]);
    seen.largest.push_back(series.largest[j]);
  }
  const Field field = encode(seen, options, [](const std::string&) {}).field;
  std::map<std::size_t, double> errors;
  for (const std::size_t j : left_out)
    errors[j] = largest_of(series.samples.size(),
                           [&](std::size_t n) {
                             const Sample& sample = series.samples[n];
                             return norm(field.displacement(sample.uvw, sample.side, series.times[j]) -
                                         displacement_of(series, j, static_cast<std::int64_t>(n)));
                           }) /
                series.largest_displacement;
  return errors;
}

}  // namespace cleft
