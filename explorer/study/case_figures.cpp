#include "explorer/study/case_figures.h"

#include <algorithm>
#include <cmath>

namespace cleft {

double gape(const Field& field, double u, double t) {
  const CanonicalCut& cut = field.cut();
  if (u <= cut.start || u >= cut.start + std::min(t, cut.length)) return 0;
  return norm(field.displacement({u, 0, 0}, Side::right, t) - field.displacement({u, 0, 0}, Side::left, t));
}

Curve opening_profile(const Field& field, double t) {
  constexpr int pieces = 150;
  Curve curve;
  for (int i = 0; i <= pieces; ++i) {
    curve.x.push_back(field.cut().start + field.cut().length * i / pieces);
    curve.y.push_back(gape(field, curve.x.back(), t));
  }
  return curve;
}

std::optional<double> error_of_gape(const Field& field) {
  const FitReport& report = field.report;
  constexpr double lips = 2;
  if (field.interpolation) return lips * field.interpolation->estimated_error * report.largest_displacement;
  if (!std::isfinite(report.gape_error)) return {};
  return report.gape_error * report.largest_displacement;
}

std::optional<double> error_of_displacement(const Field& field) {
  const double error = field.report.spline_error * field.report.largest_displacement;
  return std::isfinite(error) ? std::optional(error) : std::nullopt;
}

double widest_gape(const Field& field, double t) {
  const Curve profile = opening_profile(field, t);
  return *std::max_element(profile.y.begin(), profile.y.end());
}

Curve gape_over_time(const Field& field) {
  constexpr int pieces = 60;
  Curve curve;
  for (int i = 0; i <= pieces; ++i) {
    curve.x.push_back(field.duration() * i / pieces);
    curve.y.push_back(widest_gape(field, curve.x.back()));
  }
  return curve;
}

CaseFigures case_figures(const Field& field) {
  return {widest_gape(field, field.duration()),
          field.report.largest_displacement,
          field.report.spline_error,
          field.cut().length,
          field.cut().depth,
          error_of_gape(field).value_or(std::nan(""))};
}

const std::vector<FigureText>& figure_texts() {
  static const std::vector<FigureText> all{
      {"gape", "mm", "widest opening of the lips when all is cut",
       [](const CaseFigures& f) { return f.gape; }},
      {"displacement", "mm", "largest displacement from the closed frame",
       [](const CaseFigures& f) { return f.largest_displacement; }},
      {"error", "%", "largest error at a node of the field as it is drawn, of the largest displacement",
       [](const CaseFigures& f) { return 100 * f.error; }},
  };
  return all;
}

}  // namespace cleft
