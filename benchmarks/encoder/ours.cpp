#include "benchmarks/encoder/ours.h"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/parallel.h"
#include "base/stopwatch.h"
#include "benchmarks/encoder/unseen.h"
#include "encoder/encode.h"
#include "encoder/field/file/field_file.h"
#include "encoder/field/file/field_record.h"

namespace cleft {

namespace {

/// Displacements at all nodes and frames but the first, as the file holds them.
std::vector<float> decoded(const std::string& file, const Series& series, const NodeData& data) {
  const Field field = read_field(file);
  const std::optional<NodeResidual> residual = read_residual(file);
  std::vector<float> values(data.values.size());
  parallel_for(static_cast<int>(data.frames), [&](int j) {
    const std::size_t frame = j;
    for (std::size_t n = 0; n < data.nodes; ++n) {
      Vec3 d = field.displacement(series.samples[n].uvw, series.samples[n].side, series.times[frame + 1]);
      if (residual) d += residual->at(n, frame + 1);
      for (std::size_t axis = 0; axis < 3; ++axis)
        values[(frame * data.nodes + n) * 3 + axis] = static_cast<float>(d[static_cast<int>(axis)]);
    }
  });
  return values;
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
  const Encoded encoded = encode(series, options, [](const std::string&) {});
  const Field& field = encoded.field;
  run.fit = watch.lap();
  const std::string file =
      (fs::temp_directory_path() / ("cleft-benchmark-encoder-" + std::to_string(getpid()))).string();
  write_field(file, encoded);
  run.write = watch.lap();
  run.errors = errors_of(data, decoded(file, series, data));
  run.verify = watch.lap();
  run.peak_bytes = peak_memory();
  run.coefficient_bytes = static_cast<double>(record_of(field).coefficients.size());
  if (encoded.residual) run.residual_bytes = static_cast<double>(encoded.residual->bytes());
  run.file_bytes = static_cast<double>(fs::file_size(file));
  fs::remove(file);
  run.centroid_error = error_at_centroids(field, series, snapshot);
  for (const auto& [frame, error] : errors_unseen(series, options)) {
    if (error > run.unseen_error) run.unseen_error = error, run.unseen_frame = frame;
    if (frame > 1) run.later_error = std::max(run.later_error, error);
  }
  return run;
}

}  // namespace cleft
