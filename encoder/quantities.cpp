#include "encoder/quantities.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "encoder/field/unknowns.h"
#include "encoder/residual_coding.h"
#include "encoder/series_fit.h"
#include "encoder/tolerance_shares.h"

namespace cleft {

namespace {

constexpr int at_once = 3;  // components that are fitted and coded together

/// A quantity's spline: a field for every three components.
class Spline {
 public:
  Spline(const Series& series, const SeriesQuantity& data, std::vector<Field> parts)
      : series_(series), data_(data), parts_(std::move(parts)) {}

  const std::vector<Field>& parts() const { return parts_; }
  int components() const { return static_cast<int>(data_.frames.front().cols()); }

  /// Nodes x components: the data less the spline.
  Eigen::MatrixXd left(std::size_t frame, std::size_t first_node, std::size_t nodes) const {
    Eigen::MatrixXd left = data_.node_values(frame, first_node, nodes);
    const auto samples = series_.node_samples().subspan(first_node, nodes);
    for (int first = 0; first < components(); first += at_once) {
      const std::vector<Vec3> values = spline_at(parts_[first / at_once], samples, series_.times[frame]);
      for (std::size_t n = 0; n < values.size(); ++n)
        for (int c = first; c < std::min(first + at_once, components()); ++c)
          left(static_cast<Eigen::Index>(n), c) -= values[n][c - first];
    }
    return left;
  }

  /// The largest distance from the data at any node and frame.
  double error() const {
    const auto errors = of_node_ranges(series_, [&](std::size_t frame, std::size_t first, std::size_t count) {
      const double largest = norms_of(left(frame, first, count)).maxCoeff();
      data_.frames.forget(frame);
      return largest;
    });
    return *std::max_element(errors.begin(), errors.end());
  }

  Spline stepped(double step) const {
    std::vector<Field> parts;
    for (const Field& part : parts_) parts.push_back(quantised(part, step, farthest_move));
    return {series_, data_, std::move(parts)};
  }

  /// All components of all control points.
  std::vector<double> coefficients() const {
    std::vector<double> all;
    for (std::size_t n = 0; n < parts_.front().coefficients().size(); ++n)
      for (int c = 0; c < components(); ++c)
        all.push_back(parts_[c / at_once].coefficients()[n][c % at_once]);
    return all;
  }

 private:
  const Series& series_;
  const SeriesQuantity& data_;
  std::vector<Field> parts_;
};

/// The field plus the components from `first` on of a constant; functions sum to 1.
Field shifted(const Field& field, const Eigen::RowVectorXd& by, int first) {
  std::vector<Vec3> points = field.coefficients();
  for (Vec3& point : points)
    for (int c = first; c < std::min<int>(first + at_once, static_cast<int>(by.size())); ++c)
      point[c - first] += by(c);
  return {field.shared_parametrization(),
          {field.basis(0), field.basis(1), field.basis(2), field.basis(3)},
          std::move(points)};
}

/// The largest norm of a change by 1 of each component, each way.
double norm_of_ones(int components) { return norms_of(Eigen::MatrixXd::Ones(1, components))(0); }

Spline fitted(const Series& series, const SeriesQuantity& data, const Field& field) {
  const std::array<BSplineBasis, 4> bases{field.basis(0), field.basis(1), field.basis(2), field.basis(3)};
  std::vector<Field> parts;
  for (int first = 0; first < data.frames.front().cols(); first += at_once) {
    const Series part = series_of(series, data, first);
    const SeriesFit fit(part, field.shared_parametrization(), bases, SeriesFit::Start::any);
    parts.push_back(fit.field(fit.control_points()));
    if (!data.middle.isZero(0)) parts.back() = shifted(parts.back(), data.middle, first);
  }
  return {series, data, std::move(parts)};
}

/// What `spline` leaves, so that nothing is off by more than `bound`; and how far the worst then is.
CodedResidual residual_of(const Spline& spline, const Series& series, double bound, double& largest) {
  CodedResidual kind;
  kind.components = spline.components(), kind.first_frame = 0;
  // Half a step each way; a little less for rounding.
  kind.quantum = (1 - 1e-9) * 2 / norm_of_ones(kind.components) * bound;
  kind.nodes = static_cast<int>(series.node_samples().size());
  kind.frames = static_cast<int>(series.times.size());
  return code_residual(
      kind,
      [&](std::size_t frame, std::size_t first, std::size_t count) {
        return spline.left(frame, first, count);
      },
      largest);
}

}  // namespace

Series series_of(const Series& series, const SeriesQuantity& quantity, int component) {
  Series result = series;
  result.quantities.clear(), result.derivatives.clear(), result.frames = series.frames.like_these();
  result.centres = {};  // displacements alone are linear in a cell
  result.largest_displacement = quantity.scale;
  for (std::size_t j = 0; j < series.frames.size(); ++j) {
    const auto all = quantity.frames[j];
    const Eigen::Index columns = std::min<Eigen::Index>(3, all.cols() - component);
    Eigen::MatrixX3d part = Eigen::MatrixX3d::Zero(all.rows(), 3);
    part.leftCols(columns) =
        all.middleCols(component, columns).rowwise() - quantity.middle.segment(component, columns);
    result.largest[j] = part.rowwise().norm().maxCoeff();
    result.frames.push_back(part);
    quantity.frames.forget(j);
  }
  return result;
}

FittedQuantity fit_quantity(const Series& series, const SeriesQuantity& data, const Field& field,
                            std::optional<double> limit_of_data) {
  const Spline exact = fitted(series, data, field);
  const double scale = data.scale > 0 ? data.scale : 1, misfit = exact.error(),
               limit = limit_of_data.value_or(0);
  const bool within = misfit <= share_of_fit * limit;
  const double bound = std::max(within ? limit : 1.02 * misfit, finest_bound * scale);
  double step = share_of_steps * 2 / norm_of_ones(exact.components()) * bound;
  std::optional<Spline> stepped(exact.stepped(step));
  double error = stepped->error();
  for (int times = 0; error > bound && times < 12; ++times) {
    step /= 1.5;
    stepped.emplace(exact.stepped(step));
    error = stepped->error();
  }
  FittedQuantity result{{data.name, exact.components(), stepped->coefficients(), data.largest, error / scale,
                         error / scale, step, data.scale},
                        {}};
  if (!limit_of_data || error <= limit) return result;
  double largest = 0;
  result.residual = residual_of(*stepped, series, limit, largest);
  result.quantity.error = largest / scale;
  return result;
}

}  // namespace cleft
