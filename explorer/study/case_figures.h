// Figures and curves of the cases of a study.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "encoder/field/field.h"

namespace cleft {

/// Figures of one case; lengths in mm.
struct CaseFigures {
  double gape = 0;                  ///< widest opening of the complete cut
  double largest_displacement = 0;  ///< from the closed frame
  /// Largest error of the spline, which is drawn, at any node and frame, over largest_displacement; that of
  /// the field's file together with its residual (FitReport::node_error) is less.
  double error = 0;
  double cut_length = 0, cut_depth = 0;
  double gape_error = 0;  ///< of the fit, or as interpolation estimates it; NaN where it is not known
};
CaseFigures case_figures(const Field& field);

/// Opening of the lips at u when the length t is cut, mm.
double gape(const Field& field, double u, double t);

/// The largest error of an opening of the lips, mm: of the field's fit, or as interpolation estimates it of
/// either lip; none if it is not known.
std::optional<double> error_of_gape(const Field& field);

/// The largest error of a displacement as it is drawn, mm; none if it is not known.
std::optional<double> error_of_displacement(const Field& field);

/// Widest opening of the lips when t is cut.
double widest_gape(const Field& field, double t);

/// Pairs of u and the opening there when t is cut, from start to end of the cut.
struct Curve {
  std::vector<double> x, y;
};
Curve opening_profile(const Field& field, double t);
/// Widest opening over the length cut.
Curve gape_over_time(const Field& field);

/// A column of figures or parameters, as text for lists and plots.
struct FigureText {
  std::string name, unit, help;
  double (*value)(const CaseFigures&);
};
const std::vector<FigureText>& figure_texts();

}  // namespace cleft
