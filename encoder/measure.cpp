#include "encoder/measure.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "base/parallel.h"
#include "base/stopwatch.h"

namespace cleft {

namespace {

/// Figures of one frame; errors squared.
struct Frame {
  double squared_error = 0, squared_data = 0, spline = 0, gape = 0, false_gap = 0;
  double crease = 0, overlap = 0, least_volume = 1;
  int worst_node = 0;
};

std::span<const Sample> nodes_of(const Series& series) { return {series.samples.data(), series.nodes}; }

std::vector<Vec3> spline_at(const Field& field, const Series& series, double t) {
  std::vector<Place> places;
  places.reserve(series.nodes);
  for (const Sample& sample : nodes_of(series)) places.push_back({sample.uvw, sample.side, t});
  std::vector<Vec3> values(places.size());
  field.displacements(places, values);
  return values;
}

Vec3 data_at(const Series& series, std::size_t frame, std::size_t node) {
  const auto row = series.frames[frame].row(static_cast<Eigen::Index>(node));
  return {row(0), row(1), row(2)};
}

double volume(const Derivatives& d) {
  return dot(cross(Vec3{1, 0, 0} + d.by_u, Vec3{0, 1, 0} + d.by_v), Vec3{0, 0, 1} + d.by_w);
}

/// Between the skin's directions across v = 0, left and right.
double kink(const Derivatives& left, const Derivatives& right) {
  const Vec3 a = Vec3{0, 1, 0} + left.by_v, b = Vec3{0, 1, 0} + right.by_v;
  return std::atan2(norm(cross(a, b)), dot(a, b)) * 180 / std::numbers::pi;
}

/// The tip and the start themselves are left out: there the lips part, and the kink is the opening's.
void add_shape(Frame& f, const Field& field, const Series& series, std::size_t frame) {
  const double t = series.times[frame], top = series.geometry.domain[2].back;
  const double start = series.geometry.cut.start, tip = series.geometry.tip.at(t);
  const double tiny = 1e-9 * (series.geometry.domain[0].back - series.geometry.domain[0].front);
  for (const Sample& sample : nodes_of(series)) {
    const bool uncut_plane = sample.uvw.y == 0 && sample.side == Side::both && series.geometry.cut.length > 0;
    const bool end = std::abs(sample.uvw.x - start) <= tiny || std::abs(sample.uvw.x - tip) <= tiny;
    if (uncut_plane && !end && sample.uvw.z == top)
      f.crease = std::max(f.crease, kink(field.derivatives(sample.uvw, Side::left, t),
                                         field.derivatives(sample.uvw, Side::right, t)));
    f.least_volume = std::min(f.least_volume, volume(field.derivatives(sample.uvw, sample.side, t)));
  }
}

Frame measure_frame(const Field& field, const Series& series, std::size_t j) {
  Frame f;
  const double t = series.times[j];
  const std::vector<Vec3> spline = spline_at(field, series, t);
  const auto off = [&](std::size_t n) { return spline[n] - data_at(series, j, n); };
  for (std::size_t n = 0; n < spline.size(); ++n) {
    const double squared = squared_norm(off(n));
    f.squared_error += squared, f.squared_data += squared_norm(data_at(series, j, n));
    if (squared > f.spline) f.spline = squared, f.worst_node = static_cast<int>(n);
    const Sample& sample = series.samples[n];
    if (sample.uvw.y == 0 && sample.side == Side::both)
      f.false_gap = std::max(f.false_gap, norm(field.displacement(sample.uvw, Side::right, t) -
                                               field.displacement(sample.uvw, Side::left, t)));
  }
  for (std::size_t p = 0; p < series.pairs.size(); ++p) {
    const auto left = static_cast<std::size_t>(series.pairs[p][0]),
               right = static_cast<std::size_t>(series.pairs[p][1]);
    if (std::max(left, right) >= series.nodes) continue;
    const bool open = static_cast<std::int32_t>(p) < series.released[j];
    double& kind = open ? f.gape : f.false_gap;
    kind = std::max(kind, norm(off(right) - off(left)));
    const double gap = spline[right].y - spline[left].y,
                 of_data = data_at(series, j, right).y - data_at(series, j, left).y;
    if (open) f.overlap = std::max(f.overlap, std::max(0., -gap) - std::max(0., -of_data));
  }
  if (j % 4 == 0 || j + 1 == series.times.size()) add_shape(f, field, series, j);
  series.frames.forget(j);
  return f;
}

}  // namespace

FitReport measure(const Field& field, const Series& series) {
  const Stopwatch watch;
  std::vector<Frame> frames(series.times.size());
  parallel_for(static_cast<int>(frames.size()),
               [&](int j) { frames[j] = measure_frame(field, series, static_cast<std::size_t>(j)); });
  FitReport report;
  report.condition = field.report.condition, report.fit_seconds = field.report.fit_seconds;
  report.nodes = static_cast<double>(series.nodes);
  report.frames = static_cast<double>(series.times.size());
  const double scale = report.largest_displacement = series.largest_displacement;
  if (scale == 0) return report;  // nothing moves: every figure is 0
  double squared_error = 0, squared_data = 0, spline = 0;
  for (std::size_t j = 0; j < frames.size(); ++j) {
    const Frame& f = frames[j];
    squared_error += f.squared_error, squared_data += f.squared_data;
    if (f.spline > spline)
      spline = f.spline, report.worst_node = f.worst_node, report.worst_time = series.times[j];
    report.gape_error = std::max(report.gape_error, f.gape / scale);
    report.false_gap = std::max(report.false_gap, f.false_gap / scale);
    report.crease = std::max(report.crease, f.crease);
    report.overlap = std::max(report.overlap, f.overlap);
    report.least_volume = std::min(report.least_volume, f.least_volume);
    if (series.largest[j] > 0)
      report.frame_error = std::max(report.frame_error, std::sqrt(f.spline) / series.largest[j]);
  }
  report.relative_l2 = std::sqrt(squared_error / squared_data);
  report.node_error = report.spline_error = std::sqrt(spline) / scale;
  report.measure_seconds = watch.seconds();
  return report;
}

NodeResidual residual_of(Field& field, const Series& series, double bound) {
  NodeResidual residual;
  // Half a step each way is sqrt(3) / 2 steps together; a little less for rounding.
  residual.quantum = (1 - 1e-9) * 2 / std::sqrt(3.) * bound;
  residual.nodes = static_cast<int>(series.nodes);
  residual.frames = static_cast<int>(series.times.size()) - 1;
  residual.values.resize(series.nodes * 3 * static_cast<std::size_t>(residual.frames));
  std::vector<double> largest(series.times.size());
  parallel_for(static_cast<int>(largest.size()), [&](int frame) {
    const std::size_t j = frame;
    const std::vector<Vec3> spline = spline_at(field, series, series.times[j]);
    for (std::size_t n = 0; n < spline.size(); ++n) {
      const Vec3 left = data_at(series, j, n) - spline[n];
      for (int axis = 0; j > 0 && axis < 3; ++axis)
        residual.value(n, axis, j) = static_cast<std::int32_t>(std::lround(left[axis] / residual.quantum));
      largest[j] = std::max(largest[j], norm(residual.at(n, j) - left));
    }
    series.frames.forget(j);
  });
  field.report.node_error = *std::max_element(largest.begin(), largest.end()) / series.largest_displacement;
  return residual;
}

}  // namespace cleft
