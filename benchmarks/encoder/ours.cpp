#include "benchmarks/encoder/ours.h"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "base/stopwatch.h"
#include "encoder/encode.h"
#include "encoder/field/field_file.h"
#include "encoder/field/field_record.h"
#include "encoder/parallel.h"

namespace cleft {

namespace {

/// Displacements at all nodes and frames but the first, as the file holds them.
std::vector<float> decoded(const std::string& file, const Series& series, const NodeData& data) {
  const Field field = read_field(file);
  const std::optional<NodeResidual> residual = read_residual(file);
  std::vector<float> values(data.values.size());
  parallel_for(static_cast<int>(data.frames), [&](int j) {
    const auto frame = static_cast<std::size_t>(j);
    for (std::size_t n = 0; n < data.nodes; ++n) {
      Vec3 d = field.displacement(series.samples[n].uvw, series.samples[n].side, series.times[frame + 1]);
      if (residual) d += residual->at(n, frame + 1);
      for (std::size_t axis = 0; axis < 3; ++axis)
        values[(frame * data.nodes + n) * 3 + axis] = static_cast<float>(d[static_cast<int>(axis)]);
    }
  });
  return values;
}

/// Largest of what `error(i)` gives, in parallel.
template <class Function>
double largest_of(std::size_t count, const Function& error) {
  std::vector<double> errors(count);
  parallel_for(static_cast<int>(count),
               [&](int i) { errors[static_cast<std::size_t>(i)] = error(static_cast<std::size_t>(i)); });
  return errors.empty() ? 0 : *std::max_element(errors.begin(), errors.end());
}

Vec3 displacement_of(const Series& series, std::size_t frame, std::int64_t node) {
  const auto row = series.frames[frame].row(node);
  return {row(0), row(1), row(2)};
}

double centroid_error(const Field& field, const Series& series, const Snapshot& s) {
  const double worst = largest_of(s.cell_types.size(), [&](std::size_t c) {
    const auto corners = std::span(s.connectivity)
                             .subspan(static_cast<std::size_t>(s.cell_offsets[c]),
                                      static_cast<std::size_t>(s.cell_offsets[c + 1] - s.cell_offsets[c]));
    const double part = 1. / static_cast<double>(corners.size());
    Vec3 centre;
    for (const std::int64_t node : corners)
      centre += part * series.samples[static_cast<std::size_t>(node)].uvw;
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

/// Encodes every other frame, and the last; the largest errors of the spline in those left out, by frame.
std::map<std::size_t, double> unseen_errors(const Series& series, const EncodeOptions& options) {
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

double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024. * static_cast<double>(usage.ru_maxrss);
}

}  // namespace

OurRun run_ours(const Series& series, const Snapshot& snapshot, const NodeData& data, double tolerance) {
  namespace fs = std::filesystem;
  EncodeOptions options;
  options.tolerance = tolerance;
  OurRun run;
  Stopwatch watch;
  const auto [field, residual] = encode(series, options, [](const std::string&) {});
  run.fit = watch.lap();
  const std::string file =
      (fs::temp_directory_path() / ("cleft-benchmark-encoder-" + std::to_string(getpid()))).string();
  write_field(file, field, residual ? &*residual : nullptr);
  run.write = watch.lap();
  run.errors = errors_of(data, decoded(file, series, data));
  run.verify = watch.lap();
  run.peak_bytes = peak_memory();
  run.coefficient_bytes = static_cast<double>(record_of(field).coefficients.size());
  if (residual) run.residual_bytes = static_cast<double>(encode_residual(*residual).size());
  run.file_bytes = static_cast<double>(fs::file_size(file));
  fs::remove(file);
  run.centroid_error = centroid_error(field, series, snapshot);
  for (const auto& [frame, error] : unseen_errors(series, options)) {
    if (error > run.unseen_error) run.unseen_error = error, run.unseen_frame = frame;
    if (frame > 1) run.later_error = std::max(run.later_error, error);
  }
  return run;
}

}  // namespace cleft
