#include "encoder/quantities.h"

#include <algorithm>
#include <cmath>

#include "encoder/parallel.h"
#include "encoder/series_fit.h"

namespace cleft {

namespace {

constexpr double share_of_rounding = 0.05;  // of the tolerance

/// Largest distance from the data at any node and frame.
double error_of(const Field& field, std::size_t index, const Series& series) {
  const SeriesQuantity& data = series.quantities[index];
  std::vector<double> errors(series.times.size());
  parallel_for(static_cast<int>(errors.size()), [&](int j) {
    const auto frame = static_cast<std::size_t>(j);
    std::vector<double> value(static_cast<std::size_t>(data.frames[frame].cols()));
    for (std::size_t n = 0; n < series.samples.size(); ++n) {
      const Sample& sample = series.samples[n];
      field.quantity(index, sample.uvw, sample.side, series.times[frame], value);
      double squared = 0;
      for (std::size_t c = 0; c < value.size(); ++c)
        squared += std::pow(
            value[c] - data.frames[frame](static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(c)), 2);
      errors[frame] = std::max(errors[frame], std::sqrt(squared));
    }
  });
  return *std::max_element(errors.begin(), errors.end());
}

}  // namespace

Series series_of(const Series& series, const SeriesQuantity& quantity, int component) {
  Series result = series;
  result.quantities.clear();
  result.centres = {};  // displacements alone are linear in a cell
  result.largest_displacement = quantity.largest;
  for (std::size_t j = 0; j < series.frames.size(); ++j) {
    const Eigen::MatrixXd& all = quantity.frames[j];
    const Eigen::Index columns = std::min<Eigen::Index>(3, all.cols() - component);
    result.frames[j].setZero();
    result.frames[j].leftCols(columns) = all.middleCols(component, columns);
    result.largest[j] = result.frames[j].rowwise().norm().maxCoeff();
  }
  return result;
}

std::vector<Quantity> fit_quantities(const Series& series, const Field& field, double tolerance) {
  const std::array<BSplineBasis, 4> bases{field.basis(0), field.basis(1), field.basis(2), field.basis(3)};
  Field with = field;
  for (const SeriesQuantity& data : series.quantities) {
    const int components = static_cast<int>(data.frames.front().cols());
    Quantity& quantity = with.quantities.emplace_back();
    quantity.name = data.name, quantity.components = components;
    quantity.largest = data.largest;
    quantity.coefficients.resize(field.coefficients().size() * static_cast<std::size_t>(components));
    // A power of two: floats keep its multiples exactly, and their last bits are all 0.
    const double finest = share_of_rounding * tolerance * data.largest,
                 step = finest > 0 ? std::exp2(std::floor(std::log2(finest))) : 1;
    for (int first = 0; first < components; first += 3) {
      const Series part = series_of(series, data, first);
      const SeriesFit fit(part, field.shared_parametrization(), bases, SeriesFit::Start::any);
      const std::vector<Vec3> points = fit.coefficients(fit.control_points());
      for (std::size_t n = 0; n < points.size(); ++n)
        for (int c = 0; c < std::min(3, components - first); ++c)
          quantity
              .coefficients[n * static_cast<std::size_t>(components) + static_cast<std::size_t>(first + c)] =
              static_cast<float>(step * std::round(points[n][c] / step));
    }
    if (data.largest > 0) quantity.error = error_of(with, with.quantities.size() - 1, series) / data.largest;
  }
  return std::move(with.quantities);
}

}  // namespace cleft
