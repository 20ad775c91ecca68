#include "encoder/measure.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "base/parallel.h"
#include "base/stopwatch.h"
#include "encoder/at_nodes.h"

namespace cleft {

namespace {

/// Other figures of one frame, at the samples that are fitted.
struct Frame {
  double gape = 0, false_gap = 0;
  double crease = 0, overlap = 0, least_volume = 1;
};

std::span<const Sample> fitted_nodes_of(const Series& series) {
  return {series.samples.data(), series.nodes};
}

NodeSpline spline_of(const Field& field) { return {NodeSpline::displacement, 3, {field}}; }

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
  for (const Sample& sample : fitted_nodes_of(series)) {
    const bool uncut_plane = sample.uvw.y == 0 && sample.side == Side::both && series.geometry.cut.length > 0;
    const bool end = std::abs(sample.uvw.x - start) <= tiny || std::abs(sample.uvw.x - tip) <= tiny;
    if (uncut_plane && !end && sample.uvw.z == top)
      f.crease = std::max(f.crease, kink(field.derivatives(sample.uvw, Side::left, t),
                                         field.derivatives(sample.uvw, Side::right, t)));
    f.least_volume = std::min(f.least_volume, volume(field.derivatives(sample.uvw, sample.side, t)));
  }
}

/// Of a pair's nodes.
struct Gap {
  Vec3 of_spline, of_data;
};
Gap gap_of(const Field& field, const Series& series, std::size_t left, std::size_t right, std::size_t frame) {
  const double t = series.times[frame];
  const auto spline = [&](std::size_t n) {
    return field.displacement(series.samples[n].uvw, series.samples[n].side, t);
  };
  return {spline(right) - spline(left), data_at(series, frame, right) - data_at(series, frame, left)};
}

Frame measure_frame(const Field& field, const Series& series, std::size_t j) {
  Frame f;
  const double t = series.times[j];
  for (const Sample& sample : fitted_nodes_of(series))
    if (sample.uvw.y == 0 && sample.side == Side::both)
      f.false_gap = std::max(f.false_gap, norm(field.displacement(sample.uvw, Side::right, t) -
                                               field.displacement(sample.uvw, Side::left, t)));
  for (std::size_t p = 0; p < series.pairs.size(); ++p) {
    const auto left = static_cast<std::size_t>(series.pairs[p][0]),
               right = static_cast<std::size_t>(series.pairs[p][1]);
    if (std::max(left, right) >= series.nodes) continue;
    const bool open = static_cast<std::int32_t>(p) < series.released[j];
    double& kind = open ? f.gape : f.false_gap;
    const Gap gap = gap_of(field, series, left, right, j);
    kind = std::max(kind, norm(gap.of_spline - gap.of_data));
    if (open) f.overlap = std::max(f.overlap, std::max(0., -gap.of_spline.y) - std::max(0., -gap.of_data.y));
  }
  if (j % 4 == 0 || j + 1 == series.times.size()) add_shape(f, field, series, j);
  series.frames.forget(j);
  return f;
}

}  // namespace

FitReport measure(const Field& field, const Series& series) {
  const Stopwatch watch;
  FitReport report;
  report.condition = field.report.condition, report.regularisation = field.report.regularisation;
  report.fit_seconds = field.report.fit_seconds;
  report.nodes = static_cast<double>(series.node_samples().size());
  report.frames = static_cast<double>(series.times.size());
  const double scale = report.largest_displacement = series.largest_displacement;
  if (scale == 0) return report;  // nothing moves: every figure is 0
  const std::vector<NodeErrors> at_nodes = node_errors(series, spline_of(field));
  std::vector<Frame> frames(series.times.size());
  parallel_for(static_cast<int>(frames.size()),
               [&](int j) { frames[j] = measure_frame(field, series, static_cast<std::size_t>(j)); });
  double error = 0, data = 0, largest = 0;
  for (std::size_t j = 0; j < frames.size(); ++j) {
    const NodeErrors& errors = at_nodes[j];
    error += errors.error, data += errors.data;
    if (errors.largest > largest) {
      largest = errors.largest;
      report.worst_node = static_cast<int>(errors.worst_node), report.worst_time = series.times[j];
    }
    if (series.largest[j] > 0)
      report.frame_error = std::max(report.frame_error, errors.largest / series.largest[j]);
    const Frame& f = frames[j];
    report.gape_error = std::max(report.gape_error, f.gape / scale);
    report.false_gap = std::max(report.false_gap, f.false_gap / scale);
    report.crease = std::max(report.crease, f.crease);
    report.overlap = std::max(report.overlap, f.overlap);
    report.least_volume = std::min(report.least_volume, f.least_volume);
  }
  report.relative_l2 = std::sqrt(error / data);
  report.node_error = report.spline_error = largest / scale;
  report.measure_seconds = watch.seconds();
  return report;
}

CodedResidual residual_of(Field& field, const Series& series, double bound) {
  double largest = 0;
  CodedResidual residual = code_left(series, spline_of(field), 1, bound, largest);
  field.report.node_error = largest / series.largest_displacement;
  return residual;
}

}  // namespace cleft
