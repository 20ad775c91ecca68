// The models of a study as numbers, for the page in a browser: docs/formats.md says what each means.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "base/quantiles.h"
#include "encoder/interpolate/study_interpolator.h"

namespace cleft {

namespace {

using Json = nlohmann::ordered_json;

Json list_of(const Eigen::VectorXd& vector) { return std::vector<double>(vector.begin(), vector.end()); }

Json rows_of(const Eigen::MatrixXd& matrix) {
  Json rows = Json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) rows.push_back(list_of(matrix.row(i).transpose()));
  return rows;
}

const char* name_of(Covariance::Correlation correlation) {
  switch (correlation) {
    case Covariance::Correlation::gaussian:
      return "gaussian";
    case Covariance::Correlation::matern:
      return "matern";
    default:
      return "none";
  }
}

/// Points of samples (x, y, z one after another in each column) where they are largest.
std::vector<Eigen::Index> largest_points(const Eigen::MatrixXd& samples, Eigen::Index most) {
  std::vector<Eigen::Index> points(static_cast<std::size_t>(samples.rows() / 3));
  std::iota(points.begin(), points.end(), 0);
  const Eigen::VectorXd squares = samples.rowwise().squaredNorm();
  const auto larger = [&](Eigen::Index a, Eigen::Index b) {
    return squares.segment<3>(3 * a).sum() > squares.segment<3>(3 * b).sum();
  };
  const auto count = std::min(most, static_cast<Eigen::Index>(points.size()));
  std::partial_sort(points.begin(), points.begin() + count, points.end(), larger);
  points.resize(static_cast<std::size_t>(count));
  std::vector<Eigen::Index> rows;
  for (const Eigen::Index point : points)
    for (Eigen::Index c = 0; c < 3; ++c) rows.push_back(3 * point + c);
  return rows;
}

/// In single precision: shorter text.
Json rounded_rows(const Eigen::MatrixXd& matrix) {
  Json rows = Json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    Json& row = rows.emplace_back(Json::array());
    for (const double value : matrix.row(i)) {
      const double unit = value == 0 ? 1 : std::pow(10, std::floor(std::log10(std::abs(value))) - 5);
      row.push_back(std::round(value / unit) * unit);
    }
  }
  return rows;
}

}  // namespace

Json Features::data() const {
  Json ratios = Json::array();
  for (const int f : chosen_) {
    const Ratio& ratio = ratios_[static_cast<std::size_t>(f)];
    ratios.push_back({{"over", ratio.over},
                      {"under", ratio.under},
                      {"logarithm", static_cast<bool>(positive_[static_cast<std::size_t>(f)])},
                      {"middle", middle_[f]},
                      {"half", half_[f]}});
  }
  const Parameters any;
  Json loads = Json::array();
  for (const auto component : components_) loads.push_back(row_of(any, any.skin.prestress.*component).name);
  Json scale;
  if (ours_)
    scale = {{"thickness", row_of(any, any.skin.thickness).name},
             {"modulus", row_of(any, any.tissue.young_modulus).name},
             {"prestress",
              {row_of(any, any.skin.prestress.uu).name, row_of(any, any.skin.prestress.vv).name,
               row_of(any, any.skin.prestress.uv).name}}};
  return {{"ratios", ratios}, {"loads", loads}, {"scale", scale}};
}

Json KernelRegression::data() const {
  return {{"degree", covariance_.degree},
          {"correlation", name_of(covariance_.correlation)},
          {"trend", covariance_.trend},
          {"lengths", list_of(covariance_.lengths)},
          {"nugget", nugget_},
          {"nuggets", list_of(nuggets_.tail(nuggets_.size() - cases_.features.rows()))},
          {"features", rows_of(cases_.features)},
          {"loads", rows_of(cases_.loads)},
          {"slopes",
           {{"of", cases_.slopes.of},
            {"features", rows_of(cases_.slopes.features)},
            {"loads", rows_of(cases_.slopes.loads)}}}};
}

Json DisplacementModel::data() const {
  constexpr Eigen::Index most_points = 100, most_numbers = 100000;
  Json ways = Json::array();
  if (uses_derivatives())
    for (const Way& way : ways_)
      ways.push_back(
          {{"derivative", way.derivative}, {"of", way.of}, {"log_scale", way.log_scale}, {"size", way.size}});
  Json plain;
  if (plain_) {
    const Eigen::Index columns = plain_->data.cols() + plain_->samples.cols();
    const auto rows = largest_points(plain_->samples,
                                     std::clamp<Eigen::Index>(most_numbers / (3 * columns), 8, most_points));
    plain = {{"scales", list_of(plain_->scales)},
             {"regression", plain_->regression.data()},
             {"samples", rounded_rows(plain_->samples(rows, Eigen::all))},
             {"chosen", plain_->chosen->data()},
             {"data", rounded_rows(plain_->data(rows, Eigen::all))}};
  }
  return {{"features", features_.data()},
          {"exponents", list_of(exponents_)},
          {"scales", list_of(scales_)},
          {"regression", regression_->data()},
          {"error_of_deviation", error_of_deviation_},
          {"ways", ways},
          {"plain", plain}};
}

Json GeometryModel::data() const {
  Json constant = Json::array();
  std::vector<Eigen::Index> varying;
  for (Eigen::Index k = 0; k < constant_.size(); ++k) {
    if (std::isnan(constant_[k])) varying.push_back(k);
    constant.push_back(std::isnan(constant_[k]) ? Json() : Json(constant_[k]));
  }
  Json data{{"times", times_}, {"constant", constant}};
  if (varying.empty()) return data;
  data["names"] = varying_;
  data["middle"] = list_of(middle_), data["half"] = list_of(half_);
  data["measured_by"] = measured_by_;
  data["places"] = rows_of(places_);
  data["linear"] = rows_of(linear_(Eigen::all, varying)), data["left"] = rows_of(left_(Eigen::all, varying));
  return data;
}

Json StudyInterpolator::data() const {
  Json ranges = Json::array(), bases = Json::object(), groups = Json::array();
  for (const Range& range : varying_)
    ranges.push_back({{"name", range.name}, {"least", range.least}, {"greatest", range.greatest}});
  constexpr const char* axes[] = {"along", "across", "height", "time"};
  for (int axis = 0; axis < 4; ++axis)
    bases[axes[axis]] = {{"degree", cases_.bases()[axis].degree()}, {"knots", cases_.bases()[axis].knots()}};
  const auto add = [&](const ParameterGroup& group, const DisplacementModel& model) {
    groups.push_back({{"names", group.names}, {"cases", group.cases}, {"model", model.data()}});
  };
  add(groups_.together, *model_);
  for (std::size_t k = 0; k < alone_.size(); ++k) add(groups_.alone[k], alone_[k]);
  std::vector<double> fits, errors;  // mm
  std::vector<double> relative;
  std::vector<std::string> names;
  for (const CommonCase& one : cases_.cases()) {
    names.push_back(one.name);
    relative.push_back(std::isfinite(one.report.spline_error) ? one.report.spline_error : 0);
    fits.push_back(relative.back() * one.report.largest_displacement);
  }
  for (const CommonDerivative& one : cases_.derivatives()) errors.push_back(one.error);
  return {{"cases", names},
          {"parameters", parameters_.front().numbers()},
          {"varying", ranges},
          {"base", groups_.base},
          {"groups", groups},
          {"geometry", geometry_.data()},
          {"parametrization", cases_.parametrization()},
          {"bases", bases},
          {"fit_error", median(relative)},
          {"fit_errors", fits},
          {"derivative_errors", errors}};
}

}  // namespace cleft
