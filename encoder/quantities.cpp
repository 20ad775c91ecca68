#include "encoder/quantities.h"

#include <algorithm>
#include <cmath>

#include "encoder/at_nodes.h"
#include "encoder/even_knots.h"
#include "encoder/field/unknowns.h"
#include "encoder/series_fit.h"
#include "encoder/tolerance_shares.h"

namespace cleft {

namespace {

constexpr int components_at_once = 3;  // components that are fitted and coded together

/// The field at the last time, at all times.
Field as_at_the_end(const Field& field) {
  std::vector<Vec3> points = field.coefficients();
  const std::size_t slices = static_cast<std::size_t>(field.basis(3).size());
  for (std::size_t n = 0; n < points.size(); ++n) points[n] = points[n - n % slices + slices - 1];
  return {field.shared_parametrization(),
          {field.basis(0), field.basis(1), field.basis(2), field.basis(3)},
          std::move(points)};
}

/// With `still`: that of the last time, at all times.
NodeSpline stepped(const NodeSpline& spline, double step, bool still) {
  NodeSpline result{spline.field, spline.components, {}};
  for (const Field& part : spline.parts) {
    const Field rounded = quantised(part, step, farthest_move);
    result.parts.push_back(still ? as_at_the_end(rounded) : rounded);
  }
  return result;
}

/// All components of all control points.
std::vector<double> coefficients_of(const NodeSpline& spline) {
  std::vector<double> all;
  for (std::size_t n = 0; n < spline.parts.front().coefficients().size(); ++n)
    for (int c = 0; c < spline.components; ++c)
      all.push_back(spline.parts[c / components_at_once].coefficients()[n][c % components_at_once]);
  return all;
}

/// The largest distance from the data at any node and frame, and where it is.
struct Worst {
  double error = 0;
  std::size_t node = 0;
  double time = 0;
};
Worst worst_of(const NodeSpline& spline, const Series& series) {
  Worst worst;
  const std::vector<NodeErrors> frames = node_errors(series, spline);
  for (std::size_t j = 0; j < frames.size(); ++j)
    if (frames[j].largest > worst.error) worst = {frames[j].largest, frames[j].worst_node, series.times[j]};
  return worst;
}

/// The field plus the components from `first` on of a constant; functions sum to 1.
Field shifted(const Field& field, const Eigen::RowVectorXd& by, int first) {
  std::vector<Vec3> points = field.coefficients();
  for (Vec3& point : points)
    for (int c = first; c < std::min<int>(first + components_at_once, static_cast<int>(by.size())); ++c)
      point[c - first] += by(c);
  return {field.shared_parametrization(),
          {field.basis(0), field.basis(1), field.basis(2), field.basis(3)},
          std::move(points)};
}

/// Three components of a quantity at a time, in a geometry.
std::vector<Series> parts_of(const Series& series, const SeriesQuantity& data,
                             const FieldGeometry& geometry) {
  std::vector<Series> parts;
  for (int first = 0; first < data.frames.front().cols(); first += components_at_once) {
    parts.push_back(series_of(series, data, first));
    parts.back().geometry = geometry;
  }
  return parts;
}

NodeSpline fitted(const SeriesQuantity& data, int number, const std::vector<Series>& parts,
                  const std::shared_ptr<const Parametrization>& parametrization,
                  const std::array<BSplineBasis, 4>& bases, FrameFit::Hold hold) {
  NodeSpline spline{number, static_cast<int>(data.frames.front().cols()), {}};
  for (const Series& part : parts) {
    const SeriesFit fit(part, std::make_shared<FitStore>(part, parametrization, 0, hold), bases,
                        SeriesFit::Start::any);
    const int first = components_at_once * static_cast<int>(spline.parts.size());
    spline.parts.push_back(fit.field(fit.control_points()));
    if (!data.middle.isZero(0)) spline.parts.back() = shifted(spline.parts.back(), data.middle, first);
  }
  return spline;
}

NodeSpline fitted(const Series& series, int number, const Field& field,
                  const std::shared_ptr<const Parametrization>& parametrization) {
  const SeriesQuantity& data = series.quantities[number];
  return fitted(data, number, parts_of(series, data, parametrization->geometry()), parametrization,
                {field.basis(0), field.basis(1), field.basis(2), field.basis(3)}, FrameFit::Hold::as_usual);
}

constexpr double share_of_even = 0.7;   // of the limit, for fits of single frames on even knots
constexpr int fewest_in_time = 8;       // spans, of even knots
constexpr double worth_of_time = 0.95;  // what more of them must make of an error

struct OnOwnKnots {
  NodeSpline spline;
  double misfit;
};

/// On even knots, with as many spans in time as the limit needs.
OnOwnKnots on_even_knots(const Series& series, int number, const Parametrization& of_field, double limit,
                         bool still, const std::function<void(const std::string&)>& progress) {
  const SeriesQuantity& data = series.quantities[number];
  const auto parametrization = standing(of_field);
  const std::vector<Series> parts = parts_of(series, data, parametrization->geometry());
  const int frames = static_cast<int>(series.times.size());
  EvenSpans spans =
      even_spans(parts, parametrization, share_of_even * limit, still ? 1 : fewest_in_time, progress);
  std::optional<OnOwnKnots> best;
  for (;; spans.time *= 2) {
    progress("fitting " + data.name);
    NodeSpline spline = fitted(data, number, parts, parametrization,
                               even_bases(spans, *parametrization, frames), FrameFit::Hold::slight);
    const double misfit = worst_of(spline, series).error;
    const bool better = !best || misfit < worth_of_time * best->misfit;
    if (!best || misfit < best->misfit) best = OnOwnKnots{std::move(spline), misfit};
    if (still || !better || best->misfit <= limit || spans.time >= frames) return std::move(*best);
  }
}

/// Knots without control points of their own.
std::shared_ptr<const Field> knots_alone(const Field& field) {
  return std::make_shared<const Field>(
      field.shared_parametrization(),
      std::array{field.basis(0), field.basis(1), field.basis(2), field.basis(3)},
      std::vector<Vec3>(field.coefficients().size()));
}

bool never_changes(const SeriesQuantity& quantity) {
  for (std::size_t j = 1; j < quantity.frames.size(); ++j) {
    if (quantity.frames[j] != quantity.frames[0]) return false;
    quantity.frames.forget(j);
  }
  return true;
}

/// The parametrisation at the last frame, when knots are all along the cut, as that of all frames.
std::shared_ptr<const Parametrization> at_the_end(const Parametrization& parametrization) {
  FieldGeometry geometry = parametrization.geometry();
  std::fill(geometry.tip.positions.begin(), geometry.tip.positions.end(), geometry.tip.positions.back());
  return make_parametrization(parametrization.name(), std::move(geometry));
}

/// Where the tip is in frame 0, if that is where the cut starts, a node is behind both or ahead, as it is
/// rounded, and the other place has no data. Adds both places of such nodes and middles of edges; gives the
/// nodes whose values the further samples have.
std::vector<Eigen::Index> add_at_closed_tip(Series& series) {
  std::vector<Eigen::Index> again;
  const Interval& u = series.geometry.domain[0];
  const double start = series.geometry.cut.start, tiny = 1e-9 * (u.back - u.front);
  if (series.geometry.cut.length == 0 || series.geometry.tip.positions.front() > start + tiny) return again;
  const auto is_there = [&](const Sample& sample) { return std::abs(sample.uvw.x - start) < tiny; };
  const auto moved = [&](Sample sample, double to) {
    sample.uvw.x = to;
    return sample;
  };
  CellCentres& middles = series.middles;
  const std::size_t nodes = series.samples.size(), edges = middles.samples.size();
  for (const double to : {start, start + tiny}) {
    for (std::size_t n = 0; n < nodes; ++n)
      if (is_there(series.samples[n])) {
        series.samples.push_back(moved(series.samples[n], to));
        again.push_back(static_cast<Eigen::Index>(n));
      }
    for (std::size_t i = 0; i < edges; ++i)
      if (is_there(middles.samples[i])) {
        middles.samples.push_back(moved(middles.samples[i], to));
        middles.touches_plane.push_back(middles.touches_plane[i]);
        for (std::size_t k = middles.first[i]; k < middles.first[i + 1]; ++k)
          middles.nodes.push_back(std::int64_t{middles.nodes[k]});
        middles.first.push_back(middles.nodes.size());
      }
  }
  return again;
}

}  // namespace

Series series_of(const Series& series, const SeriesQuantity& quantity, int component) {
  Series result = series;
  result.quantities.clear(), result.derivatives.clear(), result.frames = series.frames.like_these();
  result.from_zero = false, result.quadratic = false;  // no opening
  result.largest_displacement = quantity.scale;
  const std::vector<Eigen::Index> again = add_at_closed_tip(result);
  for (std::size_t j = 0; j < series.frames.size(); ++j) {
    const auto all = quantity.frames[j];
    const Eigen::Index columns = std::min<Eigen::Index>(3, all.cols() - component), rows = all.rows();
    Eigen::MatrixX3d part = Eigen::MatrixX3d::Zero(rows + static_cast<Eigen::Index>(again.size()), 3);
    part.topLeftCorner(rows, columns) =
        all.middleCols(component, columns).rowwise() - quantity.middle.segment(component, columns);
    for (std::size_t i = 0; i < again.size(); ++i)
      part.row(rows + static_cast<Eigen::Index>(i)) = part.row(again[i]);
    result.largest[j] = part.rowwise().norm().maxCoeff();
    result.frames.push_back(part);
    quantity.frames.forget(j);
  }
  return result;
}

FittedQuantity fit_quantity(const Series& series, int number, const Field& field,
                            std::optional<double> limit_of_data,
                            const std::function<void(const std::string&)>& progress) {
  const SeriesQuantity& data = series.quantities[number];
  NodeSpline exact = fitted(series, number, field, field.shared_parametrization());
  const double scale = scale_of(data), limit = limit_of_data.value_or(0);
  double misfit = worst_of(exact, series).error;
  std::optional<double> time;
  if (limit_of_data && misfit > limit && field.parametrization().moves() && never_changes(data)) {
    NodeSpline still = fitted(series, number, field, at_the_end(field.parametrization()));
    if (const double of_still = worst_of(still, series).error; of_still < misfit)
      exact = std::move(still), misfit = of_still, time = series.times.back();
  }
  std::shared_ptr<const Field> own;
  if (limit_of_data && misfit > far_off * limit) {
    const bool still = never_changes(data);
    OnOwnKnots even = on_even_knots(series, number, field.parametrization(), limit, still, progress);
    if (even.misfit <= worth_of_denser * misfit) {
      exact = std::move(even.spline), misfit = even.misfit, time.reset();
      own = knots_alone(exact.parts.front());
    }
  }
  const bool within = misfit <= share_of_fit * limit;
  const double bound = std::max(within ? limit : 1.02 * misfit, finest_bound * scale);
  double step = step_within(bound_of_steps(bound, limit), exact.components, share_of_steps);
  NodeSpline spline = stepped(exact, step, time.has_value());
  Worst worst = worst_of(spline, series);
  for (int times = 0; worst.error > bound && times < 12; ++times) {
    step /= 1.5;
    spline = stepped(exact, step, time.has_value());
    worst = worst_of(spline, series);
  }
  FittedQuantity result{
      {data.name, exact.components, coefficients_of(spline), data.largest, worst.error / scale,
       worst.error / scale, step, data.scale, static_cast<double>(worst.node), worst.time},
      {}};
  result.quantity.time = time, result.quantity.own = own;
  if (!limit_of_data || worst.error <= limit) return result;
  double largest = 0;
  result.residual = code_left(series, spline, 0, limit, largest);
  result.quantity.error = largest / scale;
  return result;
}

}  // namespace cleft
