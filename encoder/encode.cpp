#include "encoder/encode.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "encoder/samples.h"
#include "encoder/spatial_fit.h"

namespace cleft {

namespace {

constexpr int degree = 3;

struct Extent {
  double front, back;
};

Extent extent_of(const std::vector<Vec3>& points, int axis) {
  const auto [least, greatest] = std::minmax_element(
      points.begin(), points.end(), [=](const Vec3& a, const Vec3& b) { return a[axis] < b[axis]; });
  return {(*least)[axis], (*greatest)[axis]};
}

std::array<BSplineBasis, 3> space_bases(const Snapshot& s, const EncodeOptions& options) {
  const Extent u = extent_of(s.points, 0), v = extent_of(s.points, 1), w = extent_of(s.points, 2);
  if (u.front == u.back || w.front == w.back)
    throw InputError("the snapshot's nodes lie in a plane; a field needs a body of tissue");
  const auto& n = options.control_points;
  return {BSplineBasis::uniform(degree, n[0], u.front, u.back),
          BSplineBasis::broken(degree, n[1], v.front, 0, v.back),
          BSplineBasis::uniform(degree, n[2], w.front, w.back)};
}

/// Knots at averages of the frames' times, so that every control point sees data (Piegl and Tiller,
/// eq. 9.68, 9.69).
BSplineBasis time_basis(const std::vector<double>& times, int control_points) {
  const int frames = static_cast<int>(times.size());
  if (frames < 2)
    throw InputError("the snapshot holds " + std::to_string(frames) +
                     " frame; a time series needs at least 2");
  const int p = std::min(degree, frames - 1), n = std::clamp(control_points, p + 1, frames);
  std::vector<double> knots(p + 1, times.front());
  const double stride = static_cast<double>(frames) / (n - p);
  for (int j = 1; j < n - p; ++j) {
    const double at = j * stride;
    const int i = static_cast<int>(at);
    knots.push_back(times[i - 1] + (at - i) * (times[std::min(i, frames - 1)] - times[i - 1]));
  }
  knots.insert(knots.end(), p + 1, times.back());
  return {p, std::move(knots)};
}

/// T x F: least-squares control points in t from values at the frames.
Eigen::MatrixXd time_fit(const BSplineBasis& basis, const std::vector<double>& times) {
  Eigen::MatrixXd values = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(times.size()), basis.size());
  for (std::size_t j = 0; j < times.size(); ++j) {
    const auto b = basis.evaluate(times[j]);
    for (int l = 0; l <= basis.degree(); ++l) values(static_cast<Eigen::Index>(j), b.first + l) = b.value[l];
  }
  return values.completeOrthogonalDecomposition().pseudoInverse();
}

std::vector<Vec3> from_frame_0(const SnapshotReader& reader, std::size_t frame,
                               const std::vector<Vec3>& closed) {
  std::vector<Vec3> d = reader.displacement(frame);
  for (std::size_t n = 0; n < d.size(); ++n) d[n] -= closed[n];
  return d;
}

/// Control points as the field file keeps them.
Vec3 as_stored(const Eigen::MatrixXd& solution, int row, int column) {
  return {static_cast<float>(solution(row, column)), static_cast<float>(solution(row, column + 1)),
          static_cast<float>(solution(row, column + 2))};
}

}  // namespace

Field encode(const SnapshotReader& reader, const EncodeOptions& options,
             const std::function<void(const std::string&)>& progress) {
  const Snapshot& s = reader.snapshot();
  const std::array<BSplineBasis, 3> space = space_bases(s, options);
  const BSplineBasis time = time_basis(s.times, options.control_points[3]);
  progress("factorising");
  const SpatialFit fit(space, samples_of(s));

  // B^T d of a frame, weighted into every control point of t: frames are read once and never all held.
  const Eigen::MatrixXd in_time = time_fit(time, s.times);
  Eigen::MatrixXd projected = Eigen::MatrixXd::Zero(fit.size(), 3 * time.size());
  const std::vector<Vec3> closed = reader.displacement(0);
  for (std::size_t j = 1; j < s.frames(); ++j) {
    progress("frame " + std::to_string(j) + " of " + std::to_string(s.frames() - 1));
    const Eigen::MatrixX3d frame = fit.project(from_frame_0(reader, j, closed));
    for (int l = 0; l < time.size(); ++l)
      projected.middleCols(3 * l, 3) += in_time(l, static_cast<Eigen::Index>(j)) * frame;
  }
  const Eigen::MatrixXd solution = fit.solve(projected);
  std::vector<Vec3> coefficients;
  coefficients.reserve(static_cast<std::size_t>(fit.size() * time.size()));
  for (int i = 0; i < fit.size(); ++i)
    for (int l = 0; l < time.size(); ++l) coefficients.push_back(as_stored(solution, i, 3 * l));

  Field field(space[0], space[1], space[2], time, std::move(coefficients),
              {s.cut_start, s.cut_length, s.cut_depth});
  for (const auto& [name, value] : s.parameters)
    if (const double* number = std::get_if<double>(&value)) field.parameters[name] = *number;
  field.case_hash = s.case_hash;
  progress("measuring");
  field.report = measure(field, reader);
  return field;
}

FitReport measure(const Field& field, const SnapshotReader& reader) {
  const Snapshot& s = reader.snapshot();
  const std::vector<Sample> samples = samples_of(s);

  double squared_error = 0, squared_data = 0, largest = 0, worst = 0, worst_gape = 0, worst_false_gap = 0;
  const std::vector<Vec3> closed = reader.displacement(0);
  std::vector<Vec3> fitted(samples.size());
  for (std::size_t j = 0; j < s.frames(); ++j) {
    const std::vector<Vec3> d = from_frame_0(reader, j, closed);
    for (std::size_t n = 0; n < d.size(); ++n) {
      fitted[n] = field.displacement(samples[n].uvw, samples[n].side, s.times[j]);
      const double error = squared_norm(fitted[n] - d[n]), size = squared_norm(d[n]);
      squared_error += error, squared_data += size;
      worst = std::max(worst, error), largest = std::max(largest, size);
    }
    for (std::size_t p = 0; p < s.pairs.size(); ++p) {
      const auto left = static_cast<std::size_t>(s.pairs[p][0]),
                 right = static_cast<std::size_t>(s.pairs[p][1]);
      const double error = norm((fitted[right] - fitted[left]) - (d[right] - d[left]));
      double& kind = static_cast<std::int32_t>(p) < s.released[j] ? worst_gape : worst_false_gap;
      kind = std::max(kind, error);
    }
    for (const Sample& sample : samples)
      if (sample.uvw.y == 0 && sample.side == Side::both)
        worst_false_gap =
            std::max(worst_false_gap, norm(field.displacement(sample.uvw, Side::right, s.times[j]) -
                                           field.displacement(sample.uvw, Side::left, s.times[j])));
  }
  FitReport report;
  report.largest_displacement = std::sqrt(largest);
  if (largest == 0) return report;  // nothing moves: every figure is 0
  report.relative_l2 = std::sqrt(squared_error / squared_data);
  report.node_error = report.spline_error = std::sqrt(worst / largest);
  report.gape_error = worst_gape / report.largest_displacement;
  report.false_gap = worst_false_gap / report.largest_displacement;
  return report;
}

}  // namespace cleft
